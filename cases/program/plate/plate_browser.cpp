#include "cases/program/plate/plate_browser.h"

#include "postproc/browser/cell_body.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

std::string in_minutes(double seconds) { return fmt::format("{:.4g} min", seconds / 60.0); }

/// "the surface is 0.53 K warmer in the mean, 0.93 K at most"
std::string warmer(double mean, double largest) {
  return fmt::format("the surface is {:.3g} K warmer in the mean, {:.3g} K at most", mean, largest);
}

std::vector<std::string> headline_of(const PlateCase& c, const ReadSummary& summary) {
  std::vector<std::string> sentences{
      fmt::format("First resonance at {}.", shown(summary.number("first_resonance_Hz"), "Hz"))};
  if (const double driven = summary.number("driving_frequency_Hz"); std::isfinite(driven))
    sentences.push_back(fmt::format("Driven at {} with {:.3g} g0.", shown(driven, "Hz"), c.excitation.level / 9.80665));
  if (c.heating)
    sentences.push_back(
        fmt::format("After {} {}; {} go into the body.", in_minutes(c.heating->duration),
                    warmer(summary.number("surface_mean_rise_K"), summary.number("surface_largest_rise_K")),
                    shown(summary.number("mechanical_power_W"), "W")));
  return sentences;
}

/// Of the frames, whose steps are the rows at their times.
Body body_of(const PlateCase& c, const std::vector<double>& times, const fs::path& results) {
  Index axis = 0;
  c.direction.cwiseAbs().maxCoeff(&axis);
  CellBodySettings settings{.frames = {},
                            .fields = {{.array = "temperature_rise", .name = "temperature rise", .si_unit = "K"},
                                       {.array = "heat_source", .name = "heat source", .si_unit = "W/m^3"}},
                            .real = {},
                            .imaginary = {},
                            .component = static_cast<int>(axis)};
  if (c.excitation.type == "harmonic") {
    settings.real = "displacement_real";
    settings.imaginary = "displacement_imaginary";
  }
  for (const Frame& frame : read_pvd(results / "fields.pvd")) {
    const auto nearest = std::ranges::min_element(times, {}, [&](double t) { return std::abs(t - frame.time); });
    settings.frames.push_back({.step = static_cast<Index>(nearest - times.begin()), .file = results / frame.file});
  }
  return read_cell_body(settings);
}

}  // namespace

BrowserExtras plate_extras(const PlateProgram& program, const fs::path& results) {
  BrowserExtras extras{.hash = program.hash};
  if (!fs::exists(results / summary_file)) return extras;
  const PlateCase& c = program.parsed;
  for (std::string& sentence : headline_of(c, *read_summary(results / summary_file)))
    extras.headline.push_back(in_print(std::move(sentence)));
  if (!c.heating) return extras;
  const CsvTable heating = read_csv(results / temperature_file);
  const std::vector<double>&times = heating.column("time_s"), &mean = heating.column("surface_mean_rise_K"),
        &largest = heating.column("surface_largest_rise_K");
  for (std::size_t i = 0; i < times.size(); ++i)
    extras.steps.push_back(in_print(fmt::format("{}: {}", in_minutes(times[i]), warmer(mean[i], largest[i]))));
  extras.body = body_of(c, times, results);
  extras.beside = {"Surface temperature", "Figures"};
  return extras;
}

}  // namespace pfdm
