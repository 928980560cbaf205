#include "cases/program/studies/sweep/merged_charts.h"

#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr int grey = 7;                 // the last colour, of what was measured
constexpr std::size_t most_charts = 6;  // that one is split into

/// A chart of one of the pages.
struct Part {
  std::size_t page = 0;
  Chart chart;
};

bool same_dimension(const ChartAxis& a, const ChartAxis& b) {
  return a.logarithmic == b.logarithmic &&
         factor_between(words_and_unit(a.title).second, words_and_unit(b.title).second).has_value();
}

/// Of each page the first chart of a caption, by caption; a group for each dimension of its axes.
std::vector<std::vector<Part>> grouped(const std::vector<NamedReport>& pages) {
  std::vector<std::vector<Part>> groups;
  for (std::size_t p = 0; p < pages.size(); ++p)
    for (const PageRow& row : pages[p].report->rows)
      for (const PageBlock& block : row.blocks) {
        const auto* chart = std::get_if<Chart>(&block);
        if (chart == nullptr || chart->series.empty()) continue;
        const auto fits = [&](const std::vector<Part>& group) {
          const Chart& first = group.front().chart;
          return first.caption == chart->caption && group.back().page != p && same_dimension(first.x, chart->x) &&
                 same_dimension(first.y, chart->y);
        };
        const auto found = std::ranges::find_if(groups, fits);
        if (found != groups.end())
          found->push_back({p, *chart});
        else
          groups.push_back({{p, *chart}});
      }
  return groups;
}

void scale(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

using AxisOf = ChartAxis Chart::*;
using ValuesOf = std::vector<double> Series::*;

/// Brings an axis of all charts into the unit of that with the largest numbers, and to one title.
void take_one_unit(std::vector<Part>& group, AxisOf axis, std::initializer_list<ValuesOf> values) {
  const auto unit_of = [&](const Part& part) { return words_and_unit((part.chart.*axis).title).second; };
  const std::string first = unit_of(group.front());
  double most = -1.0;
  std::string unit = first, words;
  for (const Part& part : group) {
    const double factor = *factor_between(unit_of(part), first);
    for (const Series& series : part.chart.series)
      if (const double here = factor * largest(series.*(*values.begin())); here > most)
        most = here, unit = unit_of(part);
    const std::string own = words_and_unit((part.chart.*axis).title).first;
    if (words.empty()) words = own;
    if (words != own) words = words.substr(0, words.find(" of "));  // of which patch: each has its own
  }
  for (Part& part : group) {
    const double factor = *factor_between(unit_of(part), unit);
    ChartAxis& own = part.chart.*axis;
    for (std::optional<double>* end : {&own.from, &own.to})
      if (*end) **end *= factor;
    for (Series& series : part.chart.series)
      for (const ValuesOf of : values) scale(series.*of, factor);
    own.title = unit.empty() ? words : fmt::format("{} [{}]", words, unit);
  }
}

bool is_of_steps(const Series& series) { return series.of_steps; }

/// Series that a run has computed, where the chart tells; the others were measured, or belong to the case.
bool is_own(const Chart& chart, const Series& series) {
  return std::ranges::none_of(chart.series, is_of_steps) || series.of_steps;
}

Chart empty_like(const std::vector<Part>& group) {
  Chart chart{
      .caption = group.front().chart.caption, .x = group.front().chart.x, .y = group.front().chart.y, .series = {}};
  for (const Part& part : group) {  // ends that all have fixed stay, as far as any goes
    const auto widen = [](ChartAxis& all, const ChartAxis& one) {
      all.from = all.from && one.from ? std::optional(std::min(*all.from, *one.from)) : std::nullopt;
      all.to = all.to && one.to ? std::optional(std::max(*all.to, *one.to)) : std::nullopt;
    };
    widen(chart.x, part.chart.x);
    widen(chart.y, part.chart.y);
  }
  return chart;
}

// Also after another change of units.
bool are_alike(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double p, double q) { return p == q || std::abs(p - q) <= 1e-9 * std::abs(p); });
}

