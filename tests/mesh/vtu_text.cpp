#include "tests/mesh/vtu_text.h"

#include <algorithm>
#include <fstream>

namespace pfdm {
namespace {

constexpr std::array<int, 5> vtk_types{10, 13, 14, 12, 42};

template <class Values>
void write_array(std::ostream& out, const std::string& attributes, const Values& values) {
  out << "<DataArray format=\"ascii\" " << attributes << ">\n";
  for (const auto& value : values) out << value << ' ';
  out << "\n</DataArray>\n";
}

std::vector<double> flat(const std::vector<Vector>& points) {
  std::vector<double> values;
  for (const Vector& x : points) values.insert(values.end(), x.begin(), x.end());
  return values;
}

void write_cells(std::ostream& out, const std::vector<VtuText::Cell>& cells) {
  std::vector<Index> connectivity, offsets, faces, face_offsets;
  std::vector<int> types;
  for (const VtuText::Cell& cell : cells) {
    connectivity.insert(connectivity.end(), cell.points.begin(), cell.points.end());
    offsets.push_back(count_of(connectivity));
    types.push_back(cell.type);
    faces.insert(faces.end(), cell.faces.begin(), cell.faces.end());
    face_offsets.push_back(cell.faces.empty() ? -1 : count_of(faces));
  }
  write_array(out, "type=\"Int32\" Name=\"connectivity\"", connectivity);
  write_array(out, "type=\"Int32\" Name=\"offsets\"", offsets);
  write_array(out, "type=\"UInt8\" Name=\"types\"", types);
  if (faces.empty()) return;
  write_array(out, "type=\"Int32\" Name=\"faces\"", faces);
  write_array(out, "type=\"Int32\" Name=\"faceoffsets\"", face_offsets);
}

}  // namespace

void VtuText::write_vtu(const std::filesystem::path& path) const {
  std::ofstream out(path);
  out.precision(17);
  out << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
      << "<Piece NumberOfPoints=\"" << points.size() << "\" NumberOfCells=\"" << cells.size() << "\">\n<Points>\n";
  write_array(out, "type=\"Float64\" NumberOfComponents=\"3\"", flat(points));
  out << "</Points>\n<Cells>\n";
  write_cells(out, cells);
  out << "</Cells>\n<CellData>\n";
  for (const auto& [name, values] : cell_arrays) write_array(out, "type=\"Float64\" Name=\"" + name + "\"", values);
  out << "</CellData>\n<PointData>\n";
  for (const auto& [name, values] : point_arrays) write_array(out, "type=\"Float64\" Name=\"" + name + "\"", values);
  out << "</PointData>\n</Piece></UnstructuredGrid></VTKFile>\n";
}

void VtuText::write_legacy(const std::filesystem::path& path) const {
  std::ofstream out(path);
  out.precision(17);
  out << "# vtk DataFile Version 3.0\ntest\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << points.size() << " double\n";
  for (const double value : flat(points)) out << value << ' ';
  std::size_t size = 0;
  for (const Cell& cell : cells) size += 1 + cell.points.size();
  out << "\nCELLS " << cells.size() << ' ' << size << '\n';
  for (const Cell& cell : cells) {
    out << cell.points.size();
    for (const Index p : cell.points) out << ' ' << p;
    out << '\n';
  }
  out << "CELL_TYPES " << cells.size() << '\n';
  for (const Cell& cell : cells) out << cell.type << '\n';
  if (!cell_arrays.empty()) out << "CELL_DATA " << cells.size() << '\n';
  for (const auto& [name, values] : cell_arrays) {
    out << "SCALARS " << name << " double 1\nLOOKUP_TABLE default\n";
    for (const double value : values) out << value << '\n';
  }
}

VtuText vtu_text(const Mesh& mesh) {
  VtuText text;
  text.points = mesh.points;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto ids = mesh.points_of_cell(c);
    text.cells.push_back({vtk_types[static_cast<std::size_t>(mesh.shape[c])], {ids.begin(), ids.end()}, {}});
    text.cell_arrays["region"].push_back(mesh.region[c]);
  }
  return text;
}

VtuText vtu_text_of_polyhedra(const Mesh& mesh) {
  VtuText text = vtu_text(mesh);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    VtuText::Cell& cell = text.cells[c];
    cell.type = 42;
    cell.faces = {static_cast<Index>(mesh.faces_of_cell(c).size())};
    for (const Index f : mesh.faces_of_cell(c)) {
      const auto ids = mesh.points_of_face(f);
      cell.faces.push_back(count_of(ids));
      cell.faces.insert(cell.faces.end(), ids.begin(), ids.end());
    }
  }
  return text;
}

}  // namespace pfdm
