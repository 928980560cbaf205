#include "cases/program/fracture/body/mesh/mesh_part_keys.h"

#include <numbers>
#include <string_view>
#include <vector>

namespace pfdm {
namespace {

constexpr Range sharp_range{0.0, std::numbers::pi, true, "more than 0 and less than 180 degrees"};

std::vector<Key> block_keys(std::string_view extent, const Dimension& due, std::string_view sentence) {
  using namespace keys;
  return {{extent, quantity(due, range::positive), "", sentence},
          {"cells", whole(range::count), "", "Number of cells of the block along this axis."},
          {"ratio", number(range::positive), "1", "Grading: width of the block's last cell over that of its first."}};
}

}  // namespace

KeyType edge_length() {
  using namespace keys;
  return either({quantity(dimension::length, range::positive), table(size_keys)});
}

const KeyTable& blocks_of_length() {
  static const KeyTable table{.name = "mesh.x[]",
                              .sentence = "A block of cells along an axis; blocks follow each other.",
                              .keys = block_keys("length", dimension::length, "Extent of the block along the axis.")};
  return table;
}

const KeyTable& blocks_of_angle() {
  static const KeyTable table{
      .name = "mesh.polar[]",
      .sentence = "A block of cells along the polar angle, from the axis z > 0 on.",
      .keys = block_keys("angle", dimension::angle, "Polar angle that the block takes, from the axis z > 0 on.")};
  return table;
}

const KeyTable& shell_keys() {
  static const KeyTable table = [] {
    KeyTable rows{.name = "mesh.shells[]",
                  .sentence = "A shell of the sphere, from the inside outwards.",
                  .keys = block_keys("length", dimension::length, "Thickness of the shell along the radius.")};
    rows.keys.push_back({"region", keys::text("name"), "", "Name of the shell's region; shells may share one."});
    return rows;
  }();
  return table;
}

const KeyTable& box_part_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.regions[]",
      .sentence = "A part of a box of hexahedra between two corners: a region, slit, hole or patch.",
      .keys = {
          {"name", text("name"), "", "Name of the region, or of the patch that the part makes."},
          {"lower", point(), "", "Lower corner of the part; cells or faces whose centre lies between belong to it."},
          {"upper", point(), "", "Upper corner of the part; of a slit equal to the lower one along one axis."}}};
  return table;
}

const KeyTable& sector_part_keys() {
  using namespace keys;
  const auto extent = list(quantity(dimension::length), 2, 2);
  static const KeyTable table{
      .name = "mesh.regions[] of cylinder_sector",
      .sentence = "A part of a cylinder's sector by radius and height: a region, slit, hole or patch.",
      .keys = {{"name", text("name"), "", "Name of the region, or of the patch that the part makes."},
               {"radius", extent, "", "Radius of the part, from and to; equal ones make a slit that is a tube."},
               {"height", extent, "",
                "Height of the part, from and to, before the upper end is curved; equal ones make a disc or ring."}}};
  return table;
}

const KeyTable& imported_patch_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.patches[] of vtk and gmsh",
      .sentence = "A patch of an imported mesh: its faces in a plane, or between two corners.",
      .keys = {{"name", text("name"), "", "Name of the patch."},
               {"axis", choice("axis", {"x", "y", "z"}), "with lower and upper none",
                "Axis that is normal to the plane of the patch's faces."},
               {"at", quantity(dimension::length), "with lower and upper none", "Where the plane lies along the axis."},
               {"tolerance", quantity(dimension::length, range::positive), "a ten-thousandth of length_unit",
                "Distance from the plane, or from the corners' box, within which faces belong to the patch."},
               {"lower", point(), "with axis and at none",
                "Lower corner; surface faces whose centre lies between are taken."},
               {"upper", point(), "with axis and at none", "Upper corner of the box that holds the patch's faces."}}};
  return table;
}

