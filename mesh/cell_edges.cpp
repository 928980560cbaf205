#include "mesh/cell_edges.h"

#include <algorithm>
#include <tuple>

namespace pfdm {

void list_edges(const Mesh& mesh, Index cell, std::vector<CellEdge>& edges) {
  edges.clear();
  for (const Index f : mesh.faces_of_cell(cell)) {
    const auto ids = mesh.points_of_face(f);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto [low, high] = std::minmax(ids[i], ids[(i + 1) % ids.size()]);
      edges.push_back({low, high, {f, f}});
    }
  }
  std::ranges::sort(edges, [](const CellEdge& a, const CellEdge& b) {
    return std::tie(a.low, a.high, a.faces[0]) < std::tie(b.low, b.high, b.faces[0]);
  });
  // Each edge stands there twice in a row, once for each of its faces.
  std::size_t n = 0;
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
    edges[n++] = {edges[i].low, edges[i].high, {edges[i].faces[0], edges[i + 1].faces[0]}};
  edges.resize(n);
}

}  // namespace pfdm
