#include "solver/dynamics/spline_solver.h"

#include "solver/dynamics/spline_grid.h"
#include "solver/linear/sparse_cholesky.h"
#include "solver/momentum/body/cell_pressure.h"
#include "solver/parallel.h"

#include <algorithm>
#include <utility>

namespace pfdm {
namespace {

// Four times as many splines in a plate take as many iterations, and their factors seven times as long.
constexpr Index nodes_per_function = 64, most_functions = 4000;
// Of the splines' answer that is added: the shorter waves among them are in the multigrid's too (a fifth fewer
// iterations than with all of it).
constexpr double share = 0.25;
constexpr std::size_t n_local = SplineGrid::n_per_box;

// Lists of items by box, ascending.
struct ByBox {
  std::vector<Index> offsets, items;

  ByBox(Index n_boxes, const std::vector<Index>& box_of) : offsets(n_boxes + 1, 0), items(box_of.size()) {
    for (const Index box : box_of) ++offsets[box + 1];
    for (std::size_t b = 0; b < as_size(n_boxes); ++b) offsets[b + 1] += offsets[b];
    std::vector<Index> next(offsets.begin(), offsets.end() - 1);
    for (std::size_t i = 0; i < box_of.size(); ++i) items[next[box_of[i]]++] = static_cast<Index>(i);
  }
};

// The upper triangle of a box's matrix: block (i, j), i <= j, at j (j + 1)/2 + i.
using BoxMatrix = std::array<Tensor, n_local*(n_local + 1) / 2>;

class SplineSpace {
 public:
  SplineSpace(const Mesh& mesh, const Unknowns& unknowns)
      : mesh_(mesh),
        unknowns_(unknowns),
        places_(places()),
        grid_(corner([](const Vector& a, const Vector& b) -> Vector { return a.cwiseMin(b); }),
              corner([](const Vector& a, const Vector& b) -> Vector { return a.cwiseMax(b); }),
              std::min(unknowns.n_nodes() / nodes_per_function, most_functions), most_functions),
        box_of_node_(boxes_of(places_)),
        nodes_(grid_.n_boxes(), box_of_node_),
        of_box_(grid_.n_boxes()),
        forces_(grid_.n_functions()),
        amplitudes_(forces_.size()) {
    is_ready_ = !cholesky_.factor(stiffness());
  }

  void correct(const std::vector<Vector>& r, std::vector<Vector>& z) {
    if (!is_ready_) return;
    gather(r);
    cholesky_.solve(forces_, amplitudes_);
    parallel_for(count_of(places_), [&](Index node) {
      const Index box = box_of_node_[node];
      const auto value = grid_.values(box, places_[node]);
      const auto function = grid_.functions_of(box);
      for (std::size_t m = 0; m < n_local; ++m) z[node] += share * value[m] * amplitudes_[function[m]];
    });
  }

 private:
  std::vector<Vector> places() const {
    std::vector<Vector> places;
    places.reserve(unknowns_.n_nodes());
    for (Index c = 0; c < mesh_.n_cells(); ++c) places.push_back(mesh_.cell_centre[c]);
    for (const Index f : unknowns_.face_of_node) places.push_back(mesh_.face_centre[f]);
    return places;
  }

  template <class Choose>
  Vector corner(const Choose& choose) const {
    Vector found = places_.front();
    for (const Vector& x : places_) found = choose(found, x);
    return found;
  }

  std::vector<Index> boxes_of(const std::vector<Vector>& places) const {
    std::vector<Index> boxes(places.size());
    std::ranges::transform(places, boxes.begin(), [&](const Vector& x) { return grid_.box_of(x); });
    return boxes;
  }

  // S^T r, box by box.
  void gather(const std::vector<Vector>& r) {
    parallel_chunks(
        grid_.n_boxes(),
        [&](Index begin, Index end) {
          for (Index box = begin; box < end; ++box) {
            auto& sums = of_box_[box];
            sums.fill(Vector::Zero());
            for (Index k = nodes_.offsets[box]; k < nodes_.offsets[box + 1]; ++k) {
              const std::size_t node = nodes_.items[k];
              const auto value = grid_.values(box, places_[node]);
              for (std::size_t m = 0; m < n_local; ++m) sums[m] += value[m] * r[node];
            }
          }
        },
        16);
    std::ranges::fill(forces_, Vector::Zero());
    for (Index box = 0; box < grid_.n_boxes(); ++box) {
      const auto function = grid_.functions_of(box);
      for (std::size_t m = 0; m < n_local; ++m) forces_[function[m]] += of_box_[box][m];
    }
  }

  // Nearly incompressible cells have a pressure for the rest of lambda.
  CellField<IsotropicElasticity> moduli() const {
    CellField<IsotropicElasticity> moduli = unknowns_.sound_moduli();
    for (const Index c : unknowns_.pressure_cells)
      moduli[c].lambda = std::min(moduli[c].lambda, CellPressure::moderate_lambda * moduli[c].mu);
    return moduli;
  }

