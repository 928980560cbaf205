#include "cases/program/fracture/case/field_case.h"

#include "cases/program/fracture/case/event_case.h"

#include "cases/program/input/config/csv_keys.h"
#include "cases/program/input/config/key_member.h"
#include "cases/program/input/fields/amount.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr Range places_range{3.0, 20000.0, false, "between 3 and 20000"};

const KeyTable& field_column_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "column of a field",
      .sentence = "A column of coordinates or displacements.",
      .keys = joined(
          {column_keys().keys,
           {{"factor", number(), "1", "Factor of the column's values, as -1 where an axis points the other way."}}})};
  return table;
}

const KeyTable& plane_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "experiment.fields[].plane",
      .sentence = "Where the coordinates of the measurement lie in the body.",
      .keys = {{"origin", point(), "the origin of the body", "Point of the body at x = y = 0 of the measurement."},
               {"x", direction(), "[1, 0, 0]", "Direction in the body of the measurement's x and u."},
               {"y", direction(), "[0, 1, 0]", "Direction in the body of the measurement's y and v."}}};
  return table;
}

const KeyTable& strip_keys() {
  using namespace keys;
  static const KeyTable table{.name = "experiment.fields[].mask[]",
                              .sentence = "A strip along a line, as a crack or an edge, in which no point counts.",
                              .keys = {{"from", point(), "", "One end of the line, in the body."},
                                       {"to", point(), "", "The other end of the line, in the body."},
                                       {"within", quantity(dimension::length, range::positive), "",
                                        "Distance from the line within which points do not count."}}};
  return table;
}

const KeyTable& matched_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "experiment.fields[].matched",
      .sentence = "How frames find their rows in the file of the curve: by a number or time that both have.",
      .keys = {{"column", column_type(), "the number of the frame",
                "Column of the field's file with the number or time, the same in a frame."},
               {"curve_column", column_type(), "", "Column of the curve's file with the same number or time."}}};
  return table;
}

const KeyTable& quality_keys() {
  using namespace keys;
  static const KeyTable table{.name = "experiment.fields[].quality",
                              .sentence = "A column by which points are left out, as sigma or the correlation.",
                              .keys = {{"column", column_type(), "", "Column of the quality of a point."},
                                       {"at_least", number(), "no limit", "Points with less do not count."},
                                       {"at_most", number(), "no limit", "Points with more do not count."}}};
  return table;
}

std::vector<Key> file_rows() {
  using namespace keys;
  return joined(
      {{{"name", text("name"), "", "Name of the field in results."},
        {"specimen", text("name"), "the only one", "Specimen on which it was measured."},
        {"files", list(path(), 1), "", "CSV files of the measurement, one for each frame, or one with all frames."},
        {"frame", column_type(), "a file for each frame",
         "Column with the number of the frame, of one file with all."}},
       csv_mark_keys(),
       {{"x", table(field_column_keys), "found by its name", "Column of the coordinate x before loading."},
        {"y", table(field_column_keys), "found by its name", "Column of the coordinate y before loading."},
        {"z", table(field_column_keys), "found by its name, else 0", "Column of the coordinate z before loading."},
        {"u", table(field_column_keys), "found by its name", "Column of the displacement along x."},
        {"v", table(field_column_keys), "found by its name", "Column of the displacement along y."},
        {"w", table(field_column_keys), "found by its name, else not measured", "Column of the displacement along z."},
        {"unit", text("unit"), "that of the file",
         "Unit of coordinates and displacements where the file does not say it."},
        {"pixel", quantity(dimension::length, range::positive), "none",
         "Length of a pixel in the body, for columns in pixels."},
        {"quality", table(quality_keys), "none", "Column by which points are left out."}}});
}

std::vector<Key> frame_rows() {
  using namespace keys;
  constexpr Range rows{1.0, 1e9, false, "the number of a row, from 1"};
  return {
      {"at", list(either({quantity(dimension::force), quantity(dimension::length)}), 1), "none",
       "Displacement, or force of the loading branch, at which each frame was taken, as the curve's file has it."},
      {"rows", list(whole(rows), 1), "none", "Row of the curve's file, from 1, at which each frame was taken."},
      {"displacement", table(field_column_keys), "none", "Column of the field's file with the curve's displacement."},
      {"matched", table(matched_keys), "none", "How frames find their rows in the file of the curve."}};
}

