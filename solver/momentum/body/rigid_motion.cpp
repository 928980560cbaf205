#include "solver/momentum/body/rigid_motion.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

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

// Rigid motions are u = a + b x (x - origin) / size. Pieces that periodic faces join lie beside each other: cells are
// shifted from where the mesh has them.
struct Part {
  std::vector<Index> cells;
  Vector origin = Vector::Zero();  // [m]
  double size = 0.0;               // [m]
  Form form = Form::Zero();        // quadratic form of what is prescribed of (a, b)
};

// Partner of each boundary face that moves as it does, or -1.
std::vector<Index> periodic_partners(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<Index> partner(mesh.n_faces(), -1);
  const auto face_of = [&](Index node) { return unknowns.face_of_node[node - unknowns.n_cells]; };
  for (const PeriodicNodes& pair : unknowns.periodic) {
    const Index face = face_of(pair.node), image = face_of(pair.image);
    partner[face] = image;
    partner[image] = face;
  }
  return partner;
}

struct Placement {
  CellField<Index> part;    // -1: of none
  CellField<Vector> shift;  // [m]
};

class Parts {
 public:
  Parts(const Mesh& mesh, const CellField<double>& damage, const std::vector<Index>& partner, Placement& placed)
      : mesh_(mesh), damage_(damage), partner_(partner), placed_(placed) {
    placed.part = CellField<Index>(mesh.n_cells(), -1);
    placed.shift = CellField<Vector>(mesh.n_cells(), Vector::Zero());
  }

  std::vector<Part> find() {
    std::vector<Part> parts;
    for (Index first = 0; first < mesh_.n_cells(); ++first) {
      if (!is_left(first)) continue;
      const auto number = count_of(parts);
      Part& part = parts.emplace_back();
      add(first, Vector::Zero(), number, part);
      for (std::size_t i = 0; i < part.cells.size();) {
        for (; i < part.cells.size(); ++i) grow(part.cells[i], number, part);
        cross_sides(number, part);
      }
    }
    return parts;
  }

 private:
  bool is_left(Index c) const { return placed_.part[c] < 0 && (damage_.size() == 0 || damage_[c] < broken); }
  void add(Index cell, const Vector& shift, Index number, Part& part) {
    placed_.part[cell] = number;
    placed_.shift[cell] = shift;
    part.cells.push_back(cell);
  }
  void grow(Index cell, Index number, Part& part) {
    for (const Index f : mesh_.faces_of_cell(cell))
      if (mesh_.is_interior(f) && is_left(mesh_.across(f, cell)))
        add(mesh_.across(f, cell), placed_.shift[cell], number, part);
  }
  // To one more piece, if there is one.
  void cross_sides(Index number, Part& part) {
    for (const Index cell : part.cells)
      for (const Index f : mesh_.faces_of_cell(cell)) {
        const Index image = partner_[f];
        if (image < 0 || !is_left(mesh_.owner[image])) continue;
        add(mesh_.owner[image], placed_.shift[cell] + mesh_.face_centre[f] - mesh_.face_centre[image], number, part);
        return;
      }
  }

  const Mesh& mesh_;
  const CellField<double>& damage_;
  const std::vector<Index>& partner_;
  Placement& placed_;
};

void place_and_measure(const Mesh& mesh, const CellField<Vector>& shift, Part& part) {
  for (const Index c : part.cells) part.origin += (mesh.cell_centre[c] + shift[c]) / double(part.cells.size());
  for (const Index c : part.cells)
    for (const Index f : mesh.faces_of_cell(c))
      part.size = std::max(part.size, (mesh.face_centre[f] + shift[c] - part.origin).norm());
}

using Motion = Eigen::Matrix<double, 3, 6>;

Motion motion_at(const Part& part, const Vector& x) {
  Motion motion;
  const Vector r = (x - part.origin) / part.size;
  motion << Tensor::Identity(), (Tensor() << 0, r[2], -r[1], -r[2], 0, r[0], r[1], -r[0], 0).finished();
  return motion;
}

