#include "solver/momentum/rigid_modes.h"

#include "solver/momentum/momentum.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace pfdm {
namespace {

constexpr double stiff = 10.0;            // times the least shear modulus
constexpr double least_stiffness = 1e-3;  // of a rotation, over that modulus and the volume

// A motion of some of the nodes, with those of the held components left out.
using Mode = std::vector<std::pair<Index, Vector>>;

class RigidModes {
 public:
  RigidModes(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns) {
    add_inclusions();
    constexpr std::size_t point_supports = 3;
    n_inclusions_ = static_cast<Index>(modes_.size()) / 3;
    if (unknowns.periodic.empty() && unknowns.motion.held.size() == point_supports) add_whole_body();
  }

  void build(const MomentumOperator& balance) {
    if (modes_.empty()) return;
    turn_inclusions(balance);
    move_whole_body(balance);
  }

  // With D of the inclusions' rotations, W of the body's motions and C of both, [D C; C^T W] share = R^T r.
  void correct(const std::vector<Vector>& r, std::vector<Vector>& z) const {
    if (modes_.empty()) return;
    const Eigen::VectorXd on = projected(r);
    Eigen::VectorXd share(on.size());
    share.head(3 * n_inclusions_) = by_inclusion(on.head(3 * n_inclusions_));
    if (n_whole() > 0) {
      share.tail(n_whole()) = whole_.solve(on.tail(n_whole()) - coupling_.transpose() * share.head(3 * n_inclusions_));
      share.head(3 * n_inclusions_) -= by_inclusion(coupling_ * share.tail(n_whole()));
    }
    for (std::size_t k = 0; k < modes_.size(); ++k)
      for (const auto& [node, motion] : modes_[k]) z[as_size(node)] += share[static_cast<Eigen::Index>(k)] * motion;
  }

 private:
  Index n_whole() const { return static_cast<Index>(modes_.size()) - 3 * n_inclusions_; }

  Eigen::VectorXd by_inclusion(const Eigen::VectorXd& on) const {
    Eigen::VectorXd share(on.size());
    for (Index i = 0; i < n_inclusions_; ++i) share.segment<3>(3 * i) = give_[as_size(i)] * on.segment<3>(3 * i);
    return share;
  }

  Vector free_part(Index node, const Vector& motion) const {
    return node < unknowns_.n_cells ? motion
                                    : Vector(unknowns_.free_directions[as_size(node - unknowns_.n_cells)] * motion);
  }

  void add_rotations(const std::vector<Index>& nodes) {
    Vector middle = Vector::Zero();
    for (const Index node : nodes) middle += unknowns_.place(mesh_, node) / static_cast<double>(nodes.size());
    for (int axis = 0; axis < 3; ++axis) {
      Mode mode;
      for (const Index node : nodes)
        mode.emplace_back(node, free_part(node, Vector::Unit(axis).cross(unknowns_.place(mesh_, node) - middle)));
      modes_.push_back(std::move(mode));
    }
  }

  void add_whole_body() {
    std::vector<Index> nodes(as_size(unknowns_.n_nodes()));
    std::iota(nodes.begin(), nodes.end(), Index{0});
    for (int axis = 0; axis < 3; ++axis) {
      Mode mode;
      for (const Index node : nodes) mode.emplace_back(node, free_part(node, Vector::Unit(axis)));
      modes_.push_back(std::move(mode));
    }
    add_rotations(nodes);
  }

  void add_inclusions() {
    for (const IsotropicElasticity& c : unknowns_.sound) softest_ = std::min(softest_, c.mu);
    CellField<char> seen(as_size(mesh_.n_cells()), 0);
    for (Index first = 0; first < mesh_.n_cells(); ++first) {
      if (seen[first] != 0 || !is_stiff(first)) continue;
      if (const std::vector<Index> nodes = inclusion_around(first, seen); !nodes.empty()) {
        add_rotations(nodes);
        double volume = 0.0;
        for (const Index node : nodes) volume += node < unknowns_.n_cells ? mesh_.cell_volume[node] : 0.0;
        volume_.push_back(volume);
      }
    }
  }

  bool is_stiff(Index cell) const { return unknowns_.sound[as_size(unknowns_.zone[cell])].mu >= stiff * softest_; }

  // The connected stiff cells, of one zone or of several as a core in its shell, and the nodes of their faces; none if
  // the inclusion touches the boundary.
  std::vector<Index> inclusion_around(Index first, CellField<char>& seen) const {
    std::vector<Index> cells{first}, nodes;
    bool is_inside = true;
    seen[first] = 1;
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (const Index f : mesh_.faces_of_cell(cells[i])) {
        if (const Index node = unknowns_.node_beside(mesh_, cells[i], f); node >= 0) nodes.push_back(node);
        is_inside = is_inside && mesh_.is_interior(f);
        if (!mesh_.is_interior(f)) continue;
        const Index other = mesh_.across(f, cells[i]);
        if (seen[other] != 0 || !is_stiff(other)) continue;
        seen[other] = 1;
        cells.push_back(other);
      }
    if (!is_inside || cells.size() < 2) return {};
    cells.insert(cells.end(), nodes.begin(), nodes.end());
    return cells;
  }

