#include "solver/fracture/resolution.h"

#include "physics/quantity_text.h"
#include "solver/fracture/combinations.h"
#include "solver/momentum/bending/bending_layers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double cells_in_ell = 2.0;  // at least: the discrete toughness is then within 3 % (AT2) of Gc
// Along a band: with edges of ell the force after a bead's debonding is within 1 % of that of finer ones. Layers
// around a sphere widen outwards.
constexpr double widest_in_ell = 1.25;
constexpr double fine_share = 0.2;  // of a band's cells, if where its crack grows is meshed more finely than elsewhere
constexpr double rounding = 1e-9;   // of sizes that come from coordinates
constexpr double largest_drop = 0.6;  // of damage to the next cell: profiles are no steeper than 1/ell
constexpr double long_tail = 2.0;  // half-width over ell at which a profile without end has fallen to 2 % of its energy

Index largest_face(const Mesh& mesh, Index cell) {
  return std::ranges::max(mesh.faces_of_cell(cell), {}, [&](Index f) { return mesh.face_area[f].norm(); });
}

// Extent of a cell across its largest face: a prism layer's thickness, a brick's shortest edge, a third of a
// tetrahedron's height; of a rounder polyhedron twice the distance of that face.
double thickness(const Mesh& mesh, Index cell) {
  const Index largest = largest_face(mesh, cell);
  const Vector &area = mesh.face_area[largest], to_face = mesh.face_centre[largest] - mesh.cell_centre[cell];
  return std::min(mesh.cell_volume[cell], 2.0 * std::abs(to_face.dot(area))) / area.norm();
}

// Longest edge of a hexahedron in the plane of a mesh one cell thick, plane or axisymmetric; else 0.
double width_in_plane(const Mesh& mesh, Index cell) {
  if (mesh.shape[cell] != CellShape::hexahedron) return 0.0;
  double width = 0.0;
  bool is_flat = false;
  for (const Index f : mesh.faces_of_cell(cell)) {
    const Index other = opposite_face(mesh, cell, f);
    if (other < 0) return 0.0;
    if (mesh.is_interior(f) || mesh.is_interior(other))
      width = std::max(width, 2.0 * mesh.cell_volume[cell] / (mesh.face_area[f].norm() + mesh.face_area[other].norm()));
    else
      is_flat = true;
  }
  return is_flat ? width : 0.0;
}

// Edge of a cell along its largest face, if that is a regular triangle or a square.
double width_of_largest_face(const Mesh& mesh, Index cell) {
  const Index largest = largest_face(mesh, cell);
  const bool is_triangle = mesh.points_of_face(largest).size() == 3;
  return std::sqrt(mesh.face_area[largest].norm() * (is_triangle ? 4.0 / std::numbers::sqrt3 : 1.0));
}

std::string length_text(double x) { return quantity_text(x, "m", 3); }

std::string place_text(const Vector& x) {
  return point_text(x.unaryExpr([](double v) { return std::abs(v) < 1e-15 ? 0.0 : v; }));
}

bool is_too_thick(double h, double ell) { return h > (1.0 + rounding) * ell / cells_in_ell; }

// Length that the cells along a band have to resolve [m]: ell, or with softening of a given strength the process zone
// E' Gc/ft^2 at a crack's front if that is longer, E' = E/(1 - nu^2). Gc and ft follow from g'(0) = -4 E Gc/(c0 ell
// ft^2).
double front_length(const FractureModel& model, const RegionModel& region) {
  const Degradation& g = model.degradation_of(region);
  if (!g.is_chosen() || !g.law().needs_strength) return region.ell;
  const double nu = region.elasticity.poisson_ratio(), softening = -0.25 * model.crack->c0 * g.g_prime(0.0);
  return region.ell * std::max(1.0, softening / (1.0 - nu * nu));
}