bool is_there(const std::vector<Series>& all, const Series& one) {
  return std::ranges::any_of(
      all, [&](const Series& s) { return s.label == one.label && are_alike(s.x, one.x) && are_alike(s.y, one.y); });
}

/// What is not a run's own, each once.
std::vector<Series> shared_series(const std::vector<Part>& group) {
  std::vector<Series> shared;
  for (const Part& part : group)
    for (const Series& series : part.chart.series)
      if (!is_own(part.chart, series) && !is_there(shared, series)) {
        shared.push_back(series);
        shared.back().colour = grey;
      }
  return shared;
}

Series named(const Series& series, const std::string& label, std::size_t page) {
  Series own = series;
  own.label = label;
  own.colour = static_cast<int>(page % grey);
  if (page >= grey && own.style != SeriesStyle::points && own.style != SeriesStyle::band)
    own.style = SeriesStyle::dashed;
  own.of_steps = false;
  return own;
}

std::vector<std::string> own_labels(const std::vector<Part>& group) {
  std::vector<std::string> labels;
  for (const Part& part : group)
    for (const Series& series : part.chart.series)
      if (is_own(part.chart, series) && std::ranges::count(labels, series.label) == 0) labels.push_back(series.label);
  return labels;
}

bool has_several(const std::vector<Part>& group) {
  return std::ranges::any_of(group, [](const Part& part) {
    return std::ranges::count_if(part.chart.series, [&](const Series& s) { return is_own(part.chart, s); }) > 1;
  });
}

void add_own(Chart& chart, const std::vector<Part>& group, const std::vector<NamedReport>& pages,
             const std::optional<std::string>& label) {
  for (const Part& part : group)
    for (const Series& series : part.chart.series) {
      if (!is_own(part.chart, series) || (label && series.label != *label)) continue;
      const std::string& name = pages[part.page].name;
      const bool tells = !label && has_several(group) && !series.label.empty();
      chart.series.push_back(named(series, tells ? fmt::format("{}: {}", name, series.label) : name, part.page));
    }
}

}  // namespace

std::pair<std::string, std::string> words_and_unit(const std::string& title) {
  const std::size_t from = title.rfind(" [");
  if (from == std::string::npos || !title.ends_with("]")) return {title, ""};
  return {title.substr(0, from), title.substr(from + 2, title.size() - from - 3)};
}

std::pair<const Chart*, const Series*> first_curve(const ReportPage& page) {
  for (const PageRow& row : page.rows)
    for (const PageBlock& block : row.blocks)
      if (const auto* chart = std::get_if<Chart>(&block)) {
        const auto found = std::ranges::find_if(chart->series, is_of_steps);
        if (found != chart->series.end()) return {chart, &*found};
      }
  return {nullptr, nullptr};
}

std::vector<PageBlock> merged_charts(const std::vector<NamedReport>& pages) {
  std::vector<PageBlock> charts;
  for (std::vector<Part>& group : grouped(pages)) {
    take_one_unit(group, &Chart::x, {&Series::x});
    take_one_unit(group, &Chart::y, {&Series::y, &Series::upper});
    const std::vector<std::string> labels = own_labels(group);
    const bool is_split = has_several(group) && labels.size() <= most_charts && std::ranges::count(labels, "") == 0;
    const std::size_t n = is_split ? labels.size() : 1;
    for (std::size_t k = 0; k < n; ++k) {
      Chart chart = empty_like(group);
      if (is_split) chart.caption += ": " + labels[k];
      chart.series = shared_series(group);
      add_own(chart, group, pages, is_split ? std::optional(labels[k]) : std::nullopt);
      charts.emplace_back(std::move(chart));
    }
  }
  return charts;
}

}  // namespace pfdm
