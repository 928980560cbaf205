#pragma once
// The equations of other codes, by the decks that are written for them: tractions at an opening and a slip.

#include "physics/registry.h"
#include "postproc/exports/export_formats.h"
#include "postproc/exports/law/given_law.h"
#include "tests/postproc/deck_readers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace pfdm::test {

/// Normal and shear traction [Pa] at an opening and a slip [m].
struct Tractions {
  double normal, shear;
};
using Law = std::function<Tractions(double opening, double slip)>;

inline double linear_damage(double separation, double onset, double end) {
  if (separation <= onset) return 0.0;
  return separation >= end ? 1.0 : end * (separation - onset) / (separation * (end - onset));
}

inline double between(const std::vector<std::vector<double>>& rows, std::size_t x, std::size_t y, double at) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (at <= rows[i][x])
      return rows[i - 1][y] + (rows[i][y] - rows[i - 1][y]) * (at - rows[i - 1][x]) / (rows[i][x] - rows[i - 1][x]);
  return rows.back()[y];
}

using Block = std::map<std::string, std::vector<std::vector<double>>>;

/// The option of a block that begins so, with all of its parameters.
inline std::string option_of(const Block& block, const std::string& begin) {
  for (const auto& [option, rows] : block)
    if (option.starts_with(begin)) return option;
  return "";
}

inline double parameter(const std::string& option, const std::string& name) {
  return std::stod(option.substr(option.find(name + "=") + name.size() + 1));
}

/// D at a separation beyond the onset and a mode mix, by the rows "D, separation, mix": linear in both.
inline double damage_of(const std::vector<std::vector<double>>& rows, double beyond, double mix) {
  if (rows.front().size() == 2) return between(rows, 1, 0, beyond);
  std::map<double, std::vector<std::vector<double>>> by_mix;
  for (const auto& row : rows) by_mix[row[2]].push_back(row);
  std::vector<std::vector<double>> at_mix;  // mix, D
  for (const auto& [of, table] : by_mix) at_mix.push_back({of, between(table, 1, 0, beyond)});
  return between(at_mix, 0, 1, mix);
}

inline Law abaqus(const Block& block) {
  const std::string elastic = block.contains("*COHESIVE BEHAVIOR") ? "*COHESIVE BEHAVIOR" : "*ELASTIC, TYPE=TRACTION";
  const auto K = block.at(elastic).at(0), strength = block.at("*DAMAGE INITIATION, CRITERION=QUADS").at(0);
  const std::string option = option_of(block, "*DAMAGE EVOLUTION");
  const auto rows = block.at(option);
  return [=](double opening, double slip) -> Tractions {
    const double T_n = K[0] * opening, T_s = K[1] * slip, size = std::hypot(opening, slip);
    const double onset = size / std::hypot(T_n / strength[0], T_s / strength[1]);
    const double mix = T_s * slip / (T_n * opening + T_s * slip);
    double D = 0.0;
    if (option.find("SOFTENING=TABULAR") != std::string::npos) {
      D = size > onset ? damage_of(rows, size - onset, mix) : 0.0;
    } else if (option.find("TYPE=DISPLACEMENT") != std::string::npos) {
      D = linear_damage(size, onset, onset + between(rows, 1, 0, mix));
    } else {
      const double power = parameter(option, "POWER"), G_n = rows[0][0], G_s = rows[0][1];
      const double G = option.find("BEHAVIOR=BK") != std::string::npos
                           ? G_n + (G_s - G_n) * std::pow(mix, power)
                           : std::pow(std::pow((1 - mix) / G_n, power) + std::pow(mix / G_s, power), -1 / power);
      D = linear_damage(size, onset, 2 * G / (std::hypot(T_n, T_s) * onset / size));
    }
    return {(1 - D) * T_n, (1 - D) * T_s};
  };
}