// Sizes of the cells of a region: the cell that is the thickest for its ell, the count of those too thick, the sums of
// width and of the length of a crack's front, and the count of those no wider than that.
struct Sizes {
  double thickness = 0.0, ell = 1.0;  // [m]
  double width = 0.0, front = 0.0;    // [m]
  double shortest = 0.0;              // edge in the plane of the cell where that is the shortest for ell [m]
  Index n_cells = 0, n_too_thick = 0, n_fine = 0, n_too_long = 0;
};
std::vector<Sizes> sizes_by_region(const Mesh& mesh, const FractureModel& model) {
  std::vector<Sizes> sizes(model.regions.size());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (!region.damageable) continue;
    Sizes& of_region = sizes[mesh.region[c]];
    if (const double h = thickness(mesh, c); h / region.ell > of_region.thickness / of_region.ell)
      of_region.thickness = h, of_region.ell = region.ell;
    of_region.n_too_thick += is_too_thick(thickness(mesh, c), region.ell) ? 1 : 0;
    const double in_plane = width_in_plane(mesh, c);
    if (in_plane > (1.0 + rounding) * region.ell) {
      of_region.shortest = of_region.n_too_long == 0 ? in_plane : std::min(of_region.shortest, in_plane);
      ++of_region.n_too_long;
    }
    const double along = in_plane > 0.0 ? in_plane : width_of_largest_face(mesh, c),
                 front = front_length(model, region);
    of_region.width += along;
    of_region.front += front;
    of_region.n_fine += along <= (1.0 + rounding) * front ? 1 : 0;
    ++of_region.n_cells;
  }
  return sizes;
}

void add_words_on_thickness(const std::string& region, const Sizes& sizes, ResolutionWords& words) {
  if (sizes.n_too_thick == 0) return;
  const std::string sizes_words = fmt::format("region \"{}\": cells are up to {} thick, ell is {}", region,
                                              length_text(sizes.thickness), length_text(sizes.ell));
  if (sizes.n_too_thick == sizes.n_cells)
    words.warnings.push_back(
        fmt::format("{}: no crack would be resolved (at most ell/{:g}: smaller cells in [mesh], or a "
                    "larger length in [fracture])",
                    sizes_words, cells_in_ell));
  else
    words.remarks.push_back(
        fmt::format("{}: a crack is resolved in {} of {} cells (at most ell/{:g}); the run warns if it enters others",
                    sizes_words, sizes.n_cells - sizes.n_too_thick, sizes.n_cells, cells_in_ell));
}

// Adds words on the length of cells in a mesh one cell thick.
void add_words_on_length(const std::string& region, const Sizes& sizes, ResolutionWords& words) {
  if (sizes.n_cells == 0 || sizes.n_too_long < sizes.n_cells || sizes.n_too_thick == sizes.n_cells) return;
  words.remarks.push_back(
      fmt::format("region \"{}\": cells are {} long or longer in their plane, ell is {}: cracks are resolved along "
                  "that length, not across it; the run warns of those",
                  region, length_text(sizes.shortest), length_text(sizes.ell)));
}

void add_words_on_strength(const std::string& name, const RegionModel& region, ResolutionWords& words) {
  if (!region.damageable || !region.strength.is_chosen()) return;
  if (const double largest = largest_length(region.strength.data()); region.ell > largest)
    words.warnings.push_back(
        fmt::format("region \"{}\": ell is {}; a model of strength needs less than 3 Gc/(16 W) = {}, W being the "
                    "energy density at the tensile strength",
                    name, length_text(region.ell), length_text(largest)));
}

void add_words_on_band(const Band& band, const Sizes& sizes, const FractureModel& model, double ell,
                       bool corrects_toughness, ResolutionWords& words) {
  const auto n = static_cast<double>(sizes.n_cells);
  if (sizes.width > widest_in_ell * sizes.front && static_cast<double>(sizes.n_fine) < fine_share * n)
    words.warnings.push_back(fmt::format(
        "region \"{}\": cells are {} wide along the band in the mean, {} {}: the front of a crack that runs along it "
        "would not be resolved (at most that: surface_size of the particle, or cells of [mesh])",
        band.region, length_text(sizes.width / n),
        sizes.front / n > 1.01 * ell ? "the front's process zone E' Gc/ft^2 is" : "ell is",
        length_text(sizes.front / n)));
  else if (sizes.width > widest_in_ell * sizes.front)
    words.remarks.push_back(
        fmt::format("region \"{}\": the front of a crack that runs along the band is resolved in {} of {} cells, which "
                    "are at most {} wide",
                    band.region, sizes.n_fine, sizes.n_cells, length_text(sizes.front / n)));
  const double half = std::min(model.crack->support, long_tail) * ell,
               beyond = energy_beyond(*model.crack, 0.5 * band.width / ell);
  if (corrects_toughness ? beyond > 0.5 : band.width < 2.0 * half)
    words.warnings.push_back(
        fmt::format("region \"{}\" is {} wide: the profile of a crack in it, {} with this ell, reaches beyond it with "
                    "{:.0f} % of its energy (a wider band, or a smaller length of [regions.{}])",
                    band.region, length_text(band.width), length_text(2.0 * half), 100.0 * beyond, band.region));
}

}  // namespace

