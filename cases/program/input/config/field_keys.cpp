#include "cases/program/input/config/field_keys.h"

#include "cases/program/input/config/csv_keys.h"

namespace pfdm {
namespace {

constexpr Range components{1.0, 1e3, false, "the number of a component, from 1"};

std::vector<Key> of_vtk() {
  using namespace keys;
  return {{"file", path(), "or csv",
           "Field in a .vtu or .vtk file, or a .pvd list of such files with times, seen from the case."},
          {"array", text("array"), "of a csv none", "Name of the array of the file, at its points or in its cells."},
          {"component", whole(components), "the only one", "Which of the components of the array, from 1."}};
}

std::vector<Key> of_csv() {
  using namespace keys;
  return {{"csv", path(), "or file", "CSV file with a value at a scattered point in each row, seen from the case."},
          {"column", column_type(), "of a file none", "Column of the CSV file with the values."},
          {"x", column_type(), "the field does not depend on x", "Column of the CSV file with the points' x."},
          {"y", column_type(), "the field does not depend on y", "Column of the CSV file with the points' y."},
          {"z", column_type(), "the field does not depend on z", "Column of the CSV file with the points' z."}};
}

std::vector<Key> of_both() {
  using namespace keys;
  return {{"unit", text("unit"), "none", "Unit of the field's values; required where the value has a dimension."},
          {"length_unit", unit(dimension::length), "", "Unit of the points' coordinates."},
          {"reference", text("quantity"), "0", "What is subtracted, as the temperature of a body without strain."},
          {"between", choice("interpolation", {"linear", "nearest"}), "\"linear\"",
           "Value between points or centres of cells: linear, or that of the nearest."},
          {"tolerance", quantity(dimension::length, range::not_negative), "1 % of the field's diagonal",
           "How far outside the field a place may be; it has the value of the field's nearest place."},
          {"duration", quantity(dimension::time, range::positive), "of a file without times none",
           "Time of a .pvd list at which the load parameter is 1; the field follows the list in between."},
          {"time_unit", unit(dimension::time), "\"s\"", "Unit of the times of a .pvd list."}};
}

}  // namespace

const KeyTable& field_keys() {
  static const KeyTable table{.name = "field",
                              .sentence = "Values out of a file in place of a plain one, by the place.",
                              .keys = keys::joined({of_vtk(), of_csv(), csv_mark_keys(), of_both()})};
  return table;
}

}  // namespace pfdm
