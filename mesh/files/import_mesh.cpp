#include "mesh/files/import_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "mesh/bounding_box.h"
#include "mesh/cell_faces.h"
#include "mesh/files/flat_mesh.h"
#include "mesh/files/gmsh_file.h"
#include "mesh/files/vtk_file.h"
#include "mesh/matching.h"
#include "mesh/search/point_bounds.h"
#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

constexpr std::array<const char*, 6> usual_region_arrays{"region",    "material",  "gmsh:physical",
                                                         "medit:ref", "cell_tags", "CellEntityIds"};
constexpr int vtk_voxel = 11;        // vtkCellType.h
constexpr double flat_cell = 1e-14;  // volume over the cube of an edge or diagonal: nothing but rounding

class Importer {
 public:
  Importer(const ImportSettings& settings, MeshFile file) : settings_(settings), file_(std::move(file)) {}

  Mesh import(void (*check)(const Mesh&) = nullptr) {
    if (!(settings_.scale > 0.0))
      throw error(fmt::format("its unit of length is {}; it must be positive", quantity_text(settings_.scale, "m", 6)));
    extrude_flat();
    region_numbers_ = region_numbers();
    name_regions();
    place_points();
    for (Index c = 0, polyhedron = 0; c < file_.n_cells(); ++c) {
      if (is_volume(c)) add_cell(c);
      if (file_.cell_type[c] == 42) soup_.polyhedron_faces.push_back(renumbered_faces(polyhedron++));
    }
    if (soup_.shape.empty()) throw error("it has no volume cells" + why_no_volumes());
    return naming_file([&] {
      const std::vector<PatchRule> rules = patch_rules();
      Mesh mesh = assemble_mesh(std::move(soup_), rules);
      if (check) check(mesh);
      return mesh;
    });
  }

 private:
  InputError error(const std::string& reason) const {
    return InputError(fmt::format("the mesh {}: {}", settings_.file.string(), reason));
  }
  // What `act` makes; its errors name the file.
  auto naming_file(const auto& act) const -> decltype(act()) {
    try {
      return act();
    } catch (const InputError& e) {
      throw error(e.what());
    }
  }

  void extrude_flat() {
    flat_along_ = flat_along(file_);
    if (settings_.thickness == 0.0) return;
    if (!flat_along_)
      throw error(
          "a thickness is given, and it is not flat: triangles and quadrilaterals in a plane normal to an axis, "
          "and no other cells");
    naming_file([&] { extrude(file_, *flat_along_, settings_.thickness / settings_.scale); });
  }

  std::string why_no_volumes() const {
    if (file_.has_volumes_without_cells)
      return ": none of its volumes is in a physical group, and Gmsh saves what is in one alone. Define a Physical "
             "Volume for all that is meshed, or save all elements (Mesh.SaveAll = 1) in the format 4.1";
    if (flat_along_)
      return fmt::format(": it is flat. thickness = \"1 mm\" in [mesh] makes it one layer of cells along {}",
                         "xyz"[*flat_along_]);
    return file_.has_groups ? ", as where Gmsh finds no Physical Volume to save" : "";
  }

  bool is_volume(Index cell) const {
    const int type = file_.cell_type[cell];
    if (shape_of(type)) return true;
    if (type <= MeshFile::last_flat_type) return false;
    throw error(
        fmt::format("its cell {} is of VTK's type {}; supported are tetrahedra (10), voxels (11), hexahedra (12), "
                    "wedges (13), pyramids (14), prisms of 5 and 6 sides (15, 16) and polyhedra (42)",
                    file_.number_of(cell), type));
  }

