#include "solver/dynamics/operator_matrix.h"

#include "physics/error.h"

#include <random>
#include <utility>

namespace pfdm {
namespace {

// The cells within some number of faces of a cell.
class Surroundings {
 public:
  explicit Surroundings(const Mesh& mesh) : mesh_(mesh), seen_(mesh.n_cells(), -1) {}

  const std::vector<Index>& of(Index cell, int reach) {
    found_.assign(1, cell);
    seen_[cell] = ++round_;
    std::size_t begin = 0;
    for (int ring = 0; ring < reach; ++ring) {
      const std::size_t end = found_.size();
      for (; begin < end; ++begin)
        for (const Index f : mesh_.faces_of_cell(found_[begin])) {
          if (!mesh_.is_interior(f)) continue;
          const Index other = mesh_.across(f, found_[begin]);
          if (std::exchange(seen_[other], round_) != round_) found_.push_back(other);
        }
    }
    return found_;
  }

 private:
  const Mesh& mesh_;
  std::vector<Index> seen_;
  std::vector<Index> found_;
  Index round_ = 0;
};

// Unknowns of one kind: where each is, and how far it acts.
struct Group {
  std::vector<Index> unknowns;
  std::vector<Index> cells;
  int reach = 0;
  int n_components = 3;
};

// The unknowns whose rows a cell owns.
std::vector<std::vector<Index>> rows_by_cell(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<std::vector<Index>> rows(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) rows[c].push_back(c);
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k)
    rows[mesh.owner[unknowns.face_of_node[k]]].push_back(unknowns.n_cells + static_cast<Index>(k));
  for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k)
    rows[unknowns.pressure_cells[k]].push_back(unknowns.n_nodes() + static_cast<Index>(k));
  return rows;
}

// A node acts through the gradient of its cell, a cell through those of its neighbours; the gradient of a pressure has
// no nodes and takes further cells at the boundary.
std::vector<Group> groups_of(const Mesh& mesh, const Unknowns& unknowns, int reach) {
  Group cells{.unknowns = {}, .cells = {}, .reach = reach}, nodes{.unknowns = {}, .cells = {}, .reach = reach - 1},
      pressures{.unknowns = {}, .cells = {}, .reach = reach + 1, .n_components = 1};
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    cells.unknowns.push_back(c);
    cells.cells.push_back(c);
  }
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k) {
    nodes.unknowns.push_back(unknowns.n_cells + static_cast<Index>(k));
    nodes.cells.push_back(mesh.owner[unknowns.face_of_node[k]]);
    if (mesh.is_interior(unknowns.face_of_node[k])) nodes.reach = reach;
  }
  for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k) {
    pressures.unknowns.push_back(unknowns.n_nodes() + static_cast<Index>(k));
    pressures.cells.push_back(unknowns.pressure_cells[k]);
  }
  return {cells, nodes, pressures};
}

// Lists of entries of the group; those of one list act on different rows.
std::vector<std::vector<std::size_t>> colours_of(const Group& group, Surroundings& around, Index n_cells) {
  std::vector<std::vector<std::size_t>> in_cell(n_cells);
  for (std::size_t k = 0; k < group.cells.size(); ++k) in_cell[group.cells[k]].push_back(k);
  std::vector<Index> colour_of(group.cells.size(), -1);
  std::vector<std::vector<std::size_t>> colours;
  std::vector<std::size_t> taken_by;  // entry that found the colour taken last
  for (std::size_t k = 0; k < group.cells.size(); ++k) {
    for (const Index c : around.of(group.cells[k], 2 * group.reach))
      for (const std::size_t other : in_cell[c])
        if (colour_of[other] >= 0) taken_by[colour_of[other]] = k;
    std::size_t colour = 0;
    while (colour < colours.size() && taken_by[colour] == k) ++colour;
    if (colour == colours.size()) {
      colours.emplace_back();
      taken_by.push_back(k);
    }
    colours[colour].push_back(k);
    colour_of[k] = static_cast<Index>(colour);
  }
  return colours;
}

class Probe {
 public:
  Probe(const Mesh& mesh, const Unknowns& unknowns, const MomentumOperator& balance)
      : mesh_(mesh),
        unknowns_(unknowns),
        balance_(balance),
        around_(mesh),
        rows_(rows_by_cell(mesh, unknowns)),
        x_(unknowns.n_unknowns(), Vector::Zero()),
        image_(x_.size(), Vector::Zero()) {}

