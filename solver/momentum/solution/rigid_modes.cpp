#include "solver/momentum/solution/rigid_modes.h"

#include "solver/linear/dense_algebra.h"
#include "solver/momentum/momentum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pfdm {
namespace {

constexpr double stiff = 10.0;            // times the least shear modulus
constexpr double least_stiffness = 1e-3;  // of a motion, over that modulus and the size

// A motion of some of the nodes, with those of the held components left out.
using Mode = std::vector<std::pair<Index, Vector>>;

/// Some of the cells, and all nodes that move with them.
struct ConnectedCells {
  std::vector<Index> cells, nodes;
  bool touches_boundary = false;
  bool touches_others = false;  // without an interface between them
};

class RigidModes {
 public:
  RigidModes(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns) {
    for (const IsotropicElasticity& c : unknowns_.sound) softest_ = std::min(softest_, c.mu);
    add_inclusions();
    add_parts();
    n_local_ = count_of(modes_);
    constexpr std::size_t point_supports = 3;
    if (unknowns.periodic.empty() && unknowns.motion.held.size() == point_supports) add_whole_body();
  }

  void build(const MomentumOperator& balance) {
    if (modes_.empty()) return;
    for (Group& group : groups_) move_group(group, balance);
    move_whole_body(balance);
  }

  // With D of the local motions, W of the body's and C of both, [D C; C^T W] share = R^T r.
  void correct(const std::vector<Vector>& r, std::vector<Vector>& z) const {
    if (modes_.empty()) return;
    const Eigen::VectorXd on = projected(r);
    Eigen::VectorXd share(on.size());
    share.head(n_local_) = locally(on.head(n_local_));
    if (n_whole() > 0) {
      share.tail(n_whole()) = give_of_whole_ * (on.tail(n_whole()) - coupling_.transpose() * share.head(n_local_));
      share.head(n_local_) -= locally(coupling_ * share.tail(n_whole()));
    }
    for (std::size_t k = 0; k < modes_.size(); ++k)
      for (const auto& [node, motion] : modes_[k]) z[node] += share[k] * motion;
  }

 private:
  // Members that move in the same n_motions ways, one after the other in the list of modes. What one of them does to
  // another is small beside what it does to itself (as many iterations as with the whole matrix).
  struct Group {
    Index first_mode = 0, n_motions = 0;
    double share = 1.0;                   // of their motions that is missing in the preconditioner
    std::vector<double> length{};         // of each member
    std::vector<Eigen::MatrixXd> give{};  // D^-1 of each
  };

  Index n_whole() const { return count_of(modes_) - n_local_; }

  Eigen::VectorXd locally(const Eigen::VectorXd& on) const {
    Eigen::VectorXd share(on.size());
    for (const Group& group : groups_)
      for (std::size_t i = 0; i < group.give.size(); ++i) {
        const Index first = group.first_mode + static_cast<Index>(i) * group.n_motions;
        share.segment(first, group.n_motions) = group.give[i] * on.segment(first, group.n_motions);
      }
    return share;
  }

  Vector free_part(Index node, const Vector& motion) const {
    return node < unknowns_.n_cells ? motion : Vector(unknowns_.free_directions[node - unknowns_.n_cells] * motion);
  }

  void add_translations(const std::vector<Index>& nodes) {
    for (int axis = 0; axis < 3; ++axis) {
      Mode mode;
      for (const Index node : nodes) mode.emplace_back(node, free_part(node, Vector::Unit(axis)));
      modes_.push_back(std::move(mode));
    }
  }

  void add_rotations(const std::vector<Index>& nodes, double length) {
    Vector middle = Vector::Zero();
    for (const Index node : nodes) middle += unknowns_.place(mesh_, node) / static_cast<double>(nodes.size());
    for (int axis = 0; axis < 3; ++axis) {
      Mode mode;
      for (const Index node : nodes)
        mode.emplace_back(node,
                          free_part(node, Vector::Unit(axis).cross(unknowns_.place(mesh_, node) - middle) / length));
      modes_.push_back(std::move(mode));
    }
  }

  void add_whole_body() {
    std::vector<Index> nodes(unknowns_.n_nodes());
    std::iota(nodes.begin(), nodes.end(), Index{0});
    add_translations(nodes);
    add_rotations(nodes, 1.0);
  }

  double length_of(const ConnectedCells& part) const {
    double volume = 0.0;
    for (const Index cell : part.cells) volume += mesh_.cell_volume[cell];
    return std::cbrt(volume);
  }

  // Connected stiff cells, of one zone or of several as a core in its shell; they rotate, and those that are cut off by
  // interfaces do more than that.
  void add_inclusions() {
    Group group{.first_mode = count_of(modes_), .n_motions = 3};
    for (const ConnectedCells& part : connected([&](Index cell) { return is_stiff(cell); })) {
      if (part.touches_boundary || part.cells.size() < 2 || !part.touches_others) continue;
      group.length.push_back(length_of(part));
      add_rotations(part.nodes, group.length.back());
    }
    groups_.push_back(std::move(group));
  }

