#pragma once
// A mesh of all shapes of cells, fields that are hard to keep, and the grid that a file holds.

#include "mesh/files/import_mesh.h"
#include "tests/postproc/temporary_folder.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace pfdm::test {

/// A cube with a neighbour of every other shape, so that each shape shares a face with it or with its pyramid.
inline Mesh mesh_of_all_shapes() {
  CellSoup soup;
  soup.points = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},  {0, 0, 1},     {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
                 {0, -1, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0.5, 0.5, 2}, {2, 0, 0}, {2, 1, 0}, {0.5, -1, 1.5}};
  soup.region_names = {"glass", "epoxy"};
  const auto add = [&](CellShape shape, std::vector<Index> points, Index region) {
    soup.add_cell(shape, points, region);
  };
  add(CellShape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 0);
  add(CellShape::pyramid, {4, 5, 6, 7, 12}, 1);
  add(CellShape::tetrahedron, {4, 12, 15, 5}, 1);
  add(CellShape::wedge, {1, 13, 5, 2, 14, 6}, 0);
  add(CellShape::polyhedron, {0, 1, 4, 5, 8, 9, 10, 11}, 1);
  soup.polyhedron_faces = {
      {6, 4, 8, 9, 1, 0, 4, 4, 5, 10, 11, 4, 8, 11, 10, 9, 4, 0, 1, 5, 4, 4, 8, 0, 4, 11, 4, 9, 10, 5, 1}};
  return assemble_mesh(std::move(soup), {});
}

inline vtkSmartPointer<vtkUnstructuredGrid> read_back(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Numbers with digits down to the last bit, different in every place.
inline double awkward(int i) { return std::sin(1.0 + i) / 3.0; }

struct AwkwardFields {
  explicit AwkwardFields(Index n) : scalar(n), vector(n, Vector::Zero()), tensor(n, Tensor::Zero()), integer(n) {
    for (Index i = 0; i < n; ++i) {
      scalar[i] = awkward(i);
      vector[i] = Vector(awkward(i), -awkward(i + 1), 1e-300 * awkward(i + 2));
      for (int k = 0; k < 9; ++k) tensor[i](k / 3, k % 3) = awkward(9 * i + k);
      tensor[i] = symmetric_part(tensor[i]);
      integer[i] = 7 - 3 * i;
    }
  }
  CellField<double> scalar;
  CellField<Vector> vector;
  CellField<Tensor> tensor;
  CellField<Index> integer;
};

}  // namespace pfdm::test