  const std::vector<Index>& array(const std::string& name) const {
    const auto found = file_.integer_arrays.find(name);
    if (found != file_.integer_arrays.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& entry : file_.integer_arrays) names.push_back(entry.first);
    throw error(fmt::format("it has no cell array \"{}\" of whole numbers; available: {}", name,
                            names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }

  // One number a cell, or empty where the file has no regions.
  std::vector<Index> region_numbers() const {
    if (!settings_.region_array.empty()) return array(settings_.region_array);
    for (const char* name : usual_region_arrays)
      if (file_.integer_arrays.contains(name)) return array(name);
    return {};
  }

  void name_regions() {
    std::set<Index> numbers;
    for (Index c = 0; c < file_.n_cells() && !region_numbers_.empty(); ++c)
      if (is_volume(c)) numbers.insert(region_numbers_[c]);
    for (const auto& [number, name] : settings_.region_names)
      if (!numbers.contains(number))
        throw error(fmt::format("no cell has the number {} of region \"{}\"; available: {}", number, name,
                                fmt::join(numbers, ", ")));
    std::map<Index, std::string> names = settings_.region_names;
    names.insert(file_.region_names.begin(), file_.region_names.end());
    for (const Index number : numbers) {
      const auto named = names.find(number);
      const std::string name = named != names.end() ? named->second : fmt::format("region_{}", number);
      const auto same = std::ranges::find(soup_.region_names, name);
      region_of_number_[number] = static_cast<Index>(same - soup_.region_names.begin());
      if (same == soup_.region_names.end()) soup_.region_names.push_back(name);
    }
    if (numbers.empty()) soup_.region_names.push_back("body");
  }

  void place_points() {
    soup_.points = std::move(file_.points);
    for (Vector& x : soup_.points) x *= settings_.scale;
    naming_file([&] { require_bounded(soup_.points, "it"); });
    if (settings_.merge_tolerance > 0.0) {
      new_point_ = merge_points(soup_.points, settings_.merge_tolerance);
    } else {
      new_point_.resize(soup_.points.size());
      std::iota(new_point_.begin(), new_point_.end(), 0);
    }
    drop_unused_points();
  }

  // Meshers leave construction points in their files.
  void drop_unused_points() {
    std::vector<Index> number(soup_.points.size(), -1);
    for (Index c = 0; c < file_.n_cells(); ++c)
      if (is_volume(c))
        for (const Index p : points_of(c)) number[p] = 0;
    std::vector<Vector> used;
    for (std::size_t p = 0; p < number.size(); ++p) {
      if (number[p] < 0) continue;
      number[p] = count_of(used);
      used.push_back(soup_.points[p]);
    }
    for (Index& p : new_point_) p = number[p];
    soup_.points = std::move(used);
  }

  Index point(Index in_file) const { return new_point_.at(in_file); }

  std::vector<Index> points_of(Index cell) const {
    std::vector<Index> ids;
    for (Index i = file_.cell_offsets[cell]; i < file_.cell_offsets[cell + 1]; ++i)
      ids.push_back(point(file_.cell_points[i]));
    return ids;
  }

  std::vector<Index> renumbered_faces(Index polyhedron) const {
    std::vector<Index> stream = file_.polyhedron_faces[polyhedron];
    for (std::size_t at = 1; at < stream.size();) {
      const auto end = std::min(stream.size(), at + 1 + static_cast<std::size_t>(stream[at]));
      for (++at; at < end; ++at) stream[at] = point(stream[at]);
    }
    return stream;
  }

  void add_cell(Index cell) {
    const CellShape shape = *shape_of(file_.cell_type[cell]);
    std::vector<Index> ids = points_of(cell);
    if (std::set<Index>(ids.begin(), ids.end()).size() != ids.size())
      throw error(fmt::format("its cell {} has a point twice", file_.number_of(cell)));
    if (shape != CellShape::polyhedron) put_in_order(cell, shape, ids);
    const Index region = region_numbers_.empty() ? 0 : region_of_number_.at(region_numbers_[cell]);
    soup_.add_cell(shape, ids, region);
  }

  void put_in_order(Index cell, CellShape shape, std::vector<Index>& ids) const {
    if (count_of(ids) != points_per_cell(shape))
      throw error(fmt::format("its cell {} has {} points", file_.number_of(cell), ids.size()));
    if (file_.cell_type[cell] == vtk_voxel) {
      std::swap(ids[2], ids[3]);
      std::swap(ids[6], ids[7]);
    }
    if (signed_cell_volume(soup_.points, shape, ids) < 0.0) mirror_cell(shape, ids);
    const double volume = signed_cell_volume(soup_.points, shape, ids);
    if (!(volume > flat_cell * portable::pow((soup_.points[ids[0]] - soup_.points[ids[2]]).norm(), 3)))
      throw error(fmt::format("its cell {} has the volume {}, which is not positive", file_.number_of(cell),
                              quantity_text(volume, "m^3", 6)));
  }

  using FaceSets = std::map<std::vector<Index>, Index>;  // sorted points -> number

  FaceSets face_sets() const {
    const std::vector<Index> numbers = settings_.face_array.empty() ? region_numbers_ : array(settings_.face_array);
    if (numbers.empty()) throw error("it has no cell array that numbers its face sets");
    FaceSets sets;
    std::set<Index> found;
    for (Index c = 0; c < file_.n_cells(); ++c) {
      if (!file_.is_face(c)) continue;
      std::vector<Index> ids = points_of(c);
      std::ranges::sort(ids);
      sets[ids] = numbers[c];
      found.insert(numbers[c]);
    }
    for (const auto& [number, name] : settings_.face_sets)
      if (!found.contains(number))
        throw error(
            fmt::format("no triangle, quadrilateral or polygon has the number {} of patch \"{}\"; available: {}",
                        number, name, found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", "))));
    return sets;
  }

