#include "postproc/cohesive/columns.h"

#include "mesh/bounding_box.h"
#include "mesh/disjoint_sets.h"
#include "physics/elasticity/plane_stress.h"
#include "physics/error.h"
#include "postproc/cohesive/face_columns.h"
#include "postproc/fields/slice.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pfdm {
namespace {

// Cosine between a face's normal and the column's from which on the face's traction is that of the column.
constexpr double facing = 0.98;

// Numbers of the connected parts to which faces belong, faces that share a point being connected; in order of their
// first faces.
std::vector<Index> connected_parts(const Mesh& mesh, const std::vector<Index>& faces) {
  DisjointSets sets(faces.size());
  std::map<Index, std::size_t> first_at_point;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (const Index p : mesh.points_of_face(faces[i])) sets.join(first_at_point.try_emplace(p, i).first->second, i);
  std::map<std::size_t, Index> number;
  std::vector<Index> parts;
  for (std::size_t i = 0; i < faces.size(); ++i)
    parts.push_back(number.try_emplace(sets.least_with(i), count_of(number)).first->second);
  return parts;
}

// Length of the diagonal of the box around the mesh [m].
double extent(const Mesh& mesh) {
  const auto [lower, upper] = bounding_box(mesh.points);
  return (upper - lower).norm();
}

Column column_from_face(const Mesh& mesh, Index face, Index into, double longest, const Vector& axis) {
  Column column;
  column.point = mesh.face_centre[face];
  column.normal = -mesh.outward_area(face, into).normalized();
  column.tangents = surface_tangents(column.normal, axis);
  column.area = mesh.face_area[face].norm();
  column.segments = walk_line(mesh, into, column.point, column.normal, longest);
  const auto leaves = std::ranges::find_if(
      column.segments, [&](const LineSegment& s) { return mesh.region[s.cell] != mesh.region[into]; });
  column.segments.erase(leaves, column.segments.end());
  column.segments.front().entry = face;
  column.length = column.segments.back().begin + column.segments.back().length;
  column.reference = 0.5 * column.length;
  return column;
}

Column column_through(const Mesh& mesh, Index cell, const Section& section, const Vector& normal, double half_width,
                      const Vector& axis) {
  Column column{
      .point = section.centre, .normal = normal, .tangents = surface_tangents(normal, axis), .area = section.area};
  std::vector<LineSegment> back = walk_line(mesh, cell, section.centre, -normal, half_width);
  const std::vector<LineSegment> forth = walk_line(mesh, cell, section.centre, normal, half_width);
  std::reverse(back.begin(), back.end());
  for (LineSegment& s : back) {
    std::swap(s.entry, s.exit);
    s.begin = -s.begin - s.length;
  }
  column.segments = std::move(back);
  for (const LineSegment& s : forth) {
    LineSegment* const last = column.segments.empty() ? nullptr : &column.segments.back();
    if (last == nullptr || last->cell != s.cell) {
      column.segments.push_back(s);
    } else {  // the cell that the plane cuts
      last->length += s.length;
      last->exit = s.exit;
    }
  }
  for (const LineSegment& s : column.segments) column.length += s.length;
  return column;
}

// What one cell adds to its column.
struct CellExcess {
  Vector traction = Vector::Zero();  // [Pa]; normal, tangents
  Vector strain = Vector::Zero();    // in excess [-]; engineering shear
};

Vector components(const Column& column, const Vector& v) {
  return {v.dot(column.normal), v.dot(column.tangents[0]), v.dot(column.tangents[1])};
}

// The mean of the tractions on the faces by which the column enters and leaves, as far as they face it; else the cell's
// stress tells.
Vector traction_on_normal(const Mesh& mesh, const OutputFields& output, const Column& column,
                          const LineSegment& segment) {
  Vector sum = Vector::Zero();
  int n_faces = 0;
  for (const Index f : {segment.entry, segment.exit}) {
    if (f < 0) continue;
    const double cosine = mesh.face_area[f].normalized().dot(column.normal);
    if (std::abs(cosine) < facing) continue;
    sum += (cosine > 0.0 ? 1.0 : -1.0) * output.traction[f];
    ++n_faces;
  }
  return n_faces > 0 ? Vector(sum / n_faces) : Vector(output.stress[segment.cell] * column.normal);
}

CellExcess excess_of(const Mesh& mesh, const FractureModel& model, const OutputFields& output, const Column& column,
                     const LineSegment& segment) {
  const IsotropicElasticity& elasticity = model.in_cell(mesh, segment.cell).elasticity;
  const Vector& across = output.plane_stress_normal;  // in this direction sound material may contract
  const IsotropicElasticity sound = across.isZero() ? elasticity : plane_stress(elasticity);
  const Tensor& strain = output.strain[segment.cell];
  const Vector on_normal = components(column, strain * column.normal);
  const double lateral = strain.trace() - on_normal[0] - across.dot(strain * across);
  CellExcess excess{.traction = components(column, traction_on_normal(mesh, output, column, segment))};
  const Vector& T = excess.traction;
  excess.strain = {on_normal[0] - (T[0] - sound.lambda * lateral) / sound.constrained_modulus(),
                   2.0 * on_normal[1] - T[1] / sound.mu, 2.0 * on_normal[2] - T[2] / sound.mu};
  return excess;
}

// At the column's reference, between the middles of the cells on either side of it. One place for all states: along a
// column that is not thin against the radius of its surface tractions differ.
Vector reference_traction(const Column& column, const std::vector<CellExcess>& excess) {
  const auto middle = [&](std::size_t i) { return column.segments[i].begin + 0.5 * column.segments[i].length; };
  std::size_t beyond = 0;
  while (beyond < excess.size() && middle(beyond) < column.reference) ++beyond;
  if (beyond == 0) return excess.front().traction;
  if (beyond == excess.size()) return excess.back().traction;
  const double share = (column.reference - middle(beyond - 1)) / (middle(beyond) - middle(beyond - 1));
  return (1.0 - share) * excess[beyond - 1].traction + share * excess[beyond].traction;
}

ColumnSample sample(const Mesh& mesh, const FractureModel& model, const OutputFields& output, const Column& column) {
  ColumnSample sample;
  std::vector<CellExcess> excess;
  for (const LineSegment& s : column.segments) {
    excess.push_back(excess_of(mesh, model, output, column, s));
    sample.separation += s.length * excess.back().strain;
    sample.surface_energy += s.length * output.fracture_energy_density[s.cell];
    sample.largest_damage = std::max(sample.largest_damage, output.damage[s.cell]);
  }
  sample.traction = reference_traction(column, excess);
  sample.bulk = 0.5 * column.length * (excess.front().strain + excess.back().strain);
  return sample;
}

}  // namespace

