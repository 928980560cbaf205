#include "solver/momentum/bending/layer_curvature.h"

#include "solver/momentum/bending/line_walk.h"
#include "solver/momentum/bending/turned_stiffness.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {

class LayerCurvature::Maker {
  using FacePair = std::array<Index, 2>;

 public:
  Maker(const Mesh& mesh, const Unknowns& unknowns, std::span<const CubicFaces::Side> sides, LayerCurvature& made)
      : mesh_(mesh),
        unknowns_(unknowns),
        walk_(mesh, unknowns),
        stiffness_(mesh, unknowns),
        made_(made),
        sides_of_(sides_of_cells(mesh, sides)) {}

  // Across the thinnest layers, which bend the most; across others torsion would be too stiff.
  void add(std::span<const BendingCell> all) {
    constexpr double as_thin = 1.01;
    const double least = std::ranges::min(all, {}, &BendingCell::thickness).thickness;
    const auto sheared = std::ranges::find_if(
        all, [&](const BendingCell& in) { return in.thickness <= as_thin * least && is_sheared_beside(in); });
    if (sheared != all.end()) add(*sheared);
  }

 private:
  // The second derivative across the layers at a cell, from the differences to other cells.
  struct Second {
    std::array<Index, 3> others{-1, -1, -1};
    std::array<double, 3> parts{};  // [1/m^2]
  };

  // The layer itself, or one beside it where axes turn.
  bool is_sheared_beside(const BendingCell& in) const {
    return walk_.is_sheared(in.cell, in.across[0]) || std::ranges::any_of(in.across, [&](Index face) {
             const Index other = walk_.beyond(in.cell, face).cell;
             return other >= 0 && walk_.is_sheared(other, face);
           });
  }

  void add(const BendingCell& in) {
    const std::optional<Second> here = second(in.cell, in.across);
    for (const auto& [face, side] : sides_of_[in.cell])
      if (face != in.across[0] && face != in.across[1]) {
        if (here) add_cutting(in, face, side, *here);
      } else if (walk_.is_free(face) || unknowns_.is_split(face)) {
        add_turn_to_surface(in.cell, face, side);
        if (here) add_surface(in.cell, face, side, *here);
      } else if (const Index other = walk_.beyond(in.cell, face).cell; other >= 0) {
        level(in.cell, face, side, other);
        if (here) add_between(in.cell, face, side, other, *here);
      }
  }

  double apart(const Vector& a, const Vector& b) const { return (a - b).norm(); }
  double to_face(Index cell, Index face) const { return apart(mesh_.face_centre[face], mesh_.cell_centre[cell]); }
  double between(Index a, Index b) const { return apart(mesh_.cell_centre[a], mesh_.cell_centre[b]); }

  // Between the cells beside it; beside a surface the one behind and the next.
  std::optional<Second> second(Index cell, const FacePair& across) const {
    const auto next = [&](Index from, Index face) {
      const Index at = face < 0 ? -1 : walk_.beyond(from, face).cell;
      return at >= 0 && unknowns_.zone[at] == unknowns_.zone[cell] ? at : -1;
    };
    const Index before = next(cell, across[0]), after = next(cell, across[1]);
    if (before >= 0 && after >= 0) return through(before, -between(before, cell), after, between(after, cell));
    const Index one = std::max(before, after);
    if (one < 0) return std::nullopt;
    const Index two = next(one, opposite_face(mesh_, one, across[before >= 0 ? 0 : 1]));
    if (two < 0) return std::nullopt;
    return through(one, between(one, cell), two, between(two, cell));
  }
  // Of the parabola through a cell and two others, at the distances x and y [m].
  static Second through(Index one, double x, Index other, double y) {
    return {.others = {one, other, -1}, .parts = {2.0 / (x * (x - y)), 2.0 / (y * (y - x)), 0.0}};
  }
  // The mean of two cells side by side: four of a line, of which the one cell is no other one.
  static Second mean_of(Index cell, const Second& here, Index other, const Second& there) {
    Second mean;
    const auto put = [&](Index at, double part) {
      if (at < 0 || at == cell) return;
      const auto place = std::ranges::find_if(mean.others, [&](Index k) { return k == at || k < 0; });
      *place = at;
      mean.parts[as_size(place - mean.others.begin())] += 0.5 * part;
    };
    for (std::size_t k = 0; k < 2; ++k) put(here.others[k], here.parts[k]);
    for (std::size_t k = 0; k < 2; ++k) put(there.others[k], there.parts[k]);
    put(other, -there.parts[0] - there.parts[1]);
    return mean;
  }