  // Half way to the faces: in the middle of its cells a chequerboard has no strain.
  void add_strains(Index box, Index cell, const IsotropicElasticity& C, BoxMatrix& matrix) const {
    const auto faces = mesh_.faces_of_cell(cell);
    const double volume = mesh_.cell_volume[cell] / static_cast<double>(faces.size());
    const double lambda = volume * C.lambda, mu = volume * C.mu;
    for (const Index f : faces) {
      const auto g = grid_.gradients(box, 0.5 * (mesh_.cell_centre[cell] + mesh_.face_centre[f]));
      for (std::size_t j = 0, at = 0; j < n_local; ++j)
        for (std::size_t i = 0; i <= j; ++i, ++at) {
          matrix[at] += lambda * g[i] * g[j].transpose() + mu * g[j] * g[i].transpose();
          matrix[at].diagonal().array() += mu * g[i].dot(g[j]);
        }
    }
  }

  // What holds a face pulls at its cell.
  void add_held(Index box, Index node, const CellField<IsotropicElasticity>& moduli, BoxMatrix& matrix) const {
    const std::size_t k = node - unknowns_.n_cells;
    const Index f = unknowns_.face_of_node[k], cell = mesh_.owner[f];
    const Tensor held = Tensor::Identity() - unknowns_.free_directions[k];
    if (held.isZero() || mesh_.is_interior(f)) return;
    const Vector n = mesh_.face_area[f].normalized();
    const double h = std::abs((mesh_.face_centre[f] - mesh_.cell_centre[cell]).dot(n)), A = mesh_.face_area[f].norm();
    const IsotropicElasticity& C = moduli[cell];
    const Tensor pull = A / h * held * (C.mu * Tensor::Identity() + (C.lambda + C.mu) * n * n.transpose()) * held;
    const auto value = grid_.values(box, places_[node]);
    for (std::size_t j = 0, at = 0; j < n_local; ++j)
      for (std::size_t i = 0; i <= j; ++i, ++at) matrix[at] += value[i] * value[j] * pull;
  }

  BlockTriplets stiffness() const {
    const CellField<IsotropicElasticity> C = moduli();
    std::vector<BoxMatrix> of_box(grid_.n_boxes());
    parallel_chunks(
        grid_.n_boxes(),
        [&](Index begin, Index end) {
          for (Index box = begin; box < end; ++box) {
            BoxMatrix& matrix = of_box[box];
            matrix.fill(Tensor::Zero());
            for (Index k = nodes_.offsets[box]; k < nodes_.offsets[box + 1]; ++k) {
              const Index node = nodes_.items[k];
              if (node < unknowns_.n_cells)
                add_strains(box, node, C[node], matrix);
              else
                add_held(box, node, C, matrix);
            }
          }
        },
        16);
    return assembled(of_box);
  }

  BlockTriplets assembled(const std::vector<BoxMatrix>& of_box) const {
    BlockTriplets matrix;
    matrix.diagonal.assign(grid_.n_functions(), Tensor::Zero());
    std::vector<std::vector<BlockTriplets::Entry>> rows(matrix.diagonal.size());
    for (Index box = 0; box < grid_.n_boxes(); ++box) {
      const auto function = grid_.functions_of(box);
      for (std::size_t j = 0, at = 0; j < n_local; ++j)
        for (std::size_t i = 0; i <= j; ++i, ++at) {
          const Tensor& block = of_box[box][at];
          if (i == j) {
            matrix.diagonal[function[i]] += block;
            continue;
          }
          auto& row = rows[function[i]];
          const auto found = std::ranges::find(row, function[j], &BlockTriplets::Entry::column);
          if (found != row.end())
            found->value += block;
          else
            row.push_back({function[i], function[j], block});
        }
    }
    for (auto& row : rows) matrix.off_diagonal.insert(matrix.off_diagonal.end(), row.begin(), row.end());
    hold_idle(matrix.diagonal);
    return matrix;
  }

  // Functions that hardly reach the body have next to no stiffness.
  static void hold_idle(std::vector<Tensor>& diagonal) {
    double largest = 0.0;
    for (const Tensor& block : diagonal) largest = std::max(largest, block.trace());
    for (Tensor& block : diagonal) block.diagonal().array() += 1e-9 * largest;
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  std::vector<Vector> places_;  // of the nodes
  SplineGrid grid_;
  std::vector<Index> box_of_node_;
  ByBox nodes_;
  std::vector<std::array<Vector, n_local>> of_box_;  // work space
  std::vector<Vector> forces_, amplitudes_;          // of the functions
  SparseCholesky cholesky_;
  bool is_ready_ = false;
};

class WithSplines : public Preconditioner {
 public:
  WithSplines(const Mesh& mesh, const Unknowns& unknowns)
      : plain_(linear_solver("multigrid").make(mesh, unknowns)), splines_(mesh, unknowns) {}

  void build(const BlockTriplets& matrix, const MomentumOperator& balance) override { plain_->build(matrix, balance); }
  void apply(const std::vector<Vector>& r, std::vector<Vector>& z) override {
    plain_->apply(r, z);
    splines_.correct(r, z);
  }

 private:
  std::unique_ptr<Preconditioner> plain_;
  SplineSpace splines_;
};

std::unique_ptr<Preconditioner> make(const Mesh& mesh, const Unknowns& unknowns) {
  return std::make_unique<WithSplines>(mesh, unknowns);
}

}  // namespace

const LinearSolver& multigrid_with_splines() {
  static constexpr LinearSolver row{"splines", "aggregation multigrid, and splines for bending", make};
  return row;
}

}  // namespace pfdm
