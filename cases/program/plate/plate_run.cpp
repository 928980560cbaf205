#include "cases/program/plate/plate_run.h"

#include "physics/error.h"
#include "solver/dynamics/steady_heating.h"
#include "solver/parallel.h"

#include <fmt/format.h>
#include <boost/math/tools/minima.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Of the frequency response, in equal ratios.
std::vector<double> frequencies_of(const PlateCase& c) {
  std::vector<double> frequencies;
  frequencies.reserve(c.n_frequencies);
  for (int i = 0; i < c.n_frequencies; ++i)
    frequencies.push_back(c.from * std::pow(c.to / c.from, static_cast<double>(i) / (c.n_frequencies - 1)));
  return frequencies;
}

double temperature_at_start(const PlateCase& c) { return c.heating ? c.heating->surroundings : c.material.reference; }

}  // namespace

ElasticBody elastic_body(const PlateCase& c, const Mesh& mesh) {
  const auto elasticity = from_young_poisson(c.material.young_modulus(), c.material.poisson_ratio);
  return {.elasticity = std::vector<IsotropicElasticity>(mesh.region_names.size(), elasticity),
          .zone = std::vector<Index>(mesh.region_names.size(), 0),
          .boundary = c.supports};
}

Index nearest_unknown(const VibratingBody& body, const Vector& place) {
  const Mesh& mesh = body.mesh();
  Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](Index unknown, const Vector& x) {
    if (const double distance = (x - place).norm(); distance < least) {
      least = distance;
      best = unknown;
    }
  };
  for (Index c = 0; c < mesh.n_cells(); ++c) offer(c, mesh.cell_centre[c]);
  for (std::size_t k = 0; k < body.unknowns().face_of_node.size(); ++k)
    offer(mesh.n_cells() + static_cast<Index>(k), mesh.face_centre[body.unknowns().face_of_node[k]]);
  return best;
}

PlateRun::PlateRun(const PlateCase& c, const Mesh& mesh, int n_modes)
    : case_(&c),
      modulus_(c.material.young_modulus()),
      mesh_(mesh),
      body_(mesh, elastic_body(c, mesh), std::vector<double>(mesh.region_names.size(), c.material.density)),
      modes_(lowest_modes(body_, n_modes)),
      response_(body_, c.direction, all_harmonics()) {}

void PlateRun::take(const PlateCase& c) {
  case_ = &c;
  response_.reach(all_harmonics());
}

Harmonic PlateRun::at(double frequency, double temperature) const {
  Harmonic harmonic = case_->material.at(frequency, temperature);
  harmonic.factor *= case_->material.young_modulus() / modulus_;
  return harmonic;
}

std::vector<Harmonic> PlateRun::all_harmonics() const {
  std::vector<Harmonic> all;
  const double temperature = temperature_at_start(*case_);
  for (const double f : frequencies_of(*case_)) all.push_back(at(f, temperature));
  if (const auto& base = case_->excitation; base.frequency)
    all.push_back(at(*base.frequency, temperature));
  else if (base.type != "harmonic")
    for (const Part& part : parts(0.0)) all.push_back(at(part.frequency, temperature));
  return all;
}

// f^2 = f_0^2 Re c(f), by iteration.
std::vector<Resonance> PlateRun::resonances(double temperature) const {
  std::vector<Resonance> all;
  for (const Mode& mode : modes_) {
    double f = mode.omega / two_pi;
    for (int i = 0; i < 100; ++i) f = mode.omega / two_pi * std::sqrt(at(f, temperature).factor.real());
    const std::complex<double> factor = at(f, temperature).factor;
    all.push_back({.frequency = f,
                   .loss_factor = factor.imag() / factor.real(),
                   .effective_mass = mode.participation.cwiseAbs2() / body_.total_mass()});
  }
  return all;
}

double PlateRun::first_resonance(double temperature) const {
  return modes_.empty() ? 0.0 : resonances(temperature).front().frequency;
}

ResponseTable PlateRun::response() const {
  ResponseTable table{.frequency = frequencies_of(*case_), .H1 = {}, .power = {}};
  for (const ResponsePoint& point : case_->points) table.H1.push_back(transmissions(point.at, table.frequency));
  for (const double f : table.frequency) table.power.push_back(response_.power(at(f, temperature_at_start(*case_))));
  return table;
}

std::vector<std::complex<double>> PlateRun::transmissions(const Vector& place,
                                                          std::span<const double> frequencies) const {
  const Index unknown = nearest_unknown(body_, place);
  std::vector<std::complex<double>> H1;
  H1.reserve(frequencies.size());
  for (const double f : frequencies) H1.push_back(response_.transmission(at(f, temperature_at_start(*case_)), unknown));
  return H1;
}