  void append(std::size_t side, Index cell, const Second& by, double factor, const Vector& across, const Vector& dual) {
    Change change{.side = side, .cell = cell, .others = by.others, .parts = by.parts, .across = across, .dual = dual};
    for (double& part : change.parts) part *= factor;
    made_.changes_.push_back(change);
  }
  // Along the layers, between two or on a surface: the slope that balances what the strains of the others make there.
  void append_along(std::size_t side, Index cell, const Second& by, double factor, const Vector& n) {
    append(side, cell, by, factor, n, n);
    for (std::size_t k = 0; k < by.others.size(); ++k) add_turn(side, cell, by.others[k], factor * by.parts[k], n);
  }
  void add_turn(std::size_t side, Index cell, Index other, double part, const Vector& n, bool cuts = false) {
    if (other < 0 || !stiffness_.turns(cell, other)) return;
    const TurnedStiffness::Rows slope =
        cuts ? stiffness_.slope_cutting(cell, other, n) : stiffness_.slope_along(cell, other, n);
    made_.turns_.push_back({.side = side, .cell = cell, .other = other, .slope = part * slope, .n = n});
  }

  // By which lines give the derivative across at a cell with its second derivative: d^2/12, less a twenty-fourth of the
  // weight of slopes at free surfaces, which are those at a place [m^2].
  double multiple_at(const BendingCell& in) const {
    const double d = walk_.length(in.across[0], in.across[1]);
    double of_surfaces = 0.0;
    for (const Index face : in.across) of_surfaces += weight_of_surface(in, face);
    return d * d * (1.0 / 12.0 - of_surfaces / 24.0);
  }
  double weight_of_surface(const BendingCell& in, Index face) const {
    const auto ends = [&](Index at) { return walk_.is_free(at) || unknowns_.is_split(at); };
    const LineWalk::Step next = walk_.beyond(in.cell, face);
    const bool is_lone = ends(in.across[face == in.across[0] ? 1 : 0]);
    if (next.cell < 0) return ends(face) ? 5.0 / 12.0 : 0.0;
    if (next.far < 0 || !ends(next.far)) return 0.0;
    return is_lone ? -1.0 / 12.0 : -1.0 / 24.0;
  }

  void add_cutting(const BendingCell& in, Index face, std::size_t side, const Second& here) {
    if (!mesh_.is_interior(face) && !walk_.is_free(face)) return;
    const double of_cell = multiple_at(in);
    const Vector line = (mesh_.face_centre[in.across[1]] - mesh_.face_centre[in.across[0]]).normalized();
    const Vector normal = mesh_.face_area[in.across[0]].normalized();
    append(side, in.cell, here, of_cell, line, normal / normal.dot(line));
    const Vector n = mesh_.face_area[face].normalized();
    for (std::size_t k = 0; k < here.others.size(); ++k)
      add_turn(side, in.cell, here.others[k], of_cell * here.parts[k], n, true);
  }

  // What the linear extrapolation lacks.
  void add_surface(Index cell, Index face, std::size_t side, const Second& here) {
    const Vector n = mesh_.face_area[face].normalized();
    const double to = to_face(cell, face), back = between(cell, walk_.cell_behind(cell, face));
    append_along(side, cell, here, 0.5 * to * (to + back), n);
  }
  // Of the linear extrapolation itself.
  void add_turn_to_surface(Index cell, Index face, std::size_t side) {
    const Index behind = walk_.cell_behind(cell, face);
    if (behind < 0) return;
    add_turn(side, cell, behind, -to_face(cell, face) / between(cell, behind), mesh_.face_area[face].normalized());
  }

  // Stresses of both cells count by their own distance from the face, so that derivatives along it are those as far
  // beyond it as it is from the nearer one; and the difference of both cells is that half-way between them.
  void level(Index cell, Index face, std::size_t side, Index other) {
    constexpr double even = 1e-12;
    const double a = to_face(cell, face), b = to_face(other, face);
    if (std::abs(a - b) <= even * (a + b)) return;
    const Vector n = mesh_.face_area[face].normalized();
    append_along(side, cell, {.others = {other, -1, -1}, .parts = {1.0, 0.0, 0.0}}, (a - b) / (a + b), n);
    made_.leans_[side / 2] = 0.5 * (mesh_.owner[face] == cell ? a - b : b - a);
  }

