#pragma once
// Which values the gradient of a cell is made of (gradient.h).

#include "mesh/mesh.h"

#include <vector>

namespace pfdm {

/// Prisms that use two rings: those of plane layers whose one ring is unstable, or all whose triangles lie in a plane
/// mesh.
enum class WideTriangles : char { none, unstable, in_plane };

struct GradientSettings {
  CellField<Index> zone;                 ///< cells of the same zone sample each other
  FaceField<Index> node_of_face;         ///< sample nodes on faces (-1: none), numbered from n_cells on; or empty
  FaceField<Index> neighbour_node{};     ///< of the neighbour's side, where the sides have nodes of their own; likewise
  FaceField<char> cut{};                 ///< nonzero: the cells beside the face do not sample each other; or empty
  CellField<Vector> shift{};             ///< of the point of a cell's value from the cell's centre [m]; or empty
  Vector plane_normal = Vector::Zero();  ///< direction in which the gradient is zero, if any
  WideTriangles wide_triangles = WideTriangles::none;
  std::vector<char> wanted;        ///< nonzero for cells whose gradient is needed; empty: all
  bool zero_if_deficient = false;  ///< too few neighbours: gradient zero; otherwise InputError
};

struct GradientSample {
  Index node = 0;
  Index through = -1;  ///< of prisms: the cell of the ring before, if that is not the cell itself
};

struct CellSamples {
  bool wide = false;                      ///< two rings, with weight |d|^-2
  std::vector<GradientSample> samples{};  ///< cells, then nodes on faces, by number; empty: no gradient
};

/// Face neighbours of the same zone and nodes on faces, ring by ring. Keeps references.
class GradientSampling {
 public:
  /// `node`: position of every node, of cells first [m].
  GradientSampling(const Mesh& mesh, const GradientSettings& settings, const std::vector<Vector>& node);

  /// Throws InputError where the samples have no gradient (GradientSettings::zero_if_deficient).
  CellSamples about(Index cell) const;

 private:
  std::vector<GradientSample> rings(Index cell, int n, bool within_layer) const;
  struct Way {
    Index cell = 0;
    bool is_between = false, within_layer = false;
  };
  void extend(const Way& way, std::vector<GradientSample>& cells, std::vector<GradientSample>& nodes) const;
  Index node_beside(Index cell, Index face) const;
  bool is_cut(Index face) const { return settings_.cut.size() > 0 && settings_.cut[face] != 0; }
  bool has_full_rank(Index cell, const std::vector<GradientSample>& samples) const;
  void widen_prisms();
  bool lies_in_plane(Index prism) const;
  bool is_of_plane_layer(Index prism, const Vector& normal) const;
  bool has_surface_beside(Index prism) const;
  std::vector<Index> sides(Index prism) const;  // its quadrilaterals
  double largest_rise(Index cell, const std::vector<GradientSample>& samples) const;

  const Mesh& mesh_;
  const GradientSettings& settings_;
  const std::vector<Vector>& node_;
  std::vector<char> wide_;  // per cell
};

}  // namespace pfdm