  // Adds the motions of parts that interfaces cut off from the rest of the body. The preconditioner finds these motions
  // too, but not well.
  void add_parts() {
    if (unknowns_.split_faces.empty()) return;
    Group group{.first_mode = count_of(modes_), .n_motions = 6, .share = 0.5};
    for (const ConnectedCells& part : connected([](Index) { return true; })) {
      if (part.touches_boundary) continue;
      group.length.push_back(length_of(part));
      add_translations(part.nodes);
      add_rotations(part.nodes, group.length.back());
    }
    groups_.push_back(std::move(group));
  }

  bool is_stiff(Index cell) const { return unknowns_.sound[unknowns_.zone[cell]].mu >= stiff * softest_; }

  bool is_split(Index face) const {
    return unknowns_.node_beside(mesh_, mesh_.owner[face], face) !=
           unknowns_.node_beside(mesh_, mesh_.neighbour[face], face);
  }

  /// Cells of one kind that are connected without crossing an interface.
  template <class IsOne>
  std::vector<ConnectedCells> connected(const IsOne& is_one) const {
    std::vector<ConnectedCells> all;
    CellField<char> seen(mesh_.n_cells(), 0);
    for (Index first = 0; first < mesh_.n_cells(); ++first)
      if (seen[first] == 0 && is_one(first)) all.push_back(part_around(first, is_one, seen));
    return all;
  }

  template <class IsOne>
  ConnectedCells part_around(Index first, const IsOne& is_one, CellField<char>& seen) const {
    ConnectedCells part{.cells = {first}, .nodes = {}};
    seen[first] = 1;
    for (std::size_t i = 0; i < part.cells.size(); ++i) {
      const Index cell = part.cells[i];
      for (const Index f : mesh_.faces_of_cell(cell)) {
        if (const Index node = unknowns_.node_beside(mesh_, cell, f); node >= 0) part.nodes.push_back(node);
        part.touches_boundary = part.touches_boundary || !mesh_.is_interior(f);
        if (!mesh_.is_interior(f) || is_split(f)) continue;
        const Index other = mesh_.across(f, cell);
        part.touches_others = part.touches_others || !is_one(other);
        if (seen[other] != 0 || !is_one(other)) continue;
        seen[other] = 1;
        part.cells.push_back(other);
      }
    }
    part.nodes.insert(part.nodes.end(), part.cells.begin(), part.cells.end());
    std::ranges::sort(part.nodes);  // a face between two of the cells has its node once
    part.nodes.erase(std::unique(part.nodes.begin(), part.nodes.end()), part.nodes.end());
    return part;
  }

  Eigen::VectorXd projected(const std::vector<Vector>& r) const {
    Eigen::VectorXd of_modes(static_cast<Eigen::Index>(modes_.size()));
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      double sum = 0.0;
      for (const auto& [node, motion] : modes_[k]) sum += motion.dot(r[node]);
      of_modes[k] = sum;
    }
    return of_modes;
  }

  // Forces of the balance under these modes together, projected on all modes.
  Eigen::VectorXd answer(const MomentumOperator& balance, Index first, Index stride, Index end) const {
    std::vector<Vector> u(unknowns_.n_unknowns(), Vector::Zero()), image(u.size());
    for (Index k = first; k < end; k += stride)
      for (const auto& [node, motion] : modes_[k]) u[node] = motion;
    balance.apply(u, image);
    return projected(image);
  }

  // All members at once in each way.
  void move_group(Group& group, const MomentumOperator& balance) const {
    const Index n = group.n_motions, n_members = count_of(group.length);
    std::vector<Eigen::MatrixXd> stiffness(group.length.size(), Eigen::MatrixXd(n, n));
    for (Index way = 0; way < n && n_members > 0; ++way) {
      const Index first = group.first_mode;
      const Eigen::VectorXd on = answer(balance, first + way, n, first + n * n_members);
      for (Index i = 0; i < n_members; ++i) stiffness[i].col(way) = on.segment(first + n * i, n);
    }
    group.give.clear();
    for (std::size_t i = 0; i < stiffness.size(); ++i) {  // what has debonded moves freely
      const auto [values, vectors] = symmetric_modes(0.5 * (stiffness[i] + stiffness[i].transpose()));
      const Eigen::VectorXd bounded = values.cwiseMax(least_stiffness * softest_ * group.length[i]);
      group.give.emplace_back(group.share * vectors * bounded.cwiseInverse().asDiagonal() * vectors.transpose());
    }
  }

  void move_whole_body(const MomentumOperator& balance) {
    if (n_whole() == 0) return;
    coupling_.resize(n_local_, n_whole());
    Eigen::MatrixXd whole(n_whole(), n_whole()), relieved(n_local_, n_whole());
    for (Index k = 0; k < n_whole(); ++k) {
      const Eigen::VectorXd on = answer(balance, n_local_ + k, 1, n_local_ + k + 1);
      coupling_.col(k) = on.head(n_local_);
      whole.col(k) = on.tail(n_whole());
      relieved.col(k) = locally(coupling_.col(k));
    }
    give_of_whole_ = inverse_of_symmetric(whole - coupling_.transpose() * relieved);
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  std::vector<Mode> modes_;  // local ones, group by group, then those of the whole body
  std::vector<Group> groups_;
  Index n_local_ = 0;
  double softest_ = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd coupling_;
  Eigen::MatrixXd give_of_whole_;
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
