#include "cases/program/specimens/record_origin.h"

#include "physics/quantity_text.h"

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double noticeable_origin = 0.01;  // of the displacement at the greatest force
constexpr double offset_reach = 0.03;       // likewise, of an offset
constexpr double by_noise = 3.3;            // standard errors, of many rows: one record in a thousand
constexpr double chance = 1e-3;             // of noise alone to move the origin by more

bool is_off(const StraightPart& straight) { return std::abs(straight.origin) >= noticeable_origin * straight.reach(); }

/// By more than noise moves it: Student's t of the rows of the straight part.
bool is_beyond_noise(const StraightPart& straight) {
  const boost::math::students_t t(static_cast<double>(straight.n_points) - 2.0);
  const double errors = boost::math::quantile(boost::math::complement(t, 0.5 * chance));
  return std::abs(straight.origin) >= errors * straight.origin_error;
}

bool misses_origin(const StraightPart& straight) { return is_off(straight) && is_beyond_noise(straight); }

/// The origin is kept, and may be wrong: slack and noise cannot be told apart.
void add_kept_origin(MeasuredRecord& record, const StraightPart& straight) {
  record.text += "offset = \"0 mm\"                 # noise or slack moved the origin: estimated with the rest\n";
  record.remarks.push_back(
      fmt::format("the straight part meets zero force at {}, within noise: no toe, and the fit estimates the offset",
                  quantity_text(straight.origin, "m")));
}

}  // namespace

std::string straight_keys(const StraightPart& straight, bool takes_toe) {
  const double origin = takes_toe && misses_origin(straight) ? 0.0 : straight.origin;
  return fmt::format("stiffness_between = [\"{}\", \"{}\"]   # from 10 to 50 % of the greatest force\n",
                     quantity_text(origin + straight_from * straight.reach(), "m"),
                     quantity_text(origin + straight_to * straight.reach(), "m"));
}

void add_toe(MeasuredRecord& record, const StraightPart& straight, bool is_taken) {
  if (!misses_origin(straight)) {
    if (is_taken && is_off(straight)) add_kept_origin(record, straight);
    return;
  }
  const std::string origin = quantity_text(straight.origin, "m");
  record.text += fmt::format("{}toe = [\"{}\", \"{}\"]          # {} {}\n", is_taken ? "" : "# ",
                             quantity_text(straight_from * straight.greatest_force, "N"),
                             quantity_text(straight_to * straight.greatest_force, "N"),
                             is_taken ? "the straight part gives the origin: it was at"
                                      : "if the record has slack: its straight part meets zero force at",
                             origin);
  if (is_taken) record.text += "offset = \"0 mm\"                 # what the toe errs by, estimated with the rest\n";
  if (!is_taken)
    record.remarks.push_back(fmt::format(
        "the straight part meets zero force at {}; if that is slack, toe in case.toml takes it off", origin));
}

std::string offset_parameters(const std::vector<StraightPart>& straight) {
  std::string text;
  for (std::size_t i = 0; i < straight.size(); ++i) {
    if (!is_off(straight[i])) continue;
    const double kept = misses_origin(straight[i]) ? 0.0 : std::abs(straight[i].origin);
    const double reach = std::max(offset_reach * straight[i].reach(), kept + 2.0 * by_noise * straight[i].origin_error);
    text += fmt::format(
        "\n[[fit.parameters]]                     # of this record's {}\nkey = \"experiment.specimens[{}].offset\"\n"
        "bounds = [\"{}\", \"{}\"]\n",
        kept == 0.0 ? "toe" : "origin", i, quantity_text(-reach, "m", 3), quantity_text(reach, "m", 3));
  }
  return text;
}

}  // namespace pfdm
