#include "cases/program/fracture/case/field_columns.h"

#include "cases/program/input/fields/csv_columns.h"
#include "postproc/files/csv_words.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

namespace pfdm {
namespace {

/// What programs call a column, the surer names first.
struct ColumnNames {
  std::string_view key;
  std::vector<std::string_view> names;
};

const std::vector<ColumnNames>& known_names() {
  static const std::vector<ColumnNames> known{
      {"x", {"coor.X", "MODEL_COORDINATES_X", "X", "x", "COORDINATE_X", "pos_x", "coord_x", "x_c", "Xp"}},
      {"y", {"coor.Y", "MODEL_COORDINATES_Y", "Y", "y", "COORDINATE_Y", "pos_y", "coord_y", "y_c", "Yp"}},
      {"z", {"coor.Z", "MODEL_COORDINATES_Z", "Z", "z", "COORDINATE_Z", "coord_z", "z_c"}},
      {"u",
       {"disp.Horizontal Displacement U", "MODEL_DISPLACEMENT_X", "U", "u", "DISPLACEMENT_X", "disp_x",
        "displacement_x", "u_c", "ux", "u_x", "dx", "Displacement dx"}},
      {"v",
       {"disp.Vertical Displacement V", "MODEL_DISPLACEMENT_Y", "V", "v", "DISPLACEMENT_Y", "disp_y", "displacement_y",
        "v_c", "uy", "u_y", "dy", "Displacement dy"}},
      {"w",
       {"disp.Out-Of-Plane: W", "MODEL_DISPLACEMENT_Z", "W", "w", "DISPLACEMENT_Z", "disp_z", "displacement_z", "w_c",
        "uz", "u_z", "dz", "Displacement dz"}}};
  return known;
}

bool is_pixel(std::string_view unit) {
  const std::string small = lower_case(unit);
  return small == "px" || small == "pixel" || small == "pixels" || small == "pix";
}

/// "X" of "X [mm]", "x" of "x_mm".
std::string_view bare_name(std::string_view name) {
  const std::string_view bare = without_unit(name);
  const std::size_t end = bare.rfind('_');
  if (end == std::string_view::npos || end == 0) return bare;
  const std::string_view unit = bare.substr(end + 1);
  return is_pixel(unit) || is_unit_of(unit, dimension::length) ? bare.substr(0, end) : bare;
}

std::optional<std::size_t> column_called(const CsvTable& file, std::string_view key) {
  const ColumnNames& wanted = *std::ranges::find(known_names(), key, &ColumnNames::key);
  for (const bool with_capitals : {true, false})
    for (const std::string_view name : wanted.names)
      for (std::size_t i = 0; i < file.names.size(); ++i) {
        const std::string_view bare = bare_name(file.names[i]);
        if (bare == name || (!with_capitals && lower_case(bare) == lower_case(name))) return i;
      }
  return std::nullopt;
}

/// As the file says it; empty if it does not.
std::string unit_in_file(const CsvTable& file, std::size_t column) {
  if (!file.units.empty() && !file.units[column].empty() && file.units[column] != "-") return file.units[column];
  const std::string& name = file.names[column];
  if (const auto unit = bracketed_end(name); unit && is_pixel(*unit)) return *unit;
  const std::string_view bare = bare_name(name);
  return bare.size() < name.size() && name[bare.size()] == '_' ? name.substr(bare.size() + 1) : std::string();
}

double metres_of(const ConfigTable& field, const std::string& unit) {
  if (!is_pixel(unit)) return field.in_context([&] { return unit_in_si(unit, dimension::length); });
  if (!field.has("pixel"))
    throw field.error("the file has its columns in pixels: say with \"pixel\" how long one is in the body");
  return field.quantity("pixel");
}

double factor_of_column(const ConfigTable& field, const std::optional<ConfigTable>& own, const CsvTable& file,
                        std::size_t column, std::string_view key) {
  const double factor = own ? own->number("factor", 1.0) : 1.0;
  if (own && own->has("unit")) return factor * metres_of(field, own->string("unit"));
  if (const std::string unit = unit_in_file(file, column); !unit.empty()) return factor * metres_of(field, unit);
  if (field.has("unit")) return factor * metres_of(field, field.string("unit"));
  throw field.error(
      fmt::format("the file does not say in which unit column \"{}\" ({}) is: give \"unit\", as \"mm\" or "
                  "\"px\"",
                  file.names[column], key));
}

}  // namespace

std::optional<std::vector<double>> find_field_column(const ConfigTable& field, const CsvTable& file,
                                                     std::string_view key) {
  std::optional<ConfigTable> own;
  std::optional<std::size_t> column;
  if (field.has(key)) {
    own = field.table(key);
    column = find_column(own->at("column"), file);
  } else {
    column = column_called(file, key);
  }
  if (!column) return std::nullopt;
  field.in_context([&] { file.require_numbers(*column); });
  const double factor = factor_of_column(field, own, file, *column, key);
  std::vector<double> values = file.columns[*column];
  for (double& value : values) value *= factor;
  return values;
}

}  // namespace pfdm