inline Law moose(const std::string& text) {
  auto values = read_assignments(text);
  const double K = std::stod(values["penalty_stiffness"]), N = std::stod(values["normal_strength"]),
               S = std::stod(values["shear_strength"]), G_I = std::stod(values["GI_c"]),
               G_II = std::stod(values["GII_c"]), eta = std::stod(values["eta"]);
  const bool bk = values["mixed_mode_criterion"] == "BK";
  return [=](double opening, double slip) -> Tractions {
    const double n = N / K, s = S / K, size = std::hypot(opening, slip);
    double onset = s, end = 2 * G_II / (K * s);
    if (opening > 0) {
      const double b = slip / opening;
      onset = n * s * std::sqrt((1 + b * b) / (s * s + b * b * n * n));
      end =
          bk ? 2 / (K * onset) * (G_I + (G_II - G_I) * std::pow(b * b / (1 + b * b), eta))
             : (2 + 2 * b * b) / (K * onset) * std::pow(std::pow(1 / G_I, eta) + std::pow(b * b / G_II, eta), -1 / eta);
    }
    const double kept = 1 - linear_damage(size, onset, end);
    return {kept * K * opening, kept * K * slip};
  };
}

using Cards = std::map<std::string, std::vector<std::vector<double>>>;

inline Cards read_lsdyna(const std::string& text) {
  return read_fields(text, [](const std::string& keyword, std::size_t row) -> std::size_t {
    return keyword == "*DEFINE_CURVE" && row > 0 ? 20 : 10;
  });
}

inline Law mat_138(const Cards& cards) {
  const auto card = cards.at("*MAT_COHESIVE_MIXED_MODE");
  const double EN = card[0][4], ET = card[0][5], G_I = card[0][6], G_II = card[0][7], xmu = card[1][0], T = card[1][1],
               S = card[1][2];
  return [=](double opening, double slip) -> Tractions {
    const double n = T / EN, s = S / ET, size = std::hypot(opening, slip);
    double onset = s, end = 2 * G_II / S;
    if (opening > 0) {
      const double b = slip / opening, b2 = b * b;
      onset = n * s * std::sqrt((1 + b2) / (s * s + b2 * n * n));
      const double power = std::pow(std::pow(EN / G_I, xmu) + std::pow(ET * b2 / G_II, xmu), -1 / xmu);
      end = xmu > 0 ? 2 * (1 + b2) / onset * power
                    : 2 / (onset * (EN + ET * b2) / (1 + b2)) *
                          (G_I + (G_II - G_I) * std::pow(ET * b2 / (EN + ET * b2), -xmu));
    }
    const double kept = 1 - linear_damage(size, onset, end);
    return {kept * EN * opening, kept * ET * slip};
  };
}

inline Law mat_186(const Cards& cards) {
  const auto card = cards.at("*MAT_COHESIVE_GENERAL");
  const auto& curve = cards.at("*DEFINE_CURVE");
  const std::vector<std::vector<double>> points(curve.begin() + 1, curve.end());
  double area = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    area += 0.5 * (points[i][1] + points[i - 1][1]) * (points[i][0] - points[i - 1][0]);
  const double T = card[1][1], S = card[1][2], end_n = card[0][6] / (area * T), end_s = card[0][7] / (area * S);
  return [=](double opening, double slip) -> Tractions {
    const double n = opening / end_n, s = slip / end_s, lambda = std::hypot(n, s);
    const double part = lambda < 1 ? between(points, 0, 1, lambda) / lambda : 0.0;
    return {T * part * n, S * part * s};
  };
}

inline Law by_effective(double strength, double onset, double end, double measure, double pull) {
  return [=](double opening, double slip) -> Tractions {
    const double lambda = std::hypot(opening, measure * slip);
    const double T = strength * (lambda < onset ? lambda / onset : std::max(0.0, (end - lambda) / (end - onset)));
    return {T / lambda * opening, pull * T / lambda * slip};
  };
}

inline Law optistruct(const std::string& text) {
  const std::vector<std::string> fields = read_large_fields(text);
  const double G = std::stod(fields[8]), onset = std::stod(fields[9]), end = std::stod(fields[10]),
               beta = std::stod(fields[11]);
  return by_effective(2 * G / end, onset, end, beta, beta * beta);
}

inline Law akantu_bilinear(const std::string& text) {
  const std::size_t begin = text.find("# material cohesive_bilinear");
  auto values = read_assignments(std::regex_replace(text.substr(begin), std::regex("\n# "), "\n"));
  const double sigma = std::stod(values["sigma_c"]), beta = std::stod(values["beta"]), G = std::stod(values["G_c"]),
               kappa = std::stod(values["kappa"]), onset = std::stod(values["delta_0"]);
  return by_effective(sigma, onset, 2 * G / sigma, beta / kappa, beta * beta / kappa);
}

}  // namespace pfdm::test
