#include "mesh/mesh_part.h"

#include "mesh/cell_faces.h"

#include <algorithm>
#include <utility>

namespace pfdm {
namespace {

void copy_cells(const Mesh& whole, const std::vector<Index>& cells, Mesh& mesh) {
  mesh.region_names = whole.region_names;
  mesh.shape = take_out(whole.shape, cells);
  mesh.region = take_out(whole.region, cells);
  mesh.cell_centre = take_out(whole.cell_centre, cells);
  mesh.cell_volume = take_out(whole.cell_volume, cells);
}

std::size_t patch_of(const Mesh& mesh, Index face) {
  const auto ends_after = [face](const Patch& patch) { return face < patch.first_face + patch.n_faces; };
  return static_cast<std::size_t>(std::ranges::find_if(mesh.patches, ends_after) - mesh.patches.begin());
}

// A face of the whole; its cells have new numbers, -1 outside of the part.
void add_face(const Mesh& whole, Index face, const std::vector<Index>& number, MeshPart& part) {
  Index owner = number[as_size(whole.owner[face])];
  Index neighbour = whole.is_interior(face) ? number[as_size(whole.neighbour[face])] : -1;
  const bool is_turned = owner < 0;
  if (is_turned) std::swap(owner, neighbour);
  part.face.push_back(face);
  part.mesh.owner.values().push_back(owner);
  if (neighbour >= 0) part.mesh.neighbour.values().push_back(neighbour);
  part.mesh.face_centre.values().push_back(whole.face_centre[face]);
  part.mesh.face_area.values().emplace_back((is_turned ? -1.0 : 1.0) * whole.face_area[face]);
}

}  // namespace

MeshPart part_of(const Mesh& whole, std::vector<Index> cells) {
  MeshPart part;
  copy_cells(whole, cells, part.mesh);
  std::vector<Index> number(as_size(whole.n_cells()), -1);
  for (std::size_t i = 0; i < cells.size(); ++i) number[as_size(cells[i])] = static_cast<Index>(i);
  std::vector<std::vector<Index>> on_patch(whole.patches.size() + 1);
  for (const Index c : cells)
    for (const Index f : whole.faces_of_cell(c)) {
      if (!whole.is_interior(f))
        on_patch[patch_of(whole, f)].push_back(f);
      else if (number[as_size(whole.across(f, c))] < 0)
        on_patch.back().push_back(f);
      else if (whole.owner[f] == c)
        add_face(whole, f, number, part);
    }
  for (std::size_t p = 0; p < on_patch.size(); ++p) {
    part.mesh.patches.push_back({.name = p < whole.patches.size() ? whole.patches[p].name : "cut",
                                 .first_face = part.mesh.n_faces(),
                                 .n_faces = static_cast<Index>(on_patch[p].size())});
    for (const Index f : on_patch[p]) add_face(whole, f, number, part);
  }
  part.cut = static_cast<Index>(whole.patches.size());
  list_faces_of_cells(part.mesh);
  part.cell = std::move(cells);
  return part;
}

}  // namespace pfdm