ResolutionWords resolution_words(const Mesh& mesh, const FractureModel& model, std::span<const Band> bands,
                                 bool corrects_toughness) {
  ResolutionWords words;
  const std::vector<Sizes> sizes = sizes_by_region(mesh, model);
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    add_words_on_thickness(mesh.region_names[r], sizes[r], words);
    if (std::ranges::count(bands, mesh.region_names[r], &Band::region) == 0)
      add_words_on_length(mesh.region_names[r], sizes[r], words);
    add_words_on_strength(mesh.region_names[r], model.regions[r], words);
  }
  for (const Band& band : bands) {
    const std::size_t r = mesh.region_index(band.region);
    if (model.regions[r].damageable)
      add_words_on_band(band, sizes[r], model, model.regions[r].ell, corrects_toughness, words);
  }
  return words;
}

CoarseCells::CoarseCells(const Mesh& mesh, const FractureModel& model)
    : mesh_(mesh), model_(model), told_(model.regions.size(), false) {
  const std::vector<Sizes> sizes = sizes_by_region(mesh, model);
  for (std::size_t r = 0; r < sizes.size(); ++r) told_[r] = sizes[r].n_too_thick == sizes[r].n_cells;  // before the run
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (region.damageable && is_too_thick(thickness(mesh, c), region.ell)) cells_.push_back(c);
  }
}

std::vector<std::string> CoarseCells::look(const CellField<double>& damage) {
  constexpr double cracked = 0.5;
  std::vector<std::string> warnings;
  for (const Index c : cells_) {
    const std::size_t r = mesh_.region[c];
    if (told_[r] || !(damage[c] > cracked)) continue;
    told_[r] = true;
    warnings.push_back(
        fmt::format("region \"{}\": a crack has entered cells that do not resolve it, {} thick at {} with "
                    "ell = {} (at most ell/{:g}): smaller cells there in [mesh], or a larger length in [fracture]",
                    mesh_.region_names[r], length_text(thickness(mesh_, c)), place_text(mesh_.cell_centre[c]),
                    length_text(model_.in_cell(mesh_, c).ell), cells_in_ell));
  }
  look_at_neighbours(damage, warnings);
  return warnings;
}

// Whether the cells beyond this face of a hexahedron, away from which damage falls, make a crack of one or two cells,
// in contrast to the broken side of a crack's front. A boundary is taken for a mirror.
bool CoarseCells::is_narrow(Index cell, Index face, const CellField<double>& damage) const {
  for (int cells = 0; cells < 2; ++cells) {
    face = opposite_face(mesh_, cell, face);
    if (face < 0) return false;
    if (!mesh_.is_interior(face)) return true;
    const Index next = mesh_.across(face, cell);
    if (damage[cell] - damage[next] > largest_drop) return true;
    cell = next;
  }
  return false;
}

