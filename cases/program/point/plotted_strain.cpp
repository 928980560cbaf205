#include "cases/program/point/plotted_strain.h"

#include "cases/program/session/report_parts.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

const DisplayUnit percent{.factor = 100.0, .name = "%"};

}  // namespace

bool is_shear(std::string_view component) { return component[0] != component[1]; }

std::vector<double> plotted_strain(const CsvTable& table, std::string_view component, std::string_view before) {
  return in_unit(table.column(fmt::format("{}strain_{}", before, component)),
                 {.factor = (is_shear(component) ? 2.0 : 1.0) * percent.factor, .name = percent.name});
}

std::string strain_title(std::string_view component) {
  return fmt::format("{} {} [%]", is_shear(component) ? "engineering shear" : "strain", component);
}

}  // namespace pfdm
