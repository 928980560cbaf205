#pragma once
// What the problems of finite strain share: bodies of one hyperelastic material, boxes of hexahedra that are mapped.

#include "tests/verification/support.h"

#include "physics/materials/hyperelastic.h"

#include <array>
#include <functional>
#include <string>
#include <utility>

namespace pfdm::verification {

inline FractureModel finite_body(const Mesh& mesh, const std::shared_ptr<const Material>& material,
                                 std::vector<BoundaryCondition> boundary) {
  FractureModel model = elastic_model(
      std::vector<IsotropicElasticity>(mesh.region_names.size(), material->elasticity()), std::move(boundary));
  for (RegionModel& region : model.regions) region.material = material;
  return model;
}

struct Drawn {
  FractureState state;
  StepReport report;
  Index krylov_iterations = 0;

  const Vector& force(const Mesh& mesh, const char* patch) const { return report.reaction[mesh.patch_index(patch)]; }
};

inline Drawn draw(const Mesh& mesh, const FractureModel& model, Index steps, double tolerance = 1e-8) {
  FractureRun run(mesh, model, {.equilibrium_tolerance = tolerance},
                  {.initial_increment = 1.0 / double(steps), .maximum_increment = 1.0 / double(steps), .stops = {}});
  Drawn drawn;
  drawn.state = run_to_end(run, [&](const FractureState&, const StepReport& report) { drawn.report = report; });
  drawn.krylov_iterations = run.krylov_iterations();
  return drawn;
}

enum class BoxCells { hexahedra, tetrahedra, prisms };

/// The unit cube, n hexahedra in each direction or each cut into six tetrahedra or two prisms, whose points are moved.
/// Patches as those of a box.
inline Mesh mapped_box(const std::array<Index, 3>& n, const std::function<Vector(const Vector&)>& map,
                       BoxCells cells = BoxCells::hexahedra) {
  CellSoup soup;
  soup.region_names = {"body"};
  std::vector<Vector> place;
  for (Index k = 0; k <= n[2]; ++k)
    for (Index j = 0; j <= n[1]; ++j)
      for (Index i = 0; i <= n[0]; ++i) {
        place.emplace_back(double(i) / double(n[0]), double(j) / double(n[1]), double(k) / double(n[2]));
        soup.points.push_back(map(place.back()));
      }
  const auto at = [&](Index i, Index j, Index k) { return i + (n[0] + 1) * (j + (n[1] + 1) * k); };
  for (Index k = 0; k < n[2]; ++k)
    for (Index j = 0; j < n[1]; ++j)
      for (Index i = 0; i < n[0]; ++i) {
        const std::array<Index, 8> points{
            at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
            at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
        if (cells == BoxCells::hexahedra) {
          soup.add_cell(CellShape::hexahedron, points, 0);
          continue;
        }
        if (cells == BoxCells::prisms) {
          for (const auto& [a, b] : {std::pair{2, 1}, {3, 2}})
            soup.add_cell(CellShape::wedge,
                          std::array{points[0], points[a], points[b], points[4], points[a + 4], points[b + 4]}, 0);
          continue;
        }
        for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})  // about the diagonal 0 6
          soup.add_cell(CellShape::tetrahedron, std::array{points[0], points[a], points[b], points[6]}, 0);
      }
  std::vector<PatchRule> rules;
  for (Index axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0})
      rules.push_back({std::string(1, "xyz"[axis]) + (side == 0.0 ? "min" : "max"),
                       [=](const Vector&, const Vector&, std::span<const Index> points) {
                         return std::ranges::all_of(points, [&](Index p) { return place[p][axis] == side; });
                       }});
  return assemble_mesh(std::move(soup), rules);
}

}  // namespace pfdm::verification
