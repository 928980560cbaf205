#include "cases/program/fracture/case/run_keys.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/fatigue_case.h"
#include "cases/program/fracture/body/mesh/mesh_keys.h"
#include "cases/program/input/config/key_member.h"
#include "cases/program/studies/study_keys.h"
#include "postproc/fields/energy_release_rate.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/solution/preconditioner.h"

#include <limits>
#include <vector>

namespace pfdm {
namespace {

constexpr Range above_zero_to_one{std::numeric_limits<double>::min(), 1.0, false, "above 0 and at most 1"};
// Broken cells beside sound ones leave double precision no more than this.
constexpr Range solvable{1e-12, 1.0, false, "between 1e-12 and 1"};
constexpr Range iterations_range{1.0, 1e9, false, "between 1 and 1e9"};
constexpr Range count{0.0, 1e9, false, "between 0 and 1e9"};
constexpr Range tip_damages{0.1, 0.999, false, "between 0.1 and 0.999"};

const KeyTable& curve_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "output.curve",
      .sentence = "Of which patch and component the force-displacement curve is.",
      .keys = {
          {"patch", text("patch"), "", "Patch of the mesh whose force and displacement the curve has."},
          {"component", choice("component", {"x", "y", "z"}), "", "Direction of the curve's force and displacement."}}};
  return table;
}

const KeyTable& tip_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "output.energy_release_rate[]",
      .sentence = "A region around a crack tip in which the energy release rate is computed (J-integral, G-theta).",
      .keys = {{"name", text("plain name"), "", "Name of the region, with which its columns begin."},
               {"point", point(), "", "Crack tip, or its initial position."},
               {"direction", direction(), "", "Direction of crack growth."},
               {"front", direction(), "[0, 0, 1]; about an axis [0, 1, 0]",
                "Direction along the crack front, over which G is averaged."},
               {"shape", one_of("shape of a region", region_shapes()), "\"disc\"",
                "Shape of the region around the tip: disc or box."},
               {"inner", quantity(dimension::length, range::positive), "",
                "Inner radius or half-width; G is taken in the ring up to outer."},
               {"outer", quantity(dimension::length, range::positive), "", "Outer radius or half-width of the ring."},
               {"tip", choice("way to find the tip", {"fixed", "foremost"}), "\"fixed\"",
                "Whether the tip stays where it is or is the foremost broken place along direction."},
               {"reference_length", quantity(dimension::length, range::positive), "no stress intensities",
                "Length at which stress intensities K1, K2 and the phase angle of an interface crack are told."},
               {"tip_damage", number(tip_damages), "0.9", "Damage above which a place counts as broken for the tip."},
               {"corridor", quantity(dimension::length, range::positive), "no limit",
                "Distance from the line through point within which damage is taken as the tip."}}};
  return table;
}

std::vector<Key> frame_keys() {
  using namespace keys;
  return {
      {"frames_at", list(either({number(), quantity(dimension::length)})), "none",
       "Displacements of the curve's patch or load parameters at which a step ends and fields are written."},
      {"frames_every", whole(count), "0: only frames_at and the last step",
       "Number of steps between frames of the fields."},
      {"time_value", choice("time value", {"displacement", "time", "load", "step"}), "the first that the case has",
       "What ParaView takes for the time of the frames."},
      {"compression", choice("compression", {"zlib", "lz4", "none"}), "\"zlib\"", "Compression of the frames' files."},
      {"format", choice("format", {"vtu", "vtkhdf"}), "\"vtu\"",
       "A .vtu file for each frame, or with \"vtkhdf\" at the end of the run all frames in one file of HDF5."},
      {"slices_through", point(), "none", "Point through which planes are laid whose damaged areas the summary has."}};
}

const KeyTable& output_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "output",
      .sentence = "Which curve and which fields a run writes.",
      .keys = joined({{{"curve", keys::table(curve_keys), "", "Patch and component of the force-displacement curve."}},
                      frame_keys(),
                      {{"energy_release_rate", tables(tip_keys), "none",
                        "Regions around crack tips in which G, K1, K2 and the phase angle are computed."}}})};
  return table;
}

const KeyTable& cohesive_plane_keys() {
  using namespace keys;
  static const KeyTable table{.name = "cohesive.planes[]",
                              .sentence = "A plane across which traction and separation are recorded.",
                              .keys = {{"name", text("plain name"), "", "Name of the plane in the results."},
                                       {"point", point(), "", "A point of the plane."},
                                       {"normal", direction(), "", "Normal of the plane."},
                                       {"half_width", quantity(dimension::length, range::positive), "",
                                        "Length of the columns to either side of the plane."}}};
  return table;
}

}  // namespace

