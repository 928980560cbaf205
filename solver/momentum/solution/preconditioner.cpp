#include "solver/momentum/solution/preconditioner.h"

#include "physics/error.h"
#include "physics/registry.h"
#include "solver/linear/multigrid.h"
#include "solver/linear/sparse_cholesky.h"
#include "solver/momentum/solution/split_condensation.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace pfdm {
namespace {

// Cells of the largest mesh one cell thick for which the factors are the automatic choice
// (tests/benchmark/log_solvers.md).
constexpr Index most_direct_cells = 40000;

// Row of each node that stays when those of split faces are eliminated: face nodes follow a cell of theirs.
std::vector<Index> interleave_face_nodes(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<Index> position(unknowns.n_nodes(), -1);
  Index next = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    position[c] = next++;
    for (const Index f : mesh.faces_of_cell(c))
      if (const Index node = unknowns.node_of_face[f]; node >= 0 && mesh.owner[f] == c && !unknowns.is_split(f))
        position[node] = next++;
  }
  std::erase(position, -1);
  return position;
}

class MultigridCycle : public Preconditioner {
 public:
  MultigridCycle(const Mesh& mesh, const Unknowns& unknowns)
      : row_of_node_(interleave_face_nodes(mesh, unknowns)), b_(row_of_node_.size()), x_(row_of_node_.size()) {
    if (!unknowns.split_faces.empty()) split_.emplace(mesh, unknowns);
  }

  void build(const BlockTriplets& matrix, const MomentumOperator&) override {
    multigrid_.emplace(compress(split_ ? split_->condense(matrix) : matrix, row_of_node_));
  }

  void apply(const std::vector<Vector>& r, std::vector<Vector>& z) override {
    if (!split_) {
      cycle(r, z);
      return;
    }
    split_->condense(r, right_);
    left_.resize(right_.size());
    cycle(right_, left_);
    split_->expand(left_, r, z);
  }

 private:
  void cycle(const std::vector<Vector>& r, std::vector<Vector>& z) {
    const auto n = count_of(row_of_node_);
    parallel_for(n, [&](Index i) {
      Lane& to = b_[row_of_node_[i]];
      to.head<3>() = r[i].cast<float>();
      to[3] = 0.0F;
    });
    multigrid_->apply(b_, x_);
    parallel_for(n, [&](Index i) { z[i] = x_[row_of_node_[i]].head<3>().cast<double>(); });
  }

  std::vector<Index> row_of_node_;  // of those that stay
  std::optional<SplitCondensation> split_;
  std::optional<Multigrid> multigrid_;
  std::vector<Lane> b_, x_;
  std::vector<Vector> right_, left_;  // of the nodes that stay
};

class CholeskyFactors : public Preconditioner {
 public:
  CholeskyFactors(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns) {}

  void build(const BlockTriplets& matrix, const MomentumOperator&) override {
    const std::optional<Index> faulty = cholesky_.factor(matrix);
    if (!faulty) return;
    const Index face = *faulty - unknowns_.n_cells;
    const Vector& x = face < 0 ? mesh_.cell_centre[*faulty] : mesh_.face_centre[unknowns_.face_of_node[face]];
    throw ComputationError(
        fmt::format("the stiffness of the body is singular at ({:.4g}, {:.4g}, {:.4g}) m: it is zero or not finite "
                    "there, or nothing holds that part",
                    x[0], x[1], x[2]));
  }

  void apply(const std::vector<Vector>& r, std::vector<Vector>& z) override { cholesky_.solve(r, z); }

 private:
  const Mesh& mesh_;
  const Unknowns& unknowns_;
  SparseCholesky cholesky_;
};

template <class Kind>
std::unique_ptr<Preconditioner> make(const Mesh& mesh, const Unknowns& unknowns) {
  return std::make_unique<Kind>(mesh, unknowns);
}

std::unique_ptr<Preconditioner> make_faster(const Mesh& mesh, const Unknowns& unknowns) {
  return prefers_direct(mesh) ? make<CholeskyFactors>(mesh, unknowns) : make<MultigridCycle>(mesh, unknowns);
}

constexpr LinearSolver table[] = {
    {"automatic", "the one that takes less time on meshes like this", make_faster},
    {"multigrid", "aggregation multigrid", make<MultigridCycle>},
    {"direct", "sparse Cholesky factors (CHOLMOD)", make<CholeskyFactors>},
};

}  // namespace

std::span<const LinearSolver> linear_solvers() { return table; }

const LinearSolver& linear_solver(std::string_view name) {
  return find_by_name(linear_solvers(), name, "linear solver");
}

bool prefers_direct(const Mesh& mesh) {
  if (mesh.n_cells() > most_direct_cells) return false;
  std::vector<Index> on_boundary(mesh.n_cells(), 0);
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f) ++on_boundary[mesh.owner[f]];
  return std::all_of(on_boundary.begin(), on_boundary.end(), [](Index n) { return n >= 2; });
}

}  // namespace pfdm
