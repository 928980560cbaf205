#pragma once
// The force-displacement curve: rows of numbers, as a file that other tools rely on, and back.

#include "postproc/files/growing_file.h"
#include "solver/fracture/model/state.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

/// One load step as seen from the patch that is pulled.
struct CurveRow {
  Index step = 0;
  double load = 0.0;              ///< load parameter t
  double displacement = 0.0;      ///< one component of the patch's mean displacement [m]
  Vector force = Vector::Zero();  ///< on the patch [N]
  EnergyAccount energy;           ///< [J]
  double max_damage = 0.0;        ///< [-]
  double damaged_volume = 0.0;    ///< [m^3]
  Index staggered_iterations = 0;
  friend bool operator==(const CurveRow&, const CurveRow&) = default;
};

inline constexpr const char* curve_file = "force_displacement.csv";
std::string curve_header();
/// Of the columns of energies, here and in the table of means, the last ones that files of earlier builds may lack:
/// that of interfaces with rate.
inline constexpr std::size_t n_newer_energies = 1;
/// The row as a line of the file, with its line break: the shortest digits that give the same numbers back.
std::string curve_line(const CurveRow& row);

/// What a step is without a patch: no force, no displacement.
CurveRow curve_row(const StepReport& report);
/// Component 0, 1, 2 (x, y, z) of the displacement of the patch with this number in Mesh::patches.
CurveRow curve_row(const StepReport& report, Index patch, int component);

/// Numbers come back exactly as written. A last line without its line break is torn and is left out. Throws InputError
/// that names file and line for anything else that is not a row.
std::vector<CurveRow> read_curve(const std::filesystem::path& path);

/// A curve whose file has all its rows after each write().
class CurveFile {
 public:
  /// Starts a curve without rows. Throws ComputationError if the file cannot be written, as write() does.
  explicit CurveFile(std::filesystem::path path);
  /// Continues a curve on the disk, of which the rows up to `last_step` are kept; without a file, from none.
  /// Throws InputError likewise to read_curve.
  CurveFile(std::filesystem::path path, Index last_step);

  /// The file has the row after write().
  void add(const CurveRow& row) { rows_.push_back(row); }
  void write();
  const std::vector<CurveRow>& rows() const { return rows_; }

 private:
  CurveFile(std::filesystem::path path, std::vector<CurveRow> rows);
  std::string text() const;

  std::vector<CurveRow> rows_;
  GrowingFile file_;
  std::size_t n_written_ = 0;  // rows that the file has
};

}  // namespace pfdm