// Faces hold rotations that their centres do not see.
void resist_spins(const Unknowns& unknowns, const CellField<Index>& part_of, std::vector<Part>& parts) {
  for (const SpinHold& hold : unknowns.spin_holds)
    if (const Index part = part_of[hold.cell]; part >= 0)
      parts[part].form.bottomRightCorner<3, 3>() += hold.lever * hold.lever.transpose();
}

void resist(Part& part, const Vector& x, const Tensor& prescribed) {
  const Motion motion = motion_at(part, x);
  part.form += motion.transpose() * prescribed * motion;
}

// In the directions in which they are stiff.
void resist_by_foundations(const Mesh& mesh, const Unknowns& unknowns, const Placement& placed,
                           std::vector<Part>& parts) {
  for (const PatchCondition& on : unknowns.conditions) {
    if (on.condition.kind != BoundaryCondition::Kind::elastic_foundation) continue;
    const Patch& patch = mesh.patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index c = mesh.owner[f], part = placed.part[c];
      if (part < 0) continue;
      const FoundationStiffness k = on.condition.foundation(mesh.face_centre[f]);
      const FoundationStiffness held{.across = k.across > 0.0 ? 1.0 : 0.0, .along = k.along > 0.0 ? 1.0 : 0.0};
      resist(parts[part], mesh.face_centre[f] + placed.shift[c], held.tensor(mesh.face_area[f].normalized()));
    }
  }
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

// Motion that is left to the part; empty if there is none.
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
  return fmt::format("it can rotate about {} through {}", about, point_text(part.origin + part.size * b.cross(a)));
}

std::string describe(const Mesh& mesh, const Part& part, std::size_t n_parts, bool cracked) {
  if (n_parts == 1) return "the body can still move rigidly";
  return fmt::format("{} {} parts, and the one around {} (region \"{}\", {} of {} cells) can still move rigidly",
                     cracked ? "the initial damage cuts the body into" : "the cells of the mesh form", n_parts,
                     point_text(part.origin), mesh.region_names[mesh.region[part.cells.front()]], part.cells.size(),
                     mesh.n_cells());
}

}  // namespace

void require_held(const Mesh& mesh, const Unknowns& unknowns, const CellField<double>& damage) {
  Placement placed;
  const std::vector<Index> partner = periodic_partners(mesh, unknowns);
  std::vector<Part> parts = Parts(mesh, damage, partner, placed).find();
  const auto place = [&](Index face) { return (mesh.face_centre[face] + placed.shift[mesh.owner[face]]).eval(); };
  for (Part& part : parts) place_and_measure(mesh, placed.shift, part);
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k) {
    const Index face = unknowns.face_of_node[k], part = placed.part[mesh.owner[face]];
    if (part >= 0) resist(parts[part], place(face), Tensor::Identity() - unknowns.free_directions[k]);
  }
  resist_by_foundations(mesh, unknowns, placed, parts);
  resist_spins(unknowns, placed.part, parts);
  for (Index face = mesh.n_interior_faces(); face < mesh.n_faces(); ++face) {
    const Index image = partner[face], part = placed.part[mesh.owner[face]];
    if (image > face && part >= 0 && part == placed.part[mesh.owner[image]])
      resist_apart(parts[part], place(face), place(image));
  }
  if (damage.size() > 0)
    std::erase_if(parts, [&](const Part& part) {
      return std::ranges::all_of(part.cells, [&](Index c) { return damage[c] > sound; });
    });
  for (Part& part : parts) {
    resist_out_of_plane(unknowns, part.form);
    if (const std::string motion = free_motion(part); !motion.empty())
      throw InputError(
          fmt::format("{}: {}; prescribe displacements (or symmetry, or an elastic foundation) so that all three "
                      "translations and rotations are held",
                      describe(mesh, part, parts.size(), damage.size() > 0), motion));
  }
}

}  // namespace pfdm
