#include "cases/program/fracture/case/event_case.h"

#include "cases/program/input/config/key_member.h"
#include "physics/quantity_text.h"
#include "postproc/curves/curve_misfit.h"
#include "postproc/curves/recorded_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pfdm {
namespace {

constexpr Range number_range{1.0, 1000.0, false, "between 1 and 1000"};
constexpr Range least_fall_range{0.0, 1.0, true, "above 0 and below 1"};

KeyTable measured_keys(std::string_view name, const Dimension& due) {
  using namespace keys;
  return {
      .name = name,
      .sentence = "A measured value with its uncertainty.",
      .keys = {{"value", quantity(due), "", "Value as the file of the record has it, before its factor and the toe."},
               {"deviation", quantity(due, range::positive), "", "Standard deviation of the value."}}};
}
const KeyTable& measured_length_keys() {
  static const KeyTable table = measured_keys("measured length", dimension::length);
  return table;
}
const KeyTable& measured_force_keys() {
  static const KeyTable table = measured_keys("measured force", dimension::force);
  return table;
}

Key of_jumps(Key key) {
  key.only = "jump";
  return key;
}

constexpr EventFigure figures_of_jump[] = {EventFigure::displacement, EventFigure::force_before,
                                           EventFigure::force_after};
constexpr EventFigure figures_of_greatest[] = {EventFigure::displacement, EventFigure::force};

void read_figures(const ConfigTable& table, MeasuredEvent& event) {
  const auto read = [&](const auto& figures) {
    for (const EventFigure figure : figures) {
      if (!table.has(name_of(figure))) continue;
      const ConfigTable measured = table.table(name_of(figure));
      event.figures.push_back(
          {.figure = figure, .value = measured.quantity("value"), .deviation = measured.quantity("deviation")});
    }
  };
  event.kind == EventKind::greatest_force ? read(figures_of_greatest) : read(figures_of_jump);
}

bool has_displacement(const MeasuredEvent& event) {
  return std::ranges::count(event.figures, EventFigure::displacement, &MeasuredFigure::figure) > 0;
}

void require_displacement(const ConfigTable& table, const MeasuredEvent& event) {
  if (event.kind == EventKind::greatest_force && event.figures.empty())
    throw table.error("state \"force\", \"displacement\" or both: the largest of noisy rows is larger than the force");
  if (event.kind == EventKind::greatest_force || has_displacement(event)) return;
  if (event.kind == EventKind::first_debonding)
    throw table.error("state its \"displacement\": no record of the force tells what debonds");
  if (!event.figures.empty())
    throw table.error("a jump with forces needs its displacement, too; without any of them it is found in the record");
}

StatedEvent read_event(const ConfigTable& table, const std::vector<MeasuredCurve>& specimens) {
  MeasuredEvent event{.specimen = read_specimen_of(table, specimens, "whose event it is")};
  read_stored(table, event);
  if (table.choice("event") == "greatest_force") event.kind = EventKind::greatest_force;
  if (table.choice("event") == "first_debonding") event.kind = EventKind::first_debonding;
  read_figures(table, event);
  require_displacement(table, event);
  return {.event = std::move(event), .where = table};
}

/// What is stated of the file's numbers, as its rows were made those of the curve.
void prepare_like_rows(const MeasuredCurve& specimen, MeasuredEvent& event) {
  for (MeasuredFigure& figure : event.figures) {
    const bool is_displacement = figure.figure == EventFigure::displacement;
    const double factor = is_displacement ? specimen.displacement_factor : specimen.force_factor;
    figure.value = factor * figure.value - (is_displacement ? specimen.origin : 0.0);
    figure.deviation *= std::abs(factor);
  }
}

std::string number_text(const MeasuredEvent& event, std::size_t n) {
  if (!event.number || n == 0) return "no such jump";
  return fmt::format("{} such jump{}, no jump {}", n, n == 1 ? "" : "s", *event.number);
}

/// Of the rows of the record; forces are told alone, for the rows on both sides are data already.
void find_jump(const ConfigTable& table, const SampledCurve& record, MeasuredEvent& event) {
  const std::vector<RecordedJump> jumps = recorded_jumps(record, event.least_fall);
  const std::size_t wanted = static_cast<std::size_t>(event.number.value_or(1));
  if (jumps.size() < wanted)
    throw table.error(fmt::format(
        "\"{}\" has {}: its force falls by more than {:g} % of the largest (least_fall), and by more than four "
        "standard errors of lines through eight rows before and after; state the jump's displacement",
        record.name, number_text(event, jumps.size()), 100.0 * event.least_fall));
  const auto fall = [](const RecordedJump& jump) { return jump.force_before - jump.force_after; };
  const RecordedJump& jump = event.number ? jumps[wanted - 1] : *std::ranges::max_element(jumps, {}, fall);
  event.is_found = true;
  event.place = jump.displacement;
  event.figures = {{.figure = EventFigure::displacement, .value = jump.displacement, .deviation = jump.deviation},
                   {EventFigure::force_before, jump.force_before, jump.deviation_before, false},
                   {EventFigure::force_after, jump.force_after, jump.deviation_after, false}};
}

/// Where the record has it.
void place_event(const ConfigTable& table, const MeasuredCurve& specimen, MeasuredEvent& event) {
  const SampledCurve& record = specimen.curve;
  const auto displacement = std::ranges::find(event.figures, EventFigure::displacement, &MeasuredFigure::figure);
  if (displacement == event.figures.end()) {
    event.place = record.x[static_cast<std::size_t>(std::ranges::max_element(record.y) - record.y.begin())];
    return;
  }
  event.place = displacement->value;
  if (event.place >= record.x.front() && event.place <= record.x.back()) return;
  const auto in_file = [&](double x) { return (x + specimen.origin) / specimen.displacement_factor + 0.0; };  // not -0
  const auto [least, greatest] = std::minmax({in_file(record.x.front()), in_file(record.x.back())});
  throw table.at("displacement")
      .error(fmt::format("\"{}\" was recorded between {} and {}{}", record.name, quantity_text(least, "m"),
                         quantity_text(greatest, "m"),
                         specimen.displacement_factor == 1.0 ? "" : " in its file, before the factor"));
}

void require_known_noise(const ConfigTable& table, const std::vector<MeasuredCurve>& specimens) {
  for (const MeasuredCurve& specimen : specimens)
    if (specimen.curve.deviation.empty())
      throw table.error(fmt::format(
          "events have standard deviations of their own, and \"{}\" has none: with what weight they count beside its "
          "rows is not known; give [[experiment.specimens]] deviation",
          specimen.curve.name));
  table.in_context([&] {
    require_deviations(specimens);
    return true;
  });
}

bool is_same(const MeasuredEvent& a, const MeasuredEvent& b) {
  if (a.kind != b.kind || a.specimen != b.specimen) return false;
  return a.kind != EventKind::jump || a.place == b.place ||
         (a.number && a.number == b.number && a.least_fall == b.least_fall);
}

}  // namespace