const KeyTable& loading_keys() {
  using namespace keys;
  using L = LoadingSettings;
  static const KeyTable table{
      .name = "loading",
      .sentence = "The load parameter t: its end, increments and what limits them.",
      .keys = {
          stored<&L::end>("end", number(range::positive),
                          "Load parameter t at the end; plain quantities are reached at t = 1."),
          stored<&L::duration>(
              "duration", quantity(dimension::time, range::positive),
              "Time in which the load parameter grows by 1: the rate (speed) of loading, for viscosity, heat, "
              "materials and interfaces with rate.",
              "none"),
          stored<&L::initial_increment>("initial_increment", number(range::positive),
                                        "First increment of the load parameter."),
          stored<&L::maximum_increment>("maximum_increment", number(range::positive),
                                        "Largest increment (step) of the load parameter.",
                                        "the larger of 0.05 and the initial one"),
          stored<&L::minimum_increment>("minimum_increment", number(range::positive),
                                        "Smallest increment; the run ends where it does not converge."),
          stored<&L::damage_growth>("damage_growth", number(above_zero_to_one),
                                    "Largest growth of any cell's damage in a step; increments are cut accordingly."),
          stored<&L::energy_release>(
              "energy_release", number(above_zero_to_one),
              "Largest share of the energy that cracks release in a step; resolves peaks and jumps."),
          stored<&L::finest_increment>("finest_increment", number(range::positive),
                                       "Smallest increment that damage_growth and energy_release ask for."),
          stored<&L::maximum_dissipation>(
              "maximum_dissipation", quantity(dimension::energy, range::positive),
              "Dissipation control (path-following, arc length) through snap-back: most energy of a step."),
      }};
  return table;
}

const KeyTable& solver_keys() {
  using namespace keys;
  using S = StaggeredSettings;
  static const KeyTable table{
      .name = "solver",
      .sentence = "Tolerances of the staggered scheme and the linear solver.",
      .keys = {
          stored<&S::damage_tolerance>(
              "damage_tolerance", number(above_zero_to_one),
              "Largest change of damage between staggered iterations at which they have converged."),
          stored<&S::damage_tolerance_l2>(
              "damage_tolerance_l2", number(above_zero_to_one),
              "Relative change of damage in the norm L2 that suffices for convergence, too.", "none"),
          stored<&S::energy_tolerance>("energy_tolerance", number(above_zero_to_one),
                                       "Relative change of the energy between staggered iterations, and error of "
                                       "stiffnesses over the stored energy, at convergence."),
          stored<&S::equilibrium_tolerance>("equilibrium_tolerance", number(solvable),
                                            "Relative residual of the momentum balance at an accepted step."),
          stored<&S::maximum_iterations>(
              "maximum_iterations", whole(iterations_range),
              "Largest number of staggered iterations of a step before the increment is cut."),
          {"linear", one_of("linear solver", linear_solvers()), "\"automatic\"",
           "Linear solver of the momentum balance: multigrid, or direct by sparse Cholesky factors."},
      }};
  return table;
}

const KeyTable& box_output_keys() {
  static const KeyTable table{.name = "output of a box",
                              .sentence = "Which fields are written of a box along a path of mean strain.",
                              .keys = frame_keys()};
  return table;
}

const KeyTable& cohesive_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "cohesive",
      .sentence = "Surfaces whose traction-separation laws are extracted from the run.",
      .keys = {{"interfaces", list(text("band or interface")), "all bands between two regions, all interfaces",
                "Bands and cohesive interfaces across which traction and separation are recorded."},
               {"planes", tables(cohesive_plane_keys), "none",
                "Planes across which traction and separation are recorded."}}};
  return table;
}

const KeyTable& fracture_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"fracture\"",
      .sentence = "Phase-field fracture of a solid under load.",
      .keys = joined(
          {head_keys(),
           {{"mesh", keys::table(mesh_keys), "", "Mesh of the body: generator or imported file."},
            {"materials", names(keys::table(material_keys)), "", "Materials by name, each of one region or more."},
            {"regions", names(keys::table(region_keys)), "none",
             "What single regions have otherwise than their material."},
            {"fracture", keys::table(fracture_model_keys), "", "Phase-field model of fracture."},
            {"initial", keys::table(initial_damage_keys), "none", "Cracks and damage before the first step."},
            {"boundary", tables(boundary_keys), "", "Boundary conditions: displacements, tractions, symmetry."},
            {"interface", tables(interface_keys), "none", "Cohesive interfaces without thickness."},
            {"loads", keys::table(load_keys), "none", "Body loads: gravity, forces, temperature."},
            {"heat", keys::table(heat_keys), "none", "Heat of what is dissipated: conduction, cycles of load."},
            {"fatigue", keys::table(fatigue_cycle_keys), "none", "Cycles of load, and jumps over them."},
            {"loading", keys::table(loading_keys), "defaults", "Load parameter and its increments."},
            {"solver", keys::table(solver_keys), "defaults", "Tolerances and linear solver."},
            {"output", keys::table(output_keys), "", "Curve and fields that are written."},
            {"cohesive", keys::table(cohesive_keys), "defaults", "Surfaces whose cohesive laws are extracted."},
            {"experiment", keys::table(experiment_keys), "none", "Measured curves to compare with and to fit to."},
            {"fit", keys::table(curve_fit_keys), "none", "Parameters that pfdm fit estimates."},
            {"sweep", keys::table(sweep_keys), "none", "Parameters with which pfdm sweep runs the case."}}})};
  return table;
}

}  // namespace pfdm
