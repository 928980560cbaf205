#include "cases/program/plate/plate_results.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

CsvTable computed() {
  return {.comments = {" synthetic: computed, not measured"}, .names = {}, .units = {}, .columns = {}};
}

template <class Rows, class Get>
std::vector<double> column(const Rows& rows, const Get& get) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(get(row));
  return values;
}

}  // namespace

void write_response(const std::filesystem::path& folder, const PlateCase& c, const ResponseTable& table) {
  CsvTable csv = computed();
  csv.add("frequency_Hz", table.frequency);
  for (std::size_t p = 0; p < c.points.size(); ++p) {
    csv.add(c.points[p].name + "_H1_magnitude", column(table.H1[p], [](const auto& H) { return std::abs(H); }));
    csv.add(c.points[p].name + "_H1_phase_rad", column(table.H1[p], [](const auto& H) { return std::arg(H); }));
  }
  csv.add("power_W_s4_per_m2", table.power);
  write_csv(folder / response_file, csv);
}

void write_resonances(const std::filesystem::path& folder, const std::vector<Resonance>& resonances) {
  CsvTable csv = computed();
  std::vector<double> number;
  for (std::size_t k = 0; k < resonances.size(); ++k) number.push_back(static_cast<double>(k + 1));
  csv.add("mode", number);
  csv.add("frequency_Hz", column(resonances, [](const Resonance& r) { return r.frequency; }));
  csv.add("damping_ratio", column(resonances, [](const Resonance& r) { return 0.5 * r.loss_factor; }));
  for (Index axis = 0; axis < 3; ++axis)
    csv.add(fmt::format("effective_mass_{}", "xyz"[axis]),
            column(resonances, [&](const Resonance& r) { return r.effective_mass[axis]; }));
  write_csv(folder / modes_file, csv);
}

void write_heating(const std::filesystem::path& folder, const std::vector<HeatingRow>& rows) {
  CsvTable csv = computed();
  const auto add = [&](const char* name, auto get) { csv.add(name, column(rows, get)); };
  add("time_s", [](const HeatingRow& r) { return r.time; });
  add("surface_mean_rise_K", [](const HeatingRow& r) { return r.surface.mean; });
  add("surface_largest_rise_K", [](const HeatingRow& r) { return r.surface.largest; });
  add("mean_rise_K", [](const HeatingRow& r) { return r.mean_rise; });
  add("largest_rise_K", [](const HeatingRow& r) { return r.largest_rise; });
  add("mechanical_power_W", [](const HeatingRow& r) { return r.power; });
  add("mechanical_work_J", [](const HeatingRow& r) { return r.work; });
  add("heat_J", [](const HeatingRow& r) { return r.account.heat; });
  add("heat_stored_J", [](const HeatingRow& r) { return r.account.stored; });
  add("heat_lost_J", [](const HeatingRow& r) { return r.account.lost; });
  add("resonance_Hz", [](const HeatingRow& r) { return r.resonance; });
  write_csv(folder / temperature_file, csv);
}

void write_surface(const std::filesystem::path& folder, const Mesh& mesh, const std::string& name,
                   const std::vector<double>& rise) {
  const Patch& patch = mesh.patch(name);
  CsvTable csv = computed();
  for (Index axis = 0; axis < 3; ++axis) {
    std::vector<double> place;
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      place.push_back(mesh.face_centre[f][axis]);
    csv.add(fmt::format("{}_m", "xyz"[axis]), place);
  }
  csv.add("rise_K", rise);
  write_csv(folder / surface_file, csv);
}

PlateFrames::PlateFrames(std::filesystem::path folder, const Mesh& mesh)
    : folder_(std::move(folder)),
      writer_(mesh, {.time_unit = "s"}),
      series_((make_folder(folder_ / "fields"), folder_ / "fields.pvd")),
      real_(mesh.n_cells(), Vector::Zero()),
      imaginary_(real_),
      deflection_(mesh.n_cells(), 0.0) {}

void PlateFrames::set_motion(const Eigen::VectorXcd& u, const Vector& direction) {
  std::complex<double> largest = 0.0;
  const auto along = [&](Index c) -> std::complex<double> {
    return {direction.dot(real_[c]), direction.dot(imaginary_[c])};
  };
  for (Index c = 0; c < real_.size(); ++c) {
    real_[c] = u.segment<3>(3 * Eigen::Index{c}).real();
    imaginary_[c] = u.segment<3>(3 * Eigen::Index{c}).imag();
    if (std::abs(along(c)) > std::abs(largest)) largest = along(c);
  }
  if (largest == 0.0) return;
  const std::complex<double> moment = std::abs(largest) / largest;
  for (Index c = 0; c < real_.size(); ++c) deflection_[c] = (along(c) * moment).real();
}

void PlateFrames::add(double time, const CellField<double>& source, const CellField<double>& rise) {
  const std::string file = fmt::format("fields/frame_{:04}.vtu", series_.frames().size());
  constexpr Precision single = Precision::single_precision;
  writer_.write(folder_ / file,
                {{.name = "displacement_real", .values = &real_, .precision = single, .unit = "m"},
                 {.name = "displacement_imaginary", .values = &imaginary_, .precision = single, .unit = "m"},
                 {.name = "deflection", .values = &deflection_, .precision = single, .unit = "m"},
                 {.name = "heat_source", .values = &source, .precision = single, .unit = "W/m^3"},
                 {.name = "temperature_rise", .values = &rise, .precision = single, .unit = "K"}},
                time);
  series_.add(time, file);
}

}  // namespace pfdm