std::string_view name_of(SurfaceKind kind) { return kind == SurfaceKind::plane ? "plane" : "interface"; }

std::array<Vector, 2> surface_tangents(const Vector& normal, const Vector& axis) {
  Vector first = normal * normal.dot(axis) - axis;
  if (first.norm() < 1e-6) {
    Index least = 0;
    normal.cwiseAbs().minCoeff(&least);
    first = Vector::Unit(least) - normal * normal[least];
  }
  first.normalize();
  return {first, normal.cross(first)};
}

double polar_angle(const Vector& normal, const Vector& axis) {
  return std::acos(std::clamp(normal.dot(axis), -1.0, 1.0));
}

std::vector<ColumnSet> interface_columns(const Mesh& mesh, const std::string& band, const std::string& outer,
                                         const Vector& axis) {
  const Index inside = mesh.region_index(band), beyond = mesh.region_index(outer);
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const Index a = mesh.region[mesh.owner[f]], b = mesh.region[mesh.neighbour[f]];
    if ((a == inside) != (b == inside) && a != beyond && b != beyond) faces.push_back(f);
  }
  if (faces.empty())
    throw InputError(
        fmt::format("the region \"{}\" of the mesh touches no region but \"{}\": no column begins there", band, outer));
  const std::vector<Index> parts = connected_parts(mesh, faces);
  const Index n_parts = 1 + *std::max_element(parts.begin(), parts.end());
  std::vector<ColumnSet> sets;
  for (Index part = 1; part <= n_parts; ++part)
    sets.push_back(
        {.name = n_parts > 1 ? fmt::format("{}_{}", band, part) : band, .kind = SurfaceKind::interface, .columns = {}});
  const double longest = extent(mesh);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Index owner = mesh.owner[faces[i]];
    const Index into = mesh.region[owner] == inside ? owner : mesh.neighbour[faces[i]];
    sets[parts[i]].columns.push_back(column_from_face(mesh, faces[i], into, longest, axis));
  }
  return sets;
}

ColumnSet plane_columns(const Mesh& mesh, const std::string& name, const Vector& point, const Vector& normal,
                        double half_width, const Vector& axis) {
  if (!(normal.norm() > 0.0)) throw InputError(fmt::format("the normal of the plane \"{}\" is zero", name));
  const Vector unit = normal.normalized();
  ColumnSet set{.name = name, .kind = SurfaceKind::plane, .columns = {}};
  for (Index cell = 0; cell < mesh.n_cells(); ++cell) {
    const Section section = section_of_cell(mesh, cell, point, unit);
    // A corner of a cell that is cut off has a section too, of no area to speak of.
    if (section.area > 1e-9 * std::pow(mesh.cell_volume[cell], 2.0 / 3.0))
      set.columns.push_back(column_through(mesh, cell, section, unit, half_width, axis));
  }
  if (set.columns.empty()) throw InputError(fmt::format("the plane \"{}\" does not intersect the mesh", name));
  return set;
}

std::vector<ColumnSample> sample_columns(const Mesh& mesh, const FractureModel& model, const OutputFields& output,
                                         const ColumnSet& set) {
  if (set.is_cohesive) return sample_faces(mesh, model, output, set);
  std::vector<ColumnSample> samples(set.columns.size());
  parallel_for(count_of(samples), [&](Index i) { samples[i] = sample(mesh, model, output, set.columns[i]); });
  return samples;
}

}  // namespace pfdm
