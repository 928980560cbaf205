#include "solver/homogenization/rigid_modes.h"

#include "solver/momentum/momentum.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace pfdm {
namespace {

constexpr double stiff = 10.0;  // times the least shear modulus

// A motion of some of the nodes, with those of the held components left out.
using Mode = std::vector<std::pair<Index, Vector>>;

class RigidModes {
 public:
  RigidModes(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns) {
    add_inclusions();
    constexpr std::size_t point_supports = 3;
    if (unknowns.periodic.empty() && unknowns.motion.held.size() == point_supports) add_whole_body();
    if (!modes_.empty()) factor();
  }

  void correct(const std::vector<Vector>& r, std::vector<Vector>& z) const {
    if (modes_.empty()) return;
    const Eigen::VectorXd share = factors_.solve(projected(r));
    for (std::size_t k = 0; k < modes_.size(); ++k)
      for (const auto& [node, motion] : modes_[k]) z[as_size(node)] += share[static_cast<Eigen::Index>(k)] * motion;
  }

 private:
  Vector place(Index node) const {
    return node < unknowns_.n_cells ? mesh_.cell_centre[node]
                                    : mesh_.face_centre[unknowns_.face_of_node[as_size(node - unknowns_.n_cells)]];
  }

  Vector free_part(Index node, const Vector& motion) const {
    return node < unknowns_.n_cells ? motion
                                    : Vector(unknowns_.free_directions[as_size(node - unknowns_.n_cells)] * motion);
  }

  void add_rotations(const std::vector<Index>& nodes) {
    Vector middle = Vector::Zero();
    for (const Index node : nodes) middle += place(node) / static_cast<double>(nodes.size());
    for (int axis = 0; axis < 3; ++axis) {
      Mode mode;
      for (const Index node : nodes)
        mode.emplace_back(node, free_part(node, Vector::Unit(axis).cross(place(node) - middle)));
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
    double softest = std::numeric_limits<double>::infinity();
    for (const IsotropicElasticity& c : unknowns_.sound) softest = std::min(softest, c.mu);
    CellField<char> seen(as_size(mesh_.n_cells()), 0);
    for (Index first = 0; first < mesh_.n_cells(); ++first) {
      const Index zone = unknowns_.zone[first];
      if (seen[first] != 0 || unknowns_.sound[as_size(zone)].mu < stiff * softest) continue;
      if (const std::vector<Index> nodes = inclusion_around(first, zone, seen); !nodes.empty()) add_rotations(nodes);
    }
  }

  // The connected cells of the zone, and the nodes of their faces; none if the inclusion touches the boundary.
  std::vector<Index> inclusion_around(Index first, Index zone, CellField<char>& seen) const {
    std::vector<Index> cells{first}, nodes;
    bool is_inside = true;
    seen[first] = 1;
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (const Index f : mesh_.faces_of_cell(cells[i])) {
        if (const Index node = unknowns_.node_beside(mesh_, cells[i], f); node >= 0) nodes.push_back(node);
        is_inside = is_inside && mesh_.is_interior(f);
        if (!mesh_.is_interior(f)) continue;
        const Index other = mesh_.across(f, cells[i]);
        if (seen[other] != 0 || unknowns_.zone[other] != zone) continue;
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

  // With the elasticity of the zones: an approximation where it varies within them.
  void factor() {
    MomentumOperator balance(mesh_, unknowns_);
    CellField<IsotropicElasticity> moduli(as_size(mesh_.n_cells()));
    for (Index c = 0; c < mesh_.n_cells(); ++c) moduli[c] = unknowns_.sound[as_size(unknowns_.zone[c])];
    balance.set_moduli(moduli, CellField<double>(as_size(mesh_.n_cells()), 1.0));
    const auto n = static_cast<Eigen::Index>(modes_.size());
    Eigen::MatrixXd coarse(n, n);
    std::vector<Vector> u(as_size(unknowns_.n_unknowns())), image(u.size());
    for (Eigen::Index k = 0; k < n; ++k) {
      std::fill(u.begin(), u.end(), Vector::Zero());
      for (const auto& [node, motion] : modes_[static_cast<std::size_t>(k)]) u[as_size(node)] = motion;
      balance.apply(u, image);
      coarse.col(k) = projected(image);
    }
    factors_.compute(coarse);
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  std::vector<Mode> modes_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

class WithRigidModes : public Preconditioner {
 public:
  WithRigidModes(std::unique_ptr<Preconditioner> plain, const Mesh& mesh, const Unknowns& unknowns)
      : plain_(std::move(plain)), modes_(mesh, unknowns) {}

  void build(const BlockTriplets& matrix) override { plain_->build(matrix); }
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
