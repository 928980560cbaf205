#include "solver/fracture/words/resolution.h"

#include "solver/fracture/combinations.h"
#include "solver/fracture/words/cell_sizes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

constexpr double fine_share = 0.2;  // of a band's cells, if where its crack grows is meshed more finely than elsewhere
constexpr double long_tail = 2.0;  // half-width over ell at which a profile without end has fallen to 2 % of its energy

void add_words_on_thickness(const std::string& region, const CellSizes& sizes, ResolutionWords& words) {
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
void add_words_on_length(const std::string& region, const CellSizes& sizes, ResolutionWords& words) {
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

void add_words_on_band(const Band& band, const CellSizes& sizes, const FractureModel& model, double ell,
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
  const std::vector<CellSizes> sizes = sizes_by_region(mesh, model);
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
    region.thickness = std::min(region.thickness, cell_thickness(mesh, c) / model.in_cell(mesh, c).ell);
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
