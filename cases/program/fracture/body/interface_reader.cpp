#include "cases/program/fracture/body/interface_reader.h"

#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/laws/law_reader.h"
#include "physics/quantity_text.h"
#include "physics/registry.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

std::optional<Scatter> read_scatter(const ConfigTable& table, std::string_view key) {
  const auto value = table.find(key);
  if (!value) return std::nullopt;
  const ConfigTable scatter = value->table();
  return Scatter{scatter.number("coefficient"), RandomField(static_cast<std::uint64_t>(scatter.integer("seed")),
                                                            scatter.quantity("correlation_length"))};
}

/// One law of a table such as cohesive_law.csv, from the largest separation so far to a larger one: what was unloaded
/// in between is left out.
TabulatedPoints read_points(const ConfigTable& table, const CsvTable& csv) {
  const std::vector<double>&separation = csv.column("separation_m"), &traction = csv.column("traction_Pa");
  std::vector<std::size_t> starts{0};
  if (std::ranges::find(csv.names, "step") != csv.names.end()) {
    const std::vector<double>& step = csv.column("step");
    for (std::size_t i = 1; i < step.size(); ++i)
      if (step[i] <= step[i - 1]) starts.push_back(i);
  }
  const Range laws{1.0, static_cast<double>(starts.size()), false, "the number of one of the table's laws"};
  if (starts.size() > 1 && !table.has("table_law"))
    throw table.at("table").error(
        fmt::format("the table has {} laws: say which by table_law = 1, 2 ...", starts.size()));
  const auto which = static_cast<std::size_t>(table.integer("table_law", laws, 1));
  starts.push_back(separation.size());
  std::vector<double> x, y;
  for (std::size_t i = starts[which - 1]; i < starts[which]; ++i)
    if (x.empty() || separation[i] > x.back()) x.push_back(separation[i]), y.push_back(traction[i]);
  return tabulate(x, y);
}

void read_table(const ConfigTable& table, const std::filesystem::path& case_directory, InterfaceSettings& settings,
                std::vector<std::filesystem::path>& data_files) {
  const ConfigValue file = table.at("table");
  data_files.push_back(read_data_file(file, case_directory));
  const TabulatedPoints points = file.in_context([&] { return read_points(table, read_csv(data_files.back())); });
  settings.law.shape = points.shape;
  settings.strength.at = [value = points.strength](const Vector&) { return value; };
  settings.toughness.at = [value = points.energy](const Vector&) { return value; };
}

void read_law(const ConfigTable& table, const std::filesystem::path& case_directory, InterfaceSettings& settings,
              std::vector<std::filesystem::path>& data_files) {
  InterfaceLaw& law = settings.law;
  law.law = &choose(table.at("law"), interface_laws(), "law of an interface");
  if (law.law->name == tabulated_law().name) return read_table(table, case_directory, settings, data_files);
  settings.strength = read_parameter(table.at("strength"));
  settings.toughness = read_parameter(table.at("toughness"));
  for (std::size_t i = law.law->has_rise() ? 1 : 0; i < law.law->shape.size(); ++i) {
    const ShapeParameter& p = law.law->shape[i];
    law.shape.push_back(table.number(p.name, p.first));
  }
  const auto stiffness = law.law->has_rise() ? table.find("stiffness") : std::nullopt;
  if (stiffness && !(stiffness->is_string() && stiffness->string() == "rigid"))
    settings.stiffness = stiffness->quantity();
}

void read_modes(const ConfigTable& table, InterfaceSettings& settings) {
  InterfaceLaw& law = settings.law;
  const auto mode = table.find("mixed_mode");
  law.mixed_mode = mode ? &choose(*mode, mixed_modes(), "mixed mode") : &mixed_modes().front();
  law.friction = table.number("friction", 0.0);
  if (!law.mixed_mode->suits(*law.law))
    throw mode->error(
        law.mixed_mode->is_potential
            ? fmt::format("it is the potential of the law \"xu_needleman\"; the law here is \"{}\"", law.law->name)
            : fmt::format("it needs a law with a straight rise; \"{}\" has none", law.law->name));
  if (!law.mixed_mode->has_shear_strength()) {
    law.shear_ratio = table.number("shear_ratio", 1.0);
    return;
  }
  settings.shear_strength = read_parameter(table.at("shear_strength"));
  settings.shear_toughness = read_parameter(table.at("shear_toughness"));
  if (law.depends_on_mode()) law.exponent = table.number("exponent", 1.0);
}