  std::vector<PatchRule> patch_rules() const {
    std::map<Index, std::string> names = settings_.face_sets;
    names.insert(file_.patch_names.begin(), file_.patch_names.end());
    name_physical_groups(names);
    if (names.empty() && settings_.patches.empty()) return bounding_box_rules();
    std::vector<PatchRule> rules = names.empty() ? std::vector<PatchRule>{} : face_set_rules(names);
    rules.insert(rules.end(), settings_.patches.begin(), settings_.patches.end());
    if (settings_.thickness > 0.0) add_sides_of_layer(rules);
    return rules;
  }

  std::vector<PatchRule> face_set_rules(const std::map<Index, std::string>& names) const {
    std::vector<PatchRule> rules;
    const auto sets = std::make_shared<const FaceSets>(face_sets());
    for (const auto& [number, name] : names) {
      const auto holds = [sets, wanted = number](const Vector&, const Vector&, std::span<const Index> ids) {
        std::vector<Index> key(ids.begin(), ids.end());
        std::ranges::sort(key);
        const auto found = sets->find(key);
        return found != sets->end() && found->second == wanted;
      };
      // What the file names may lie within the body, as an interface does.
      rules.push_back({name, holds, settings_.face_sets.contains(number)});
    }
    return rules;
  }

  // Of Gmsh's that have no name.
  void name_physical_groups(std::map<Index, std::string>& names) const {
    if (!file_.has_groups) return;
    for (Index c = 0; c < file_.n_cells(); ++c)
      if (file_.is_face(c) && region_numbers_[c] != 0)
        names.emplace(region_numbers_[c], fmt::format("patch_{}", region_numbers_[c]));
  }

  // The plane of the flat mesh and the one beyond, which no line of the file can name.
  void add_sides_of_layer(std::vector<PatchRule>& rules) const {
    for (const PatchRule& side : bounding_box_rules())
      if (side.name[0] == "xyz"[*flat_along_] && std::ranges::find(rules, side.name, &PatchRule::name) == rules.end())
        rules.push_back(side);
  }

  std::vector<PatchRule> bounding_box_rules() const {
    const auto [low, high] = bounding_box(soup_.points);
    std::vector<PatchRule> rules = box_patches(low, high);
    for (PatchRule& rule : rules) rule.required = false;
    return rules;
  }

  const ImportSettings& settings_;
  MeshFile file_;
  std::vector<Index> region_numbers_;
  std::map<Index, Index> region_of_number_;
  std::vector<Index> new_point_;   // of each point of the file; -1 where no volume cell has it
  std::optional<int> flat_along_;  // the axis, of a file that is flat
  CellSoup soup_;
};

}  // namespace

Mesh import_mesh(const ImportSettings& settings, MeshFile file) { return Importer(settings, std::move(file)).import(); }

Mesh import_vtk(const ImportSettings& settings) { return import_mesh(settings, read_vtk_file(settings.file)); }

Mesh import_gmsh(const ImportSettings& settings) {
  return Importer(settings, read_gmsh_file(settings.file)).import(require_matching_cells);
}

}  // namespace pfdm