// The largest power of the response's frequencies, improved between its neighbours.
double PlateRun::driving_frequency(double temperature) const {
  if (case_->excitation.frequency) return *case_->excitation.frequency;
  const std::vector<double> all = frequencies_of(*case_);
  const auto power = [&](double f) { return response_.power(at(f, temperature)); };
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
    if (power(all[i]) > power(all[best])) best = i;
  if (best == 0 || best + 1 == all.size())
    throw InputError(fmt::format(
        "[response] the power is largest at its end, {:.4g} Hz: no resonance lies between its ends", all[best]));
  return boost::math::tools::brent_find_minima([&](double f) { return -power(f); }, all[best - 1], all[best + 1], 30)
      .first;
}

std::vector<PlateRun::Part> PlateRun::parts(double frequency) const {
  const PlateExcitation& base = case_->excitation;
  const double mean_square = base.level * base.level;
  if (base.type == "harmonic") return {{frequency, mean_square}};
  // The middles of intervals, in equal ratios: of a random motion 2 S df, of a sweep the part of its time.
  std::vector<Part> all;
  const int n = case_->n_frequencies;
  const double ratio = std::pow(base.to / base.from, 1.0 / n);
  for (int i = 0; i < n; ++i) {
    const double lower = base.from * std::pow(ratio, i), upper = lower * ratio;
    double weight = mean_square * (base.logarithmic ? 1.0 / n : (upper - lower) / (base.to - base.from));
    if (base.type == "random") weight = 2.0 * base.level * (upper - lower);
    all.push_back({std::sqrt(lower * upper), weight});
  }
  return all;
}

// What the operator is not symmetric by, the strain energy's heat and the mechanical power differ by; the latter
// counts.
PlateRun::Heat PlateRun::heat_of(const std::vector<Part>& all, double temperature) const {
  Heat heat{.source = CellField<double>(mesh_.n_cells(), 0.0)};
  double by_strain = 0.0;
  for (const Part& part : all) {
    const Harmonic harmonic = at(part.frequency, temperature);
    const CellField<double> strain = strain_power(body_, response_.displacement(harmonic));
    const double share = parallel_sum(mesh_.n_cells(), [&](Index c) { return mesh_.cell_volume[c] * strain[c]; });
    const double power = response_.power(harmonic) * part.weight;
    by_strain += 0.5 * harmonic.omega * harmonic.factor.imag() * part.weight * share;
    parallel_for(mesh_.n_cells(), [&](Index c) { heat.source[c] += power / share * strain[c]; });
    heat.power += power;
  }
  heat.correction = heat.power / by_strain - 1.0;
  return heat;
}

Eigen::VectorXcd PlateRun::motion(double frequency, double temperature) const {
  return case_->excitation.level * response_.displacement(at(frequency, temperature));
}

std::vector<SurfaceTemperature> PlateRun::steady_surface(double frequency, double& step) const {
  const PlateHeating& heating = *case_->heating;
  const auto n_steps = static_cast<int>(std::ceil(heating.duration / heating.step - 1e-9));
  step = heating.duration / n_steps;
  return surface_under_steady_source(mesh_, case_->material.heat, heating.boundary,
                                     heat_of(parts(frequency), heating.surroundings).source, heating.surface, step,
                                     n_steps);
}

// To first order the modulus of a warm body is that at its temperature, weighted by the heat source.
void PlateRun::heat(double frequency, const Done& done) const {
  const PlateHeating& heating = *case_->heating;
  HeatedBody body(mesh_, case_->material.heat, heating.boundary);
  const std::vector<Part> all = parts(frequency);
  const auto over_volume = [&](const auto& density) {
    return parallel_sum(mesh_.n_cells(), [&](Index c) { return mesh_.cell_volume[c] * density(c); });
  };
  const double volume = over_volume([](Index) { return 1.0; });
  Heat heat = heat_of(all, heating.surroundings);
  HeatingRow row;
  row.power = heat.power;
  row.correction = heat.correction;
  double temperature = heating.surroundings;
  row.resonance = first_resonance(temperature);
  body.set_source(heat.source);
  done(row, body, heat.source);
  const auto n_steps = static_cast<int>(std::ceil(heating.duration / heating.step - 1e-9));
  const double dt = heating.duration / n_steps;
  for (int step = 1; step <= n_steps; ++step) {
    body.step(dt);
    row.time = step * dt;
    row.work += dt * row.power;
    row.account = body.account();
    row.surface = body.surface(heating.surface);
    row.mean_rise = over_volume([&](Index c) { return body.rise()[c]; }) / volume;
    row.largest_rise = *std::ranges::max_element(body.rise());
    if (case_->material.depends_on_temperature()) {
      temperature =
          heating.surroundings + over_volume([&](Index c) { return heat.source[c] * body.rise()[c]; }) / row.power;
      heat = heat_of(all, temperature);
      body.set_source(heat.source);
      row.power = heat.power;
      row.correction = heat.correction;
      row.resonance = first_resonance(temperature);
    }
    done(row, body, heat.source);
  }
}

}  // namespace pfdm