/// While the separation grows the law without rate has to take work, or the rate would give some back: not where
/// opening that turns into slip releases energy.
void check_rate(const ConfigTable& table, const InterfaceLaw& law) {
  if (!law.mixed_mode->is_potential && !(law.mixed_mode->keeps_stiffness && law.shear_ratio != 1.0)) return;
  throw table.at("rate").error(
      fmt::format("it cannot be combined with mixed_mode = \"{}\"{}: where opening turns into slip the rate would give "
                  "energy in place of taking it. Other rules of mixed mode are allowed",
                  law.mixed_mode->name, law.mixed_mode->is_potential ? "" : " and a shear_ratio other than 1"));
}

std::vector<InterfaceBranch> read_interface_branches(const ConfigTable& table) {
  std::vector<InterfaceBranch> branches;
  for (const ConfigTable& branch : table.tables("branches"))
    branches.push_back({branch.quantity("stiffness"), branch.quantity("time")});
  if (branches.size() > most_interface_branches)
    throw table.at("branches")
        .error(fmt::format("found {} branches; at most {} are allowed", branches.size(), most_interface_branches));
  return branches;
}

void read_place(const ConfigTable& table, InterfaceSettings& settings) {
  const auto between = table.find("between"), plane = table.find("plane"), within = table.find("where");
  if (between.has_value() == plane.has_value())
    throw table.error(
        "say where the interface is: either between = [\"region\", \"region\"], or plane = { point = "
        "[...], normal = [...] }");
  if (between) {
    const std::vector<ConfigValue> regions = between->list(2);
    if (regions[0].string() == regions[1].string())
      throw between->error("say two different regions; faces within a region are those of a plane");
    settings.between = {regions[0], regions[1]};
  } else {
    const ConfigTable place = plane->table();
    settings.plane = {read_point(place.at("point")), read_direction(place.at("normal")).normalized()};
  }
  if (!within) return;
  settings.within = within->in_context([&] { return Expression(within->string()); });
  if (settings.within->uses_load()) throw within->error("this may depend on x, y and z (metres) only");
}

InterfaceSettings read_interface(const ConfigTable& table, std::size_t number,
                                 const std::filesystem::path& case_directory,
                                 std::vector<std::filesystem::path>& data_files) {
  InterfaceSettings settings{.name = fmt::format("interface_{}", number), .where = table};
  if (const auto name = table.find("name")) settings.name = read_plain_name(*name, "files of the results");
  read_place(table, settings);
  read_law(table, case_directory, settings, data_files);
  read_modes(table, settings);
  if (table.has("rate")) {
    const auto [law, p] = law_of_table(table.table("rate"), interface_rate_laws(), "rate law of an interface");
    settings.law.rate = {.law = law, .p = p};
    check_rate(table, settings.law);
  }
  if (table.has("branches")) settings.law.branches = read_interface_branches(table);
  settings.strength_scatter = read_scatter(table, "strength_scatter");
  settings.toughness_scatter = read_scatter(table, "toughness_scatter");
  return settings;
}

/// 1 where the face belongs to the interface and its normal leaves the first side, -1 where it enters that, else 0.
double side_of(const InterfaceSettings& settings, const std::array<Index, 2>& regions, const Mesh& mesh, Index f) {
  constexpr double rounding = 1e-6;
  const Vector& x = mesh.face_centre[f];
  if (settings.within && settings.where.in_context([&] { return (*settings.within)(x, 0.0); }) == 0.0) return 0.0;
  if (settings.between) {
    const Index P = mesh.region[mesh.owner[f]], N = mesh.region[mesh.neighbour[f]];
    return P == regions[0] && N == regions[1] ? 1.0 : P == regions[1] && N == regions[0] ? -1.0 : 0.0;
  }
  const double area = mesh.face_area[f].norm(), along = mesh.face_area[f].dot(settings.plane->normal) / area;
  const double off = (x - settings.plane->point).dot(settings.plane->normal);
  if (std::abs(off) > rounding * std::sqrt(area) || std::abs(along) < 1.0 - rounding) return 0.0;
  return along > 0.0 ? 1.0 : -1.0;
}

