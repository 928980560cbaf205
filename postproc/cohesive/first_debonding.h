#pragma once
// The first debonding of a run: the step after which a place of a surface first counts as debonded (cohesive_law.h).
// first_debonding.json keeps it for a restart.

#include "postproc/cohesive/columns.h"
#include "postproc/curves/curve_csv.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct FirstDebonding {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::string surface;
  Index step = 0;  ///< after which it is there
  /// Of the debonded places about the pole with the larger debonded area, polar angles from and to [rad]; NaN on
  /// planes.
  double polar_from = none, polar_to = none;
  double angle = none;  ///< polar angle of the cap of that area about that pole [rad]; NaN on planes
};

class DebondingWatch {
 public:
  /// Keeps a reference to the sets. `axis`: a unit vector from which polar angles are counted. Columns that `damage`,
  /// that before the first step, has debonded already do not count.
  DebondingWatch(const std::vector<ColumnSet>& sets, const Vector& axis, const CellField<double>& damage);

  bool has_surfaces() const { return !sets_.empty(); }
  /// The surface with the largest debonded area at this state; nothing as long as all hold. `output` is asked only
  /// where cohesive faces may have debonded.
  std::optional<FirstDebonding> look(const CellField<double>& damage, const StepReport& report,
                                     const std::function<OutputFields()>& output) const;

 private:
  const std::vector<ColumnSet>& sets_;
  Vector axis_;
  std::vector<std::vector<bool>> before_;  // set by set, column by column: debonded before the first step
};

/// For summary.json: load, displacement and force of the last step before and of the step after which the surface has
/// debonded, and the angles, with units in their names; NaN where there was no debonding. `component`: of the force.
std::map<std::string, double> debonding_figures(const std::optional<FirstDebonding>& first,
                                                std::span<const CurveRow> rows, int component);

inline constexpr const char* first_debonding_file = "first_debonding.json";
/// Written whole or not at all. Throws ComputationError if the file cannot be written.
void write_first_debonding(const std::filesystem::path& path, const FirstDebonding& first);
/// What was written, if its step is at most `last_step`; a file of a later step is removed. Throws InputError for what
/// is no such file.
std::optional<FirstDebonding> take_first_debonding(const std::filesystem::path& path, Index last_step);

}  // namespace pfdm
