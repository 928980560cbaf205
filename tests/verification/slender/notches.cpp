// The samples of cubic fits in prisms beside a slit: what the slit hides is none of them.

#include "mesh/patch_rules.h"
#include "solver/momentum/bending/fit_surroundings.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace pfdm::verification::this_file {
namespace {

constexpr Index n = 6;  // squares of a side of 1 along each edge; the slit is y = n/2, x > n/2

// One layer of prisms, two a square; the points of the slit are there twice, but for its tip.
Mesh slit_square() {
  CellSoup soup;
  soup.region_names = {"body"};
  const Index plane = (n + 1) * (n + 1) + n / 2;
  for (const double z : {0.0, 1.0}) {
    for (Index k = 0; k < (n + 1) * (n + 1); ++k)
      soup.points.emplace_back(static_cast<double>(k % (n + 1)), static_cast<double>(k / (n + 1)), z);
    for (Index i = n / 2 + 1; i <= n; ++i) soup.points.emplace_back(static_cast<double>(i), 0.5 * n, z);
  }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const auto at = [&](Index a, Index b) {
        const bool is_upper_lip = j == n / 2 && b == 0 && i + a > n / 2;
        return is_upper_lip ? (n + 1) * (n + 1) + i + a - n / 2 - 1 : (j + b) * (n + 1) + i + a;
      };
      for (const auto& [p, q, r] : {std::array{at(0, 0), at(1, 0), at(1, 1)}, std::array{at(0, 0), at(1, 1), at(0, 1)}})
        soup.add_cell(CellShape::wedge, std::array{p, r, q, p + plane, r + plane, q + plane}, 0);
    }
  return assemble_mesh(std::move(soup), box_patches(Vector::Zero(), Vector(n, n, 1.0)));
}

TEST(FitSurroundings, EndAtASlit) {
  const Mesh mesh = slit_square();
  const Unknowns unknowns = place_unknowns(
      mesh,
      elastic_body(elastic_model({from_young_poisson(1.0, 0.3)},
                                 {plane_on("zmin"), plane_on("zmax"),
                                  displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); })})));
  FitSurroundings around(mesh, unknowns);
  Index n_beside_tip = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& here = mesh.cell_centre[c];
    for (const Index s : around.of(c)) {
      const Vector there = unknowns.place(mesh, s);
      const double below = here.y() - 0.5 * n, beyond = there.y() - 0.5 * n;
      if (below * beyond >= 0.0) continue;
      const double x = (here.x() * beyond - there.x() * below) / (beyond - below);  // where the line crosses y = n/2
      EXPECT_LT(x, 0.5 * n + 1e-9) << c << ' ' << s;
      n_beside_tip += x > 0.5 * n - 1.0 ? 1 : 0;
    }
  }
  EXPECT_GT(n_beside_tip, 10);
}

}  // namespace
}  // namespace pfdm::verification::this_file
