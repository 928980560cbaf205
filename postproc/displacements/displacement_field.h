#pragma once
// Displacements measured on a face of a body, as by digital image correlation (DIC), frame by frame.

#include "physics/tensor.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pfdm {

/// Where the coordinates of a measurement lie in the body: at origin + x a + y b + z n.
struct FieldPlane {
  Vector origin = Vector::Zero();                   ///< [m]
  Vector x = Vector::UnitX(), y = Vector::UnitY();  ///< unit vectors, at right angles
  Vector normal() const { return x.cross(y); }      ///< n
  Vector axis(int k) const { return k == 0 ? x : k == 1 ? y : normal(); }
  Vector at(const Vector& p) const { return origin + p[0] * x + p[1] * y + p[2] * normal(); }
};

/// A frame as the file has it; points without a value are left out.
struct RecordedFrame {
  std::string name;            ///< of its file, or its number
  double displacement = 0.0;   ///< of the specimen's record at which it was taken [m]
  std::vector<Vector> points;  ///< coordinates in the plane [m]
  std::vector<Vector> u;       ///< displacement along the plane's axes [m]; the third is 0 where it is not measured
};

struct RecordedField {
  std::string name;
  std::size_t specimen = 0;
  FieldPlane plane{};
  int n_components = 2;    ///< 3: out of the plane too
  double deviation = 0.0;  ///< standard deviation of a component of one point [m]; 0: not known
  double subset = 0.0;     ///< side of the squares that were correlated [m]; 0: not known
  bool removes_rigid_motion = true;
  std::vector<RecordedFrame> frames;  ///< in the order of their displacements
  std::vector<std::string> told{};    ///< what was left out in reading, a sentence each
};

/// Points whose mean displacement is one datum.
struct FieldPlace {
  std::vector<Vector> points;  ///< in the body [m]
};

/// Of all their coordinates, to the last bit (FNV-1a).
std::uint64_t hash_of(const std::vector<FieldPlace>& places);

struct FieldFrame {
  std::string name;
  double displacement = 0.0;        ///< of the specimen's record [m]
  std::vector<std::size_t> places;  ///< numbers of places
  std::vector<Vector> middle;       ///< of their points, in the plane [m]
  std::vector<Vector> u;            ///< means of what was measured there, along the plane's axes [m]
  std::vector<double> n_points;     ///< of each
};

/// What counts in a fit.
struct MeasuredField {
  std::string name;
  std::size_t specimen = 0;
  FieldPlane plane{};
  int n_components = 2;
  double deviation = 0.0, subset = 0.0;  ///< as recorded
  bool removes_rigid_motion = true;
  double spacing = 0.0;  ///< of the recorded points [m]
  double pitch = 0.0;    ///< of the places [m]
  std::vector<FieldFrame> frames;
  std::vector<std::string> told{};  ///< what was left out and averaged, a sentence each

  /// Of a rigid motion that is taken out of each frame: two or three shifts and one or three rotations; 0 if it stays.
  int n_rigid() const { return removes_rigid_motion ? (n_components == 2 ? 3 : 6) : 0; }
  /// Data of a frame.
  std::size_t n_data(const FieldFrame& frame) const {
    return frame.places.size() * static_cast<std::size_t>(n_components) - static_cast<std::size_t>(n_rigid());
  }
};

struct MeasuredFields {
  std::vector<MeasuredField> fields;
  std::vector<FieldPlace> places;  ///< of all of them
};

}  // namespace pfdm