InterfaceStrength strength_at(const InterfaceSettings& settings, const Vector& x) {
  const double stronger = settings.strength_scatter ? settings.strength_scatter->factor(x) : 1.0;
  const double tougher = settings.toughness_scatter ? settings.toughness_scatter->factor(x) : 1.0;
  InterfaceStrength at{.strength = stronger * settings.strength.at(x),
                       .toughness = tougher * settings.toughness.at(x),
                       .stiffness = settings.stiffness};
  if (settings.shear_strength) at.shear_strength = stronger * settings.shear_strength->at(x);
  if (settings.shear_toughness) at.shear_toughness = tougher * settings.shear_toughness->at(x);
  constexpr double equal = 1.0 + 1e-12;
  if (settings.law.mixed_mode->is_potential && at.shear_toughness > equal * at.toughness)
    throw settings.where.at("shear_toughness")
        .error(fmt::format("{} is more than the toughness in opening, {}: by Xu and Needleman's potential a sheared "
                           "interface would then push its sides apart",
                           quantity_text(at.shear_toughness, "J/m^2"), quantity_text(at.toughness, "J/m^2")));
  return at;
}

}  // namespace

double Scatter::factor(const Vector& x) const {
  const double s2 = std::log1p(coefficient * coefficient);
  return std::exp(std::sqrt(s2) * field.at(x) - 0.5 * s2);
}

std::span<const TractionSeparationLaw> interface_laws() {
  static const std::vector<TractionSeparationLaw> laws = [] {
    const auto in_one_mode = traction_separation_laws();
    std::vector<TractionSeparationLaw> all(in_one_mode.begin(), in_one_mode.end());
    all.push_back(tabulated_law());
    return all;
  }();
  return laws;
}

std::vector<InterfaceSettings> read_interfaces(const ConfigTable& root, const std::filesystem::path& case_directory,
                                               std::vector<std::filesystem::path>& data_files) {
  std::vector<InterfaceSettings> interfaces;
  for (const ConfigTable& table : root.tables("interface")) {
    InterfaceSettings settings = read_interface(table, interfaces.size() + 1, case_directory, data_files);
    for (const InterfaceSettings& other : interfaces)
      if (other.name == settings.name)
        throw table.error(fmt::format("another interface has the name \"{}\" already", settings.name));
    interfaces.push_back(std::move(settings));
  }
  return interfaces;
}

UniformInterface read_uniform_interface(const ConfigTable& table, const std::filesystem::path& directory) {
  InterfaceSettings settings{.name = {}, .where = table};
  std::vector<std::filesystem::path> data_files;
  for (const char* key : {"rate", "branches"})
    if (table.has(key)) throw table.at(key).error("separations alone have no time, which it needs: leave it out here");
  read_law(table, directory, settings, data_files);
  read_modes(table, settings);
  for (const auto* value : {&settings.strength, &settings.toughness})
    if (value->varies) throw table.error("strength and toughness have to be the same everywhere here");
  const InterfaceStrength at = strength_at(settings, Vector::Zero());
  if (settings.law.law->has_rise() && !(at.stiffness > 0.0))
    throw table.error("\"stiffness\" is required: a rigid interface would take it from the cells beside it");
  if (settings.law.is_all_rise(at))
    throw table.at("stiffness")
        .error(fmt::format(
            "the rise to the strength takes more than the toughness; at least strength^2 / (2 toughness) = {}",
            quantity_text(0.5 * at.strength * at.strength / at.toughness, "Pa/m")));
  return {.law = std::move(settings.law), .at = at};
}

void place_interfaces(const std::vector<InterfaceSettings>& interfaces, const Mesh& mesh, FractureModel& model) {
  for (const InterfaceSettings& settings : interfaces) {
    std::array<Index, 2> regions{-1, -1};
    if (settings.between)
      for (std::size_t i = 0; i < 2; ++i)
        regions[i] = mesh.region_index((*settings.between)[i].one_of(mesh.region_names, "region of the mesh"));
    CohesiveSurface surface{.name = settings.name, .law = settings.law, .faces = {}};
    for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
      const double side = side_of(settings, regions, mesh, f);
      if (side == 0.0) continue;
      surface.faces.push_back(f);
      surface.sign.push_back(side);
      surface.at.push_back(strength_at(settings, mesh.face_centre[f]));
    }
    if (surface.faces.empty()) throw settings.where.error("no face of the mesh is there");
    model.interfaces.push_back(std::move(surface));
  }
}

}  // namespace pfdm
