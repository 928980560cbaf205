#include "solver/momentum/rigid_motion.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double broken = 0.999;  // damage from which on a cell holds nothing together
constexpr double sound = 0.9;     // a part without a cell of less damage than this is a crumb of the crack
constexpr double singular = 1e-10;

using Form = Eigen::Matrix<double, 6, 6>;

// Rigid motions are u = a + b x (x - origin) / size.
struct Part {
  std::vector<Index> cells;
  Vector origin = Vector::Zero();  // [m]
  double size = 0.0;               // [m]
  Form form = Form::Zero();        // quadratic form of what is prescribed of (a, b)
};

std::vector<Part> connected_parts(const Mesh& mesh, const CellField<double>& damage, CellField<Index>& part_of_cell) {
  const auto holds = [&](Index c) { return damage.size() == 0 || damage[c] < broken; };
  part_of_cell = CellField<Index>(as_size(mesh.n_cells()), -1);
  std::vector<Part> parts;
  for (Index first = 0; first < mesh.n_cells(); ++first) {
    if (part_of_cell[first] >= 0 || !holds(first)) continue;
    const auto number = static_cast<Index>(parts.size());
    Part& part = parts.emplace_back();
    part.cells.push_back(first);
    part_of_cell[first] = number;
    for (std::size_t i = 0; i < part.cells.size(); ++i)
      for (const Index f : mesh.faces_of_cell(part.cells[i])) {
        if (!mesh.is_interior(f)) continue;
        const Index other = mesh.across(f, part.cells[i]);
        if (part_of_cell[other] >= 0 || !holds(other)) continue;
        part_of_cell[other] = number;
        part.cells.push_back(other);
      }
  }
  return parts;
}

void place_and_measure(const Mesh& mesh, Part& part) {
  for (const Index c : part.cells) part.origin += mesh.cell_centre[c] / double(part.cells.size());
  for (const Index c : part.cells)
    for (const Index f : mesh.faces_of_cell(c))
      part.size = std::max(part.size, (mesh.face_centre[f] - part.origin).norm());
}

using Motion = Eigen::Matrix<double, 3, 6>;

Motion motion_at(const Part& part, const Vector& x) {
  Motion motion;
  const Vector r = (x - part.origin) / part.size;
  motion << Tensor::Identity(), (Tensor() << 0, r[2], -r[1], -r[2], 0, r[0], r[1], -r[0], 0).finished();
  return motion;
}

void resist(Part& part, const Vector& x, const Tensor& prescribed) {
  const Motion motion = motion_at(part, x);
  part.form += motion.transpose() * prescribed * motion;
}

// Two places of the part move alike.
void resist_apart(Part& part, const Vector& x, const Vector& image) {
  const Motion motion = motion_at(part, x) - motion_at(part, image);
  part.form += motion.transpose() * motion;
}

// Motions that the kind of the mesh leaves out.
void resist_out_of_plane(const Unknowns& unknowns, Form& form) {
  const double much = std::max(form.trace(), 1.0);
  if (unknowns.is_axisymmetric()) {
    // A ring can only move along the axis; all else strains it.
    const Vector axis = Vector::UnitZ();
    form.topLeftCorner<3, 3>() += much * (Tensor::Identity() - axis * axis.transpose());
    form.bottomRightCorner<3, 3>() += much * Tensor::Identity();
  } else if (const Vector n = unknowns.plane_normal; n.norm() > 0.0) {
    // A plane mesh can only move within its plane.
    form.topLeftCorner<3, 3>() += much * n * n.transpose();
    form.bottomRightCorner<3, 3>() += much * (Tensor::Identity() - n * n.transpose());
  }
}

std::string direction(const Vector& v) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", v[0], v[1], v[2]); }

// The axes among the free directions of a form, or else one of these: "x and y" or "(0.707, 0.707, 0)".
std::string free_directions(const Tensor& form, double negligible) {
  std::vector<std::string> axes;
  for (Index i = 0; i < 3; ++i)
    if (form(i, i) <= negligible) axes.emplace_back(1, static_cast<char>('x' + i));
  if (!axes.empty()) return fmt::format("{}", fmt::join(axes, " and "));
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(form);
  return eigen.eigenvalues()[0] <= negligible ? direction(eigen.eigenvectors().col(0)) : "";
}

// How the part can move; empty if it cannot.
std::string free_motion(const Part& part) {
  const double negligible = singular * std::max(part.form.trace(), 1.0);
  const Tensor translation = part.form.topLeftCorner<3, 3>();
  if (const std::string along = free_directions(translation, negligible); !along.empty())
    return fmt::format("it can move along {}", along);
  const Tensor mixed = part.form.topRightCorner<3, 3>(), held = translation.inverse();
  const Tensor rotation = part.form.bottomRightCorner<3, 3>() - mixed.transpose() * held * mixed;
  const std::string about = free_directions(rotation, negligible);
  if (about.empty()) return "";
  const Vector b = Eigen::SelfAdjointEigenSolver<Tensor>(rotation).eigenvectors().col(0);
  const Vector a = -held * mixed * b;
  return fmt::format("it can rotate about {} through {} m", about, direction(part.origin + part.size * b.cross(a)));
}

std::string describe(const Mesh& mesh, const Part& part, std::size_t n_parts, bool cracked) {
  if (n_parts == 1) return "the body can still move rigidly";
  return fmt::format("{} {} parts, and the one around {} m (region \"{}\", {} of {} cells) can still move rigidly",
                     cracked ? "the initial damage cuts the body into" : "the cells of the mesh form", n_parts,
                     direction(part.origin), mesh.region_names[as_size(mesh.region[part.cells.front()])],
                     part.cells.size(), mesh.n_cells());
}

}  // namespace

void require_held(const Mesh& mesh, const Unknowns& unknowns, const CellField<double>& damage) {
  CellField<Index> part_of_cell;
  std::vector<Part> parts = connected_parts(mesh, damage, part_of_cell);
  for (Part& part : parts) place_and_measure(mesh, part);
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k) {
    const Index face = unknowns.face_of_node[k], part = part_of_cell[mesh.owner[face]];
    if (part >= 0)
      resist(parts[as_size(part)], mesh.face_centre[face], Tensor::Identity() - unknowns.free_directions[k]);
  }
  const auto face_of = [&](Index node) { return unknowns.face_of_node[as_size(node - unknowns.n_cells)]; };
  for (const PeriodicNodes& pair : unknowns.periodic) {
    const Index face = face_of(pair.node), image = face_of(pair.image), part = part_of_cell[mesh.owner[face]];
    if (part >= 0 && part == part_of_cell[mesh.owner[image]])
      resist_apart(parts[as_size(part)], mesh.face_centre[face], mesh.face_centre[image]);
  }
  if (damage.size() > 0)
    std::erase_if(parts, [&](const Part& part) {
      return std::ranges::all_of(part.cells, [&](Index c) { return damage[c] > sound; });
    });
  for (Part& part : parts) {
    resist_out_of_plane(unknowns, part.form);
    if (const std::string motion = free_motion(part); !motion.empty())
      throw InputError(fmt::format(
          "{}: {}; prescribe displacements (or symmetry) so that all three translations and rotations are held",
          describe(mesh, part, parts.size(), damage.size() > 0), motion));
  }
}

}  // namespace pfdm
