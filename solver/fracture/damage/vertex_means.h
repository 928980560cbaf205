#pragma once
// Means of a field about cells of any shape: over a cell's vertices the means over the cells around each. Weights 1 +
// lambda . r, r from the place of the mean, make them exact for fields that are linear, so that the mean of a smooth
// one is its value but for O(h^2). At the body's surface cells are mirrored, as befits fields without a slope across
// it: r is along the surface there. Weights keep to 1/4 to 4, which some polyhedra at the surface would exceed. Of
// equal hexahedra they are 1/4, 1/2, 1/4 in each direction.

#include "mesh/fields.h"
#include "mesh/mesh.h"

#include <vector>

namespace pfdm {

class VertexMeans {
 public:
  /// Means about these cells, in ascending order; the others keep their values.
  VertexMeans(const Mesh& mesh, std::vector<Index> cells);

  const std::vector<Index>& cells() const { return cells_; }
  /// The means A v, by cell of the mesh.
  CellField<double> of(const CellField<double>& v) const;
  /// A^T v.
  CellField<double> spread(const CellField<double>& v) const;
  /// Covariance of the places of the i-th cell's mean about its centre [m^2].
  Tensor covariance(std::size_t i) const;

 private:
  struct Part {
    Index of = 0;  // a vertex or a cell
    double weight = 0.0;
  };
  struct Parts {  // of each row of a matrix
    std::vector<std::size_t> offset{0};
    std::vector<Part> parts;
    Parts transposed(std::size_t n_columns) const;
    template <class Value>
    double row(Index i, const Value& value) const;
  };
  void weigh_cells_around_vertices(const std::vector<Index>& points, const std::vector<Index>& vertex_of_point);
  void weigh_vertices(const std::vector<Index>& vertex_of_point);

  const Mesh* mesh_;
  std::vector<Index> cells_;
  CellField<char> is_averaged_;
  std::vector<Tensor> around_vertex_;  // covariances of the places of the means about each vertex [m^2]
  std::vector<Vector> places_;         // those that the means stand for: the vertices, where their cells allow it [m]
  Parts vertices_of_cell_, cells_of_vertex_;                // rows: averaged cells; vertices
  Parts cells_of_vertex_transposed_, vertices_transposed_;  // rows: cells of the mesh; vertices
};

}  // namespace pfdm