std::size_t read_specimen_of(const ConfigTable& table, const std::vector<MeasuredCurve>& specimens,
                             std::string_view what) {
  const auto named = table.find("specimen");
  if (!named) {
    if (specimens.size() == 1) return 0;
    throw table.error(fmt::format("there are several specimens: say with \"specimen\" {}", what));
  }
  std::vector<std::string> names;
  for (const MeasuredCurve& specimen : specimens) names.push_back(specimen.curve.name);
  return static_cast<std::size_t>(std::ranges::find(names, named->one_of(names, "specimen")) - names.begin());
}

const KeyTable& event_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "experiment.events[]",
      .sentence = "An event of a measured curve, which pfdm fit meets beside the curve.",
      .keys = {{"event", choice("event of a curve", {"jump", "greatest_force", "first_debonding"}), "",
                "What happens: the force falls at once, or is the greatest, or something debonds for the first time."},
               {"specimen", text("name"), "the only one", "Specimen in whose test it happened."},
               of_jumps(stored<&MeasuredEvent::number>(
                   "number", whole(number_range),
                   "Number of the jump along the curve, measured and computed, of those with least_fall.",
                   "the nearest one; of those to be found the largest")),
               of_jumps(stored<&MeasuredEvent::least_fall>(
                   "least_fall", number(least_fall_range),
                   "Share of the largest force by which the force falls in one step of a jump.")),
               {"displacement", keys::table(measured_length_keys), "of a jump found in the record; of others no datum",
                "Displacement of the event, with its standard deviation."},
               {"force_before", keys::table(measured_force_keys), "no datum",
                "Force right before the jump or the debonding.", "jump first_debonding"},
               {"force_after", keys::table(measured_force_keys), "no datum",
                "Force right after the jump or the debonding.", "jump first_debonding"},
               {"force", keys::table(measured_force_keys), "no datum", "The greatest force.", "greatest_force"}},
      .decided_by = "event"};
  return table;
}

std::vector<StatedEvent> read_events(const ConfigTable& experiment, const std::vector<MeasuredCurve>& specimens) {
  std::vector<StatedEvent> events;
  for (const ConfigTable& table : experiment.tables("events")) events.push_back(read_event(table, specimens));
  return events;
}

std::vector<MeasuredEvent> events_in_records(const std::vector<StatedEvent>& stated,
                                             const std::vector<MeasuredCurve>& specimens) {
  std::vector<MeasuredEvent> events;
  for (const auto& [as_stated, table] : stated) {
    require_known_noise(table, specimens);
    MeasuredEvent event = as_stated;
    const MeasuredCurve& specimen = specimens[event.specimen];
    if (event.figures.empty()) {
      find_jump(table, specimen.curve, event);
    } else {
      prepare_like_rows(specimen, event);
      place_event(table, specimen, event);
    }
    if (std::ranges::any_of(events, [&](const MeasuredEvent& other) { return is_same(other, event); }))
      throw table.error(fmt::format("this {} is named twice", name_of(event.kind)));
    events.push_back(std::move(event));
  }
  return events;
}

}  // namespace pfdm
