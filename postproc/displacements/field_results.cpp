#include "postproc/displacements/field_results.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <utility>

namespace pfdm {

FittedField::Frame figures_of(const MetFrame& met) {
  return {.name = met.frame->name,
          .displacement = met.frame->displacement,
          .places = met.frame->places.size(),
          .rms = met.left.norm() / std::sqrt(static_cast<double>(met.left.size())),
          .rms_measured = met.rms_without_motion};
}

CsvTable field_table(const MeasuredField& field, const std::vector<MetFrame>& frames, const std::string& case_name) {
  CsvTable table;
  table.comments.push_back(
      fmt::format("field {} of the fit of {}: measured and computed displacements, the latter with the rigid motion of "
                  "the measured ones, and computed less measured",
                  field.name, case_name));
  const auto add = [&](std::string name, const auto& value) {
    std::vector<double> column;
    for (std::size_t f = 0; f < frames.size(); ++f)
      for (std::size_t p = 0; p < frames[f].frame->places.size(); ++p) column.push_back(value(f, p));
    table.add(std::move(name), std::move(column));
  };
  add("frame", [](std::size_t f, std::size_t) { return static_cast<double>(f + 1); });
  add("displacement_m", [&](std::size_t f, std::size_t) { return frames[f].frame->displacement; });
  add("x_m", [&](std::size_t f, std::size_t p) { return frames[f].frame->middle[p][0]; });
  add("y_m", [&](std::size_t f, std::size_t p) { return frames[f].frame->middle[p][1]; });
  constexpr const char* axes[] = {"x", "y", "z"};
  for (const auto& [what, of_measured, of_left] :
       {std::tuple("measured", 1.0, 0.0), std::tuple("model", 1.0, 1.0), std::tuple("residual", 0.0, 1.0)})
    for (int c = 0; c < field.n_components; ++c)
      add(fmt::format("{}_{}_m", what, axes[c]), [&, a = of_measured, b = of_left](std::size_t f, std::size_t p) {
        const auto i = static_cast<Eigen::Index>(p);
        return a * frames[f].measured(i, c) + b * frames[f].left(i, c);
      });
  return table;
}

}  // namespace pfdm