  Eigen::VectorXd projected(const std::vector<Vector>& r) const {
    Eigen::VectorXd of_modes(static_cast<Eigen::Index>(modes_.size()));
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      double sum = 0.0;
      for (const auto& [node, motion] : modes_[k]) sum += motion.dot(r[as_size(node)]);
      of_modes[static_cast<Eigen::Index>(k)] = sum;
    }
    return of_modes;
  }

  // What the balance does about these modes together, on all modes.
  Eigen::VectorXd answer(const MomentumOperator& balance, std::size_t first, std::size_t stride,
                         std::size_t end) const {
    std::vector<Vector> u(as_size(unknowns_.n_unknowns()), Vector::Zero()), image(u.size());
    for (std::size_t k = first; k < end; k += stride)
      for (const auto& [node, motion] : modes_[k]) u[as_size(node)] = motion;
    balance.apply(u, image);
    return projected(image);
  }

  // All at once about each axis: what one inclusion does to another is small beside what it does to itself (as many
  // iterations as with the whole matrix).
  void turn_inclusions(const MomentumOperator& balance) {
    std::vector<Tensor> stiffness(as_size(n_inclusions_));
    for (int axis = 0; axis < 3 && n_inclusions_ > 0; ++axis) {
      const Eigen::VectorXd on = answer(balance, static_cast<std::size_t>(axis), 3, 3 * as_size(n_inclusions_));
      for (Index i = 0; i < n_inclusions_; ++i) stiffness[as_size(i)].col(axis) = on.segment<3>(3 * i);
    }
    give_.resize(stiffness.size());
    for (std::size_t i = 0; i < give_.size(); ++i) {  // what has debonded turns freely
      const Eigen::SelfAdjointEigenSolver<Tensor> solver(0.5 * (stiffness[i] + stiffness[i].transpose()));
      const Vector bounded = solver.eigenvalues().cwiseMax(least_stiffness * softest_ * volume_[i]);
      give_[i] = solver.eigenvectors() * bounded.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
    }
  }

  void move_whole_body(const MomentumOperator& balance) {
    if (n_whole() == 0) return;
    coupling_.resize(3 * n_inclusions_, n_whole());
    Eigen::MatrixXd whole(n_whole(), n_whole()), relieved(3 * n_inclusions_, n_whole());
    for (Index k = 0; k < n_whole(); ++k) {
      const auto number = as_size(3 * n_inclusions_ + k);
      const Eigen::VectorXd on = answer(balance, number, 1, number + 1);
      coupling_.col(k) = on.head(3 * n_inclusions_);
      whole.col(k) = on.tail(n_whole());
      relieved.col(k) = by_inclusion(coupling_.col(k));
    }
    whole_.compute(whole - coupling_.transpose() * relieved);
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  std::vector<Mode> modes_;  // three of each inclusion, then those of the whole body
  Index n_inclusions_ = 0;
  std::vector<double> volume_;  // of the inclusions
  double softest_ = std::numeric_limits<double>::infinity();
  std::vector<Tensor> give_;  // D^-1 of each
  Eigen::MatrixXd coupling_;
  Eigen::PartialPivLU<Eigen::MatrixXd> whole_;
};

class WithRigidModes : public Preconditioner {
 public:
  WithRigidModes(std::unique_ptr<Preconditioner> plain, const Mesh& mesh, const Unknowns& unknowns)
      : plain_(std::move(plain)), modes_(mesh, unknowns) {}

  void build(const BlockTriplets& matrix, const MomentumOperator& balance) override {
    plain_->build(matrix, balance);
    modes_.build(balance);
  }
  void apply(const std::vector<Vector>& r, std::vector<Vector>& z) override {
    plain_->apply(r, z);
    modes_.correct(r, z);
  }

 private:
  std::unique_ptr<Preconditioner> plain_;
  RigidModes modes_;
};

template <std::size_t row>
std::unique_ptr<Preconditioner> make(const Mesh& mesh, const Unknowns& unknowns) {
  return std::make_unique<WithRigidModes>(linear_solvers()[row].make(mesh, unknowns), mesh, unknowns);
}

}  // namespace

const LinearSolver& with_rigid_modes(const LinearSolver& plain) {
  static const auto rows = [] {
    std::array<LinearSolver, 3> all{};
    std::copy_n(linear_solvers().begin(), all.size(), all.begin());
    all[0].make = make<0>;
    all[1].make = make<1>;
    all[2].make = make<2>;
    return all;
  }();
  return *std::ranges::find(rows, plain.name, &LinearSolver::name);
}

}  // namespace pfdm