void CoarseCells::look_at_neighbours(const CellField<double>& damage, std::vector<std::string>& warnings) {
  const auto drop_at = [&](Index f) { return std::abs(damage[mesh_.owner[f]] - damage[mesh_.neighbour[f]]); };
  const auto spacing = [&](Index f) {
    return (mesh_.cell_centre[mesh_.owner[f]] - mesh_.cell_centre[mesh_.neighbour[f]]).norm();
  };
  // Steps of a crack from row to row are steeper across the rows.
  const auto is_steepest = [&](Index f, Index cell) {
    return std::ranges::none_of(mesh_.faces_of_cell(cell), [&](Index g) {
      return mesh_.is_interior(g) && drop_at(g) * spacing(f) > 1.5 * drop_at(f) * spacing(g);
    });
  };
  for (Index f = 0; f < mesh_.n_interior_faces(); ++f) {
    if (!(drop_at(f) > largest_drop)) continue;
    const Index one = mesh_.owner[f], other = mesh_.neighbour[f];
    const RegionModel &here = model_.in_cell(mesh_, one), &there = model_.in_cell(mesh_, other);
    const double ell = std::min(here.ell, there.ell);
    const Index broken = damage[one] > damage[other] ? one : other;
    const std::size_t r = mesh_.region[broken];
    if (told_[r] || !here.damageable || !there.damageable || !(spacing(f) > largest_drop * ell)) continue;
    if (!is_steepest(f, one) || !is_steepest(f, other)) continue;
    if (!(spacing(f) > widest_in_ell * ell) && !is_narrow(broken, f, damage)) continue;
    told_[r] = true;
    warnings.push_back(
        fmt::format("region \"{}\": the damage changes by {:.2f} from a cell to the next, {} apart at {} with ell = "
                    "{}: the crack is not resolved (at most ell/{:g}: smaller cells there in "
                    "[mesh], or a larger length in [fracture])",
                    mesh_.region_names[r], drop_at(f), length_text(spacing(f)), place_text(mesh_.face_centre[f]),
                    length_text(ell), cells_in_ell));
  }
}

std::string direction_remark(const Mesh& mesh, const FractureModel& model) {
  constexpr Index in_a_plane = 4;  // interior faces of a hexahedron with neighbours in two directions
  constexpr double cost = 0.21;    // of an oblique crack over one along a row, times c0 ell/h: AT2, AT1 and Wu
  struct Hexahedra {
    Index n = 0, n_cells = 0;
    double thickness = 1.0;  // the least, over ell
  };
  std::vector<Hexahedra> regions(model.regions.size());
  const auto is_interior = [&](Index f) { return mesh.is_interior(f); };
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    Hexahedra& region = regions[mesh.region[c]];
    ++region.n_cells;
    if (!model.in_cell(mesh, c).damageable || mesh.shape[c] != CellShape::hexahedron) continue;
    if (std::ranges::count_if(mesh.faces_of_cell(c), is_interior) < in_a_plane) continue;
    ++region.n;
    region.thickness = std::min(region.thickness, thickness(mesh, c) / model.in_cell(mesh, c).ell);
  }
  std::vector<std::string> names;
  double finest = 1.0;  // thickness over ell
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (2 * regions[r].n < regions[r].n_cells || regions[r].n == 0) continue;
    names.push_back(fmt::format("\"{}\"", mesh.region_names[r]));
    finest = std::min(finest, regions[r].thickness);
  }
  if (names.empty()) return {};
  const std::string where = fmt::format("region{} {}", names.size() > 1 ? "s" : "", fmt::join(names, ", "));
  const std::string other = "smaller cells, or prisms of irregular triangles (within 3 degrees; [mesh])";
  if (model.stiffness_by == StiffnessBy::mean)
    return fmt::format(
        "{}: cracks at small angles to the rows of hexahedra keep to them also with fracture.stiffness_damage = "
        "\"mean\": at ell/h = 3 one that ought to turn by 11, 25, 35 degrees turns by 2, 25, 36. Where small angles "
        "matter, use {}",
        where, other);
  return fmt::format(
      "{}: cracks oblique to the rows of hexahedra cost up to {:.1f} % more than along them where cells are smallest "
      "(ell/h = {:.2g}), and growing ones keep to the rows: at ell/h = 3 one that ought to turn by 11, 25, 35 degrees "
      "turns by 0, 8, 29. Where directions are not known beforehand, use {}{}",
      where, 100.0 * cost / model.crack->c0 * finest, 1.0 / finest,
      what_excludes_mean_damage(mesh, model).empty() ? "fracture.stiffness_damage = \"mean\", " : "", other);
}

}  // namespace pfdm
