#pragma once
// The body of a run as a page in the browser shows it: its cells, and what a choice of its frames say.

#include "mesh/fields.h"
#include "physics/tensor.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// A field with a value for each cell.
struct BodyField {
  std::string name;
  std::string si_unit;                      ///< "Pa"; empty: none
  std::vector<std::vector<double>> frames;  ///< [si_unit]
};

/// A point is at a place of the mesh; where a crack parts the cells about it there are several at one place.
struct Body {
  std::vector<std::string> regions;
  std::vector<std::uint8_t> shape;   ///< of each cell: its number of corners; 0: polyhedron
  std::vector<std::uint8_t> region;  ///< of each cell
  std::vector<Index> corners;  ///< points of the cells' corners, of polyhedra those of their faces, in VTK's order
  std::vector<Index> faces;    ///< of each polyhedron its number of faces, and of each face that of its corners
  std::vector<Index> place;    ///< of each point
  std::vector<Vector> points;  ///< [m]
  /// Of a part of a body: of each face, cell by cell in VTK's order, that no other cell of the part has, whether it is
  /// the body's surface. Empty of a whole body.
  std::vector<std::uint8_t> is_surface;
  std::vector<Index> steps;  ///< of the frames
  /// Of the points, frame by frame; of a body that vibrates real and imaginary part of its motion, the same in all
  /// frames [m].
  std::vector<std::vector<Vector>> displacement;
  std::vector<BodyField> fields;   ///< damage where it is, von Mises stress, stress along the load; with heat the rise
  Vector cut_at = Vector::Zero();  ///< where planes across the axes cut first [m]
  int component = 2;               ///< direction of the load
  int flat_axis = -1;              ///< across which the body has one cell; -1: none
  bool vibrates = false;
  std::optional<int> cut_axis{};  ///< across which it is cut at first, -1: none; without a value by the load
};

/// A frame of a run.
struct BodyFrame {
  Index step = 0;
  std::filesystem::path file;  ///< .vtu
};

struct BodySettings {
  std::vector<BodyFrame> frames;   ///< in the order of their steps; as many are taken as the page has room for
  std::vector<double> progress{};  ///< of each, rising: what the frames that are taken are spread over
  std::filesystem::path mesh;      ///< mesh.vtu of the run
  std::optional<Vector> cut_at{};  ///< none: the middle [m]
  int component = 2;
  double most_bytes = 3.3e6;  ///< of all fields in a page
  Index most_cells = 50000;   ///< of more only those at the surface and at the planes through cut_at are taken
};

/// Throws InputError for files that are no frames of one run.
Body read_body(const BodySettings& settings);

/// At most `count` of the steps, but two at least: first and last, both sides of the largest jumps of `progress`, one
/// value for each, and from there on always the one that is farthest from all.
std::vector<std::size_t> chosen_steps(const std::vector<double>& progress, std::size_t count);

}  // namespace pfdm