  void add_between(Index cell, Index face, std::size_t side, Index other, const Second& here) {
    const Index far = opposite_face(mesh_, other, face);
    const std::optional<Second> there = far < 0 ? std::nullopt : second(other, {face, far});
    if (!there) return;
    const Vector n = mesh_.face_area[face].normalized();
    const double a = to_face(cell, face), b = to_face(other, face), d = a + b;
    append_along(side, cell, mean_of(cell, here, other, *there), d * d / 24.0 - 0.5 * a * b, n);
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  LineWalk walk_;
  TurnedStiffness stiffness_;
  LayerCurvature& made_;
  SidesOfCells sides_of_;
};

LayerCurvature::LayerCurvature(const Mesh& mesh, const Unknowns& unknowns, std::span<const CubicFaces::Side> sides,
                               const std::vector<BendingCell>& cells, std::span<const std::size_t> surfaces) {
  leans_.assign(sides.size() / 2 + 1, 0.0);
  Maker maker(mesh, unknowns, sides, *this);
  over_cells(cells, [&](std::span<const BendingCell> of_one) { maker.add(of_one); });
  list_sides(sides.size(), surfaces);
}

void LayerCurvature::list_sides(std::size_t n_sides, std::span<const std::size_t> surfaces) {
  std::ranges::stable_sort(changes_, {}, &Change::side);
  std::ranges::stable_sort(turns_, {}, &Turn::side);
  std::vector<char> is_surface(n_sides, 0);
  for (const std::size_t side : surfaces) is_surface[side] = 1;
  std::size_t change = 0, turn = 0;
  const auto next_side = [&](const auto& all, std::size_t k) { return k < all.size() ? all[k].side : n_sides; };
  while (change < changes_.size() || turn < turns_.size()) {
    OfSide on{
        .side = std::min(next_side(changes_, change), next_side(turns_, turn)), .first = change, .first_turn = turn};
    while (next_side(changes_, change) == on.side) ++change;
    while (next_side(turns_, turn) == on.side) ++turn;
    on.end = change;
    on.end_turn = turn;
    on.has_other = is_surface[on.side] != 0;
    sides_.push_back(on);
  }
}

void LayerCurvature::weigh(const CellField<double>& counts) {
  parallel_for(count_of(changes_), [&](Index i) {
    Change& at = changes_[i];
    at.weight = counts[at.cell];
    for (const Index other : at.others)
      if (other >= 0) at.weight = std::min(at.weight, counts[other]);
  });
  parallel_for(count_of(sides_), [&](Index i) {  // of one side all alike: else their sum is no difference
    const std::span<Turn> turns(turns_.data() + sides_[i].first_turn, turns_.data() + sides_[i].end_turn);
    double weight = 1.0;
    for (const Turn& at : turns) weight = std::min({weight, counts[at.cell], counts[at.other]});
    for (Turn& at : turns) at.weight = weight;
  });
}

void LayerCurvature::add(const CellField<Tensor>& gradients, std::vector<Tensor>& changes) const {
  parallel_for(count_of(sides_), [&](Index i) {
    const OfSide& on = sides_[i];
    Tensor all = Tensor::Zero();
    for (std::size_t c = on.first; c < on.end; ++c) {
      const Change& at = changes_[c];
      Tensor sum = Tensor::Zero();
      for (std::size_t k = 0; k < at.others.size(); ++k)
        if (at.others[k] >= 0) sum += at.parts[k] * (gradients[at.others[k]] - gradients[at.cell]);
      all += at.weight * (sum - sum * at.across * at.dual.transpose());
    }
    for (std::size_t t = on.first_turn; t < on.end_turn; ++t) {
      const Turn& at = turns_[t];
      all += at.weight * (at.slope * to_mandel(symmetric_part(gradients[at.other]))) * at.n.transpose();
    }
    if (on.has_other)
      changes[on.side] += all;
    else
      changes[on.side] = all;
  });
}

}  // namespace pfdm