  Eigen::SparseMatrix<double> matrix(int reach) {
    entries_.clear();
    for (const Group& group : groups_of(mesh_, unknowns_, reach)) add(group);
    const auto n = static_cast<Eigen::Index>(3 * x_.size());
    Eigen::SparseMatrix<double> K(n, n);
    K.setFromTriplets(entries_.begin(), entries_.end());
    return K;
  }

  // Of the matrix times random displacements, and times random pressures, from what the operator makes of them,
  // relative.
  double error(const Eigen::SparseMatrix<double>& K) {
    const Index first = unknowns_.n_nodes(), end = unknowns_.n_unknowns();
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (Index i = 0; i < first; ++i) x_[i] = Vector(uniform(engine), uniform(engine), uniform(engine));
    double largest = error_now(K);
    for (Index i = first; i < end; ++i) x_[i] = uniform(engine) * Vector::UnitX();
    if (end > first) largest = std::max(largest, error_now(K));
    return largest;
  }

 private:
  // Clears x.
  double error_now(const Eigen::SparseMatrix<double>& K) {
    balance_.apply(x_, image_);
    const auto flat = [](const std::vector<Vector>& v) {
      return Eigen::Map<const Eigen::VectorXd>(v.front().data(), static_cast<Eigen::Index>(3 * v.size()));
    };
    const double difference = (K * flat(x_) - flat(image_)).norm(), size = flat(image_).norm();
    std::fill(x_.begin(), x_.end(), Vector::Zero());
    return difference / size;
  }

  void add(const Group& group) {
    std::vector<std::vector<Index>> reached;
    for (const std::vector<std::size_t>& colour : colours_of(group, around_, mesh_.n_cells())) {
      reached.clear();
      for (const std::size_t k : colour) reached.push_back(around_.of(group.cells[k], group.reach));
      for (int component = 0; component < group.n_components; ++component) {
        for (const std::size_t k : colour) x_[group.unknowns[k]][component] = 1.0;
        balance_.apply(x_, image_);
        for (std::size_t j = 0; j < colour.size(); ++j) {
          const Index unknown = group.unknowns[colour[j]];
          x_[unknown][component] = 0.0;
          for (const Index c : reached[j]) add_column(3 * unknown + component, rows_[c]);
        }
      }
    }
  }

  void add_column(Index column, const std::vector<Index>& rows) {
    for (const Index row : rows)
      for (Index k = 0; k < 3; ++k)
        if (const double value = image_[row][k]; value != 0.0) entries_.emplace_back(3 * row + k, column, value);
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  const MomentumOperator& balance_;
  Surroundings around_;
  std::vector<std::vector<Index>> rows_;
  std::vector<Vector> x_, image_;
  std::vector<Eigen::Triplet<double>> entries_;
};

// Ones, times the mean size of the diagonal, where rows are zero.
void hold(const Unknowns& unknowns, Eigen::SparseMatrix<double>& K) {
  const double size = K.diagonal().cwiseAbs().sum() / static_cast<double>(K.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k) {
    const Tensor held = size * (Tensor::Identity() - unknowns.free_directions[k]);
    const Index first = 3 * (unknowns.n_cells + static_cast<Index>(k));
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < 3; ++j)
        if (held(i, j) != 0.0) entries.emplace_back(first + i, first + j, held(i, j));
  }
  for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k)
    for (Index i = 1; i < 3; ++i) {
      const Index row = 3 * (unknowns.n_nodes() + static_cast<Index>(k)) + i;
      entries.emplace_back(row, row, size);
    }
  const Vector& across = unknowns.plane_normal;
  for (Index node = 0; !across.isZero() && node < unknowns.n_nodes(); ++node)
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < 3; ++j) entries.emplace_back(3 * node + i, 3 * node + j, size * across[i] * across[j]);
  Eigen::SparseMatrix<double> held(K.rows(), K.cols());
  held.setFromTriplets(entries.begin(), entries.end());
  K += held;
}

}  // namespace

Eigen::SparseMatrix<double> matrix_of(const Mesh& mesh, const Unknowns& unknowns, const MomentumOperator& balance) {
  Probe probe(mesh, unknowns, balance);
  for (int reach = 2; reach <= 4; ++reach) {
    Eigen::SparseMatrix<double> K = probe.matrix(reach);
    if (probe.error(K) > 1e-10) continue;
    hold(unknowns, K);
    return K;
  }
  throw ComputationError("the stiffness matrix of this mesh was not found: its cells act on others too far away");
}

}  // namespace pfdm
