// Cantilevers of layers that differ in stiffness, in plane strain, 25 x 1.5 mm under a force at the end, against
// quadratic elements (layered_elements.py): how wrong the bending of few or long cells is, and what is said of it.

#include "solver/fracture/words/bending_words.h"
#include "tests/verification/layers/cantilever.h"
#include "tests/verification/slender/cell_beams.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::cantilever;

struct Laminate {
  std::string name;
  std::vector<double> shares;  // of the thickness
  std::vector<bool> stiff;
  std::array<double, 3> deflection;  // by 1 per width, the softer modulus 1: ratios of 4, 10, 100
};

const Laminate halves{"halves", {0.5, 0.5}, {true, false}, {9238.26, 6153.38, 1194.16}},
    film{"film", {0.1, 0.9}, {true, false}, {10804.4, 7832.14, 5124.69}},
    skins{"skins", {0.1, 0.8, 0.1}, {true, false, true}, {6874.26, 3165.25, 383.503}},
    core{"core", {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {false, true, false}, {15160.6, 12630.1, 3609.18}};
constexpr std::array<double, 3> ratios{4.0, 10.0, 100.0};

enum class In { plane, space, laws, across, along, within, tetrahedra };

std::string name_of(In in) {
  constexpr std::array names{"plane", "space", "laws", "prisms across", "prisms along", "prisms within", "tetrahedra"};
  return names[static_cast<std::size_t>(in)];
}

struct Meshed {
  const Laminate& of;
  double ratio;
  std::vector<Index> cells;  // across each layer
  Index along;
  In in;
};

// Of one region each layer.
Mesh mesh_of(const Meshed& beam) {
  std::vector<double> levels{0.0}, tops;
  BoxHexesSettings box;
  for (std::size_t k = 0; k < beam.cells.size(); ++k) {
    const double from = levels.back(), n = static_cast<double>(beam.cells[k]);
    for (Index j = 1; j <= beam.cells[k]; ++j) levels.push_back(from + beam.of.shares[k] * static_cast<double>(j) / n);
    tops.push_back(levels.back());
    box.axes[1].push_back({beam.of.shares[k] * height, beam.cells[k], 1.0});
  }
  const Index across = count_of(levels) - 1;
  box.axes[0] = {{span, beam.along, 1.0}};
  box.axes[2] = {{width, 1, 1.0}};
  const auto cut = beam.in == In::across   ? BoxCut::prisms_across
                   : beam.in == In::along  ? BoxCut::prisms_along
                   : beam.in == In::within ? BoxCut::prisms_within
                                           : BoxCut::six_tetrahedra;
  Mesh mesh = beam.in < In::across ? make_box_hexes(box)
                                   : make_cell_beam({.cut = cut,
                                                     .boxes = {beam.along, across, 1},
                                                     .size = Vector(span, height, height / static_cast<double>(across)),
                                                     .levels = levels});
  mesh.region_names.clear();
  for (std::size_t k = 0; k < tops.size(); ++k) mesh.region_names.push_back(fmt::format("layer {}", k));
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    mesh.region[c] = 0;
    while (mesh.cell_centre[c].y() > height * tops[static_cast<std::size_t>(mesh.region[c])]) ++mesh.region[c];
  }
  return mesh;
}

FractureModel model_of(const Meshed& beam) {
  std::vector<IsotropicElasticity> moduli;
  for (const bool is_stiff : beam.of.stiff) moduli.push_back(from_young_poisson(is_stiff ? beam.ratio : 1.0, 0.3));
  const auto side = beam.in == In::plane ? plane_on : symmetry_on;
  FractureModel model =
      elastic_model(moduli, {side("zmin"), side("zmax"),
                             displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                             traction_of(Load::tip)});
  if (beam.in == In::laws)
    for (RegionModel& region : model.regions)
      region.stiffness = std::make_shared<const MandelMatrix>(stiffness_matrix(region.elasticity));
  return model;
}

struct Found {
  double error = 0.0;  // stiffness over that of the elements, less 1
  std::optional<std::string> warning;
};

Found bend(const Meshed& beam) {
  const Mesh mesh = mesh_of(beam);
  const FractureModel model = model_of(beam);
  double deflection = 0.0;
  if (beam.in == In::laws) {
    deflection = displacements_by_laws(mesh, model)[mesh.patch_index("xmax")].y();
  } else {
    const auto solution = solve_elastic(mesh, model, {}, 1e-8);
    EXPECT_TRUE(solution->equilibrium.converged);
    deflection = solution->solver->balance().patch_displacements(solution->u)[mesh.patch_index("xmax")].y();
  }
  const std::size_t k = beam.ratio > 50.0 ? 2 : (beam.ratio > 5.0 ? 1 : 0);
  Found found{.error = beam.of.deflection[k] / deflection - 1.0, .warning = bending_warning(mesh, model)};
  report_row(fmt::format("{}, 1 to {}, {}, {} cells, {} along", beam.of.name, beam.ratio, name_of(beam.in),
                         fmt::join(beam.cells, " + "), beam.along),
             {{"stiffness, less 1", found.error}, {"warned", found.warning ? 1.0 : 0.0}});
  return found;
}