const KeyTable& particle_layer_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.layers",
      .sentence = "Prism layers around particles, in which an interface of finite thickness may break.",
      .keys = {{"count", whole(range::count), "", "Number of prism layers around the particle."},
               {"thickness", quantity(dimension::length, range::positive), "", "Thickness of each prism layer."},
               {"region", text("plain name"), "\"interface\"", "Name of the region that the prism layers are."}}};
  return table;
}

const KeyTable& placed_sphere_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.spheres[]",
      .sentence = "A sphere that is placed instead of packed at random.",
      .keys = {{"centre", point(), "", "Centre of the placed sphere."},
               {"diameter", quantity(dimension::length, range::positive), "", "Diameter of the placed sphere."}}};
  return table;
}

const KeyTable& packed_shape_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.shapes[]",
      .sentence = "A body from a surface file that is packed in place of spheres.",
      .keys = {{"surface", path(), "", "File of the body's closed surface, .stl or .obj, seen from the case."},
               {"sharp_angle", quantity(dimension::angle, sharp_range), "\"45 degree\"",
                "Edges at which the surface turns by more are kept, others are rounded off."}}};
  return table;
}

const KeyTable& size_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "size",
      .sentence = "A length in multiples of the phase-field length.",
      .keys = {{"ell", number(range::positive), "", "Multiple of the phase-field length ell that [fracture] gives."}}};
  return table;
}

const KeyTable& diameter_keys() {
  using namespace keys;
  const auto length = quantity(dimension::length, range::positive);
  static const KeyTable table{
      .name = "mesh.diameter",
      .sentence = "A random distribution of the diameters of packed spheres, by number.",
      .keys = {{"distribution", choice("distribution of diameters", {"uniform", "lognormal"}), "",
                "Kind of random distribution of the diameters."},
               {"least", length, "with lognormal none", "Smallest diameter of the distribution."},
               {"most", length, "with lognormal none", "Largest diameter of the distribution."},
               {"mean", length, "", "Mean diameter of the lognormal distribution.", "lognormal"},
               {"coefficient", number(range::not_negative), "",
                "Coefficient of variation of the diameters, standard deviation over mean.", "lognormal"}},
      .decided_by = "distribution"};
  return table;
}

const KeyTable& particle_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.particles[]",
      .sentence = "A particle in the box: a sphere, or a body from a surface file.",
      .keys = {{"centre", point(), "the origin", "Centre of the sphere, or where the body's centroid lies."},
               {"diameter", quantity(dimension::length, range::positive), "or length_unit of a surface file",
                "Diameter of the sphere, or of the sphere of the same volume as the body."},
               {"region", text("name"), "\"bead\"", "Name of the particle's region."},
               {"surface", path(), "none: a sphere",
                "File of the particle's closed surface, .stl or .obj, seen from the case."},
               {"subdivisions", whole(range::count), "or surface_size",
                "Number n: the surface of the sphere has 20 n^2 triangles.", "sphere"},
               {"surface_size", edge_length(), "or subdivisions of a sphere",
                "Edge length on the particle's surface, or { ell = 1.0 } in multiples of the phase-field length."},
               {"angle", quantity(dimension::angle), "0",
                "Angle by which the particle is turned, a sphere's icosahedron about z, a body about axis."},
               {"axis", direction(), "[0, 0, 1]", "Axis through its centroid about which a body is turned.", "file"},
               {"length_unit", unit(dimension::length), "or diameter",
                "Unit of the coordinates in the surface file, as in \"mm\".", "file"},
               {"scale", number(range::positive), "1",
                "Factor of the surface file's coordinates, beside their length_unit.", "file"},
               {"sharp_angle", quantity(dimension::angle, sharp_range), "\"45 degree\"",
                "Edges at which the surface turns by more are kept, others are rounded off.", "file"},
               {"layers", keys::table(particle_layer_keys), "[mesh.layers]", "Prism layers around this particle."}},
      .decided_by_reader = true};
  return table;
}

}  // namespace pfdm