std::vector<Key> datum_rows() {
  using namespace keys;
  using R = RecordedField;
  using S = FieldSelection;
  return {
      {"plane", table(plane_keys), "x and y of the body", "Where the coordinates of the measurement lie in the body."},
      stored<&R::deviation>("deviation", quantity(dimension::length, range::positive),
                            "Standard deviation of a displacement component of one point.", "estimated from residuals"),
      stored<&R::subset>("subset", quantity(dimension::length, range::positive),
                         "Side of the subsets in the body, whose overlap correlates neighbouring points.",
                         "estimated from residuals"),
      {"rigid_motion", choice("treatment of the rigid motion", {"removed", "kept"}), "\"removed\"",
       "Whether shift and small rotation of each frame are taken out of what is measured and computed."},
      {"mask", tables(strip_keys), "none", "Strips along cracks or edges in which no point counts."},
      stored<&S::most>("places", whole(places_range), "Largest number of places in a frame; more points are averaged."),
      stored<&S::drops_outliers>("drop_outliers", flag(),
                                 "Whether outliers from the points around them are left out.")};
}

FieldPlane read_field_plane(const ConfigTable& table) {
  FieldPlane plane;
  if (!table.has("plane")) return plane;
  const ConfigTable keys = table.table("plane");
  if (const auto origin = keys.find("origin")) plane.origin = read_point(*origin);
  if (const auto x = keys.find("x")) plane.x = read_direction(*x).normalized();
  if (const auto y = keys.find("y")) plane.y = read_direction(*y).normalized();
  if (std::abs(plane.x.dot(plane.y)) > 1e-6)
    throw keys.error(
        fmt::format("x and y must be at right angles; the cosine of theirs is {:.3g}", plane.x.dot(plane.y)));
  return plane;
}

void require_one_way_to_displacements(const ConfigTable& table) {
  const auto n = std::ranges::count_if(std::vector<std::string_view>{"at", "rows", "displacement", "matched"},
                                       [&](std::string_view key) { return table.has(key); });
  if (n != 1)
    throw table.error(
        fmt::format("{}: say when its frames were taken, by one of \"at\", \"rows\", \"displacement\", \"matched\"",
                    n == 0 ? "no frame has a displacement of the curve" : "there are several ways"));
}

/// The files are read for fits alone; no key of them is without effect.
void ask_for_all(const ConfigTable& table) {
  for (const Key* key : table.rows())
    if (const auto value = table.find(key->name); value && value->is_table()) ask_for_all(value->table());
}

FieldSettings read_field(const ConfigTable& table, const ConfigTable& experiment,
                         const std::vector<MeasuredCurve>& specimens) {
  const std::size_t specimen = read_specimen_of(table, specimens, "on which it was measured");
  FieldSettings settings{
      .field = {.name = table.line("name"), .specimen = specimen, .plane = read_field_plane(table), .frames = {}},
      .selection = {},
      .where = table,
      .of_specimen = experiment.tables("specimens")[specimen]};
  read_stored(table, settings.field);
  read_stored(table, settings.selection);
  settings.field.removes_rigid_motion = table.choice("rigid_motion", "removed") == "removed";
  for (const ConfigTable& strip : table.tables("mask"))
    settings.selection.masked.push_back(
        {.from = read_point(strip.at("from")), .to = read_point(strip.at("to")), .within = strip.quantity("within")});
  require_one_way_to_displacements(table);
  ask_for_all(table);
  return settings;
}

}  // namespace

const KeyTable& measured_field_keys() {
  static const KeyTable table{
      .name = "experiment.fields[]",
      .sentence =
          "Displacements measured on a face of the specimen, frame by frame, which pfdm fit meets beside the curve.",
      .keys = keys::joined({file_rows(), frame_rows(), datum_rows()})};
  return table;
}

std::vector<FieldSettings> read_field_settings(const ConfigTable& experiment,
                                               const std::vector<MeasuredCurve>& specimens) {
  std::vector<FieldSettings> fields;
  for (const ConfigTable& table : experiment.tables("fields")) {
    fields.push_back(read_field(table, experiment, specimens));
    for (std::size_t k = 0; k + 1 < fields.size(); ++k)
      if (fields[k].field.name == fields.back().field.name)
        throw table.at("name").error(fmt::format("another field is called \"{}\" already", fields.back().field.name));
  }
  return fields;
}

}  // namespace pfdm