// In per cent; 0 without a warning. "Too high or too low" says no sign.
double said(const Found& found) {
  if (!found.warning) return 0.0;
  const std::size_t at = found.warning->find("about ");
  const double size = at == std::string::npos ? 0.0 : std::stod(found.warning->substr(at + 6));
  const bool either = found.warning->find("too high or") != std::string::npos;
  return either ? std::copysign(size, found.error)
                : (found.warning->find("% too low") != std::string::npos ? -size : size);
}

// A warning where the error is above 4 %, within a factor of two; none below 2 %.
void expect_truth(const Meshed& beam) {
  const Found found = bend(beam);
  const double error = 100.0 * found.error, words = said(found);
  if (std::abs(error) > 4.0) {
    EXPECT_GT(words / error, 0.5) << found.warning.value_or("no warning");
    EXPECT_LT(words / error, 2.0) << found.warning.value_or("no warning");
  }
  if (std::abs(error) < 2.0) {
    EXPECT_FALSE(found.warning.has_value()) << *found.warning;
  }
}

TEST(LaminateBeams, InPlaneMeshesAreWarnedOfWhereMaterialsAreOfOneCell) {
  for (const double ratio : ratios)
    for (const Index along : {66, 17}) {
      for (const Laminate* of : {&halves, &film}) {
        if (of == &halves && ratio > 50.0) continue;  // it does not converge
        expect_truth({*of, ratio, {1, 1}, along, In::plane});
        expect_truth({*of, ratio, {4, 4}, along, In::plane});
      }
      expect_truth({skins, ratio, {1, 1, 1}, along, In::plane});
      expect_truth({skins, ratio, {1, 2, 1}, along, In::plane});
      expect_truth({core, ratio, {2, 2, 2}, along > 50 ? along : 33, In::plane});
    }
}

TEST(LaminateBeams, InPlaneMeshesAreWarnedOfWhereCellsAreLong) {
  for (const double ratio : ratios) {
    expect_truth({halves, ratio, {2, 2}, 11, In::plane});
    expect_truth({core, ratio, {2, 2, 2}, 11, In::plane});
    expect_truth({halves, ratio, {4, 4}, 17, In::plane});
  }
}

TEST(LaminateBeams, InSpaceAreWarnedOfWhereMaterialsAreOfOneOrTwoCells) {
  for (const double ratio : ratios)
    for (const Index along : {66, 33}) {
      if (ratio < 50.0) {
        expect_truth({halves, ratio, {1, 1}, along, In::space});
        expect_truth({core, ratio, {1, 1, 1}, along, In::space});
      }
      expect_truth({film, ratio, {1, 1}, along, In::space});
      expect_truth({halves, ratio, {2, 2}, along, In::space});
      expect_truth({halves, ratio, {4, 4}, along, In::space});
      expect_truth({skins, ratio, {1, 1, 1}, along, In::space});
      expect_truth({core, ratio, {2, 2, 2}, along, In::space});
    }
}

// Stiffnesses that may depend on the direction: lines of cells, as in space.
TEST(LaminateBeams, OfTensorsBendAsThoseOfModuli) {
  for (const double ratio : ratios)
    for (const Index along : {66, 33}) {
      std::vector<Meshed> beams{{film, ratio, {2, 4}, along, In::laws},
                                {skins, ratio, {1, 1, 1}, along, In::laws},
                                {core, ratio, {2, 2, 2}, along, In::laws}};
      if (ratio < 50.0) beams.push_back({halves, ratio, {1, 1}, along, In::laws});
      for (Meshed& beam : beams) {
        const double by_laws = bend(beam).error;
        expect_truth(beam);
        beam.in = In::space;
        EXPECT_NEAR(by_laws, bend(beam).error, 1e-5);
      }
    }
}

TEST(LaminateBeams, OfPrismsAndTetrahedraAreWarnedOfByTheirContrast) {
  for (const double ratio : {4.0, 10.0})
    for (const In in : {In::across, In::along, In::within, In::tetrahedra}) {
      const bool converges = in != In::along;  // with few layers and ten times the modulus those along do not
      if (converges || ratio < 5.0) expect_truth({halves, ratio, {2, 2}, 33, in});
      if (converges || ratio < 5.0) expect_truth({core, ratio, {2, 2, 2}, 33, in});
      if (converges) expect_truth({halves, ratio, {1, 1}, 66, in});
    }
}

TEST(LaminateBeams, NameTheirMaterialAndTheRemedy) {
  const auto warning =
      bending_warning(mesh_of({film, 4.0, {1, 1}, 66, In::plane}), model_of({film, 4.0, {1, 1}, 66, In::plane}));
  ASSERT_TRUE(warning.has_value());
  EXPECT_NE(warning->find("region \"layer 1\": 2 layers of hexahedra 379 um long across 1.5 mm"), std::string::npos)
      << *warning;
  EXPECT_NE(warning->find("one cell across have 47 % of it about their own middles"), std::string::npos) << *warning;
  EXPECT_NE(warning->find("two cells across each material ([mesh])"), std::string::npos) << *warning;
}

}  // namespace
}  // namespace pfdm::verification::this_file
