// Effective stiffness of boxes of crystals, against what is known exactly: a laminate of two materials with inclined
// axes, the bulk modulus of an aggregate of cubic crystals, and the order of the energies between the bounds of Reuss
// and Voigt (Hill, Proc. Phys. Soc. A 65 (1952) 349).

#include "physics/elasticity/anisotropy.h"
#include "physics/elasticity/effective_stiffness.h"
#include "physics/random_numbers.h"
#include "solver/homogenization/homogenization.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

constexpr double GPa = 1e9;

Mesh cube(Index cells) {
  BoxHexesSettings settings;
  settings.axes = {{{{.length = 1.0, .n = cells}}, {{.length = 1.0, .n = cells}}, {{.length = 1.0, .n = cells}}}};
  return make_box_hexes(settings);
}

Tensor about(const Vector& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

// One region, or one for each of the stiffnesses; of each cell.
LinearComposite composite_of(std::vector<MandelMatrix> of_cells, Index n_regions) {
  LinearComposite composite;
  for (Index r = 0; r < n_regions; ++r) {
    composite.elasticity.push_back(closest_isotropic(of_cells.front()));
    composite.zone.push_back(r);
  }
  const auto kept = std::make_shared<const std::vector<MandelMatrix>>(std::move(of_cells));
  composite.stiffness = [kept](const Mesh&, Index cell) { return &(*kept)[as_size(cell)]; };
  return composite;
}

MandelMatrix effective(const Mesh& mesh, const LinearComposite& composite, const char* loading) {
  const Homogenized result =
      homogenize(mesh, composite, {.loading = &homogenization_loading(loading), .tolerance = 1e-10});
  report_row(fmt::format("{}, {} cells", loading, mesh.n_cells()),
             {{"energies", result.energy_difference()}, {"asymmetry", result.asymmetry}});
  return result.stiffness;
}

// Strains within the layers, normal to z, and stresses across them are the same in all.
MandelMatrix laminate(const std::vector<MandelMatrix>& layers) {
  const std::array<int, 3> within{0, 1, 5}, across{2, 3, 4};
  const double part = 1.0 / static_cast<double>(layers.size());
  Tensor soft = Tensor::Zero(), coupled = Tensor::Zero(), left = Tensor::Zero();
  for (const MandelMatrix& C : layers) {
    const Tensor inverse = Tensor(C(across, across)).inverse();
    soft += part * inverse;
    coupled += part * inverse * C(across, within);
    left += part * (C(within, within) - C(within, across) * inverse * C(across, within));
  }
  const Tensor normal = soft.inverse();
  MandelMatrix C;
  C(across, across) = normal;
  C(across, within) = normal * coupled;
  C(within, across) = (normal * coupled).transpose();
  C(within, within) = left + coupled.transpose() * normal * coupled;
  return C;
}

TEST(Crystals, OfALaminateAreExact) {
  const OrthotropicConstants carbon{140 * GPa, 10 * GPa, 10 * GPa, 0.3, 0.3, 0.4, 5 * GPa, 5 * GPa, 3.6 * GPa};
  const MandelMatrix along = orthotropic_stiffness(carbon);
  const std::vector<MandelMatrix> layers{turned(along, about(Vector::UnitY(), 30.0)),
                                         turned(along, about(Vector::UnitZ(), 50.0) * about(Vector::UnitY(), -20.0))};
  Mesh mesh = cube(6);
  mesh.region_names = {"lower", "upper"};
  std::vector<MandelMatrix> of_cells;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    mesh.region[c] = mesh.cell_centre[c].z() < 0.5 ? 0 : 1;
    of_cells.push_back(layers[as_size(mesh.region[c])]);
  }
  const MandelMatrix exact = laminate(layers);
  const MandelMatrix found = effective(mesh, composite_of(std::move(of_cells), 2), "periodic");
  EXPECT_LT((found - exact).norm() / exact.norm(), 1e-8);
}

// Copper. Under a uniform change of volume every cubic crystal has the same strain and the same pressure.
TEST(Crystals, OfAnAggregateKeepToHillsBounds) {
  const double C11 = 168.4 * GPa, C12 = 121.4 * GPa, C44 = 75.4 * GPa;
  const MandelMatrix copper = cubic_stiffness(C11, C12, C44);
  constexpr Index grains = 4, cells = 2 * grains;
  RandomNumbers random(1);
  std::vector<MandelMatrix> of_grains;
  MandelMatrix voigt = MandelMatrix::Zero(), reuss = MandelMatrix::Zero();
  constexpr Index n_grains = grains * grains * grains;
  for (Index g = 0; g < n_grains; ++g) {
    of_grains.push_back(turned(copper, random.rotation()));
    voigt += of_grains.back() / n_grains;
    reuss += of_grains.back().inverse() / n_grains;
  }
  reuss = reuss.inverse().eval();
  const Mesh mesh = cube(cells);
  std::vector<MandelMatrix> of_cells;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto at = [&](int k) { return static_cast<Index>(mesh.cell_centre[c][k] * grains); };
    of_cells.push_back(of_grains[as_size(at(0) + grains * (at(1) + grains * at(2)))]);
  }
  const LinearComposite composite = composite_of(std::move(of_cells), 1);
  std::vector<MandelMatrix> ascending{reuss};
  for (const char* loading : {"uniform traction", "periodic", "uniform displacement"}) {
    ascending.push_back(effective(mesh, composite, loading));
    const IsotropicElasticity mean = closest_isotropic(ascending.back());
    report_row(loading,
               {{"bulk modulus over the crystals', less 1", mean.bulk_modulus() / ((C11 + 2.0 * C12) / 3.0) - 1.0},
                {"shear modulus", mean.mu}});
    EXPECT_NEAR(mean.bulk_modulus() / ((C11 + 2.0 * C12) / 3.0), 1.0, 1e-8);
  }
  ascending.push_back(voigt);
  for (std::size_t k = 1; k < ascending.size(); ++k) {
    const Eigen::SelfAdjointEigenSolver<MandelMatrix> difference(ascending[k] - ascending[k - 1]);
    EXPECT_GE(difference.eigenvalues()[0], -1e-3 * copper.norm()) << k;
    EXPECT_GT(difference.eigenvalues()[5], 1e-3 * copper.norm()) << k;
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
