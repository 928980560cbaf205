// The fields of a frame.

#include "postproc/fields/frame.h"
#include "postproc/fields/vtu_writer.h"
#include "tests/postproc/awkward_fields.h"
#include "tests/postproc/temporary_folder.h"

#include <gtest/gtest.h>
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

namespace pfdm::test::this_file {
namespace {

TEST(Frame, has_the_names_of_the_interface) {
  const TemporaryFolder folder;
  const Mesh mesh = mesh_of_all_shapes();
  const AwkwardFields f(mesh.n_cells());
  const OutputFields output{.displacement = f.vector,
                            .damage = f.scalar,
                            .stress = f.tensor,
                            .strain = f.tensor,
                            .energy_density = f.scalar,
                            .driving_energy = f.scalar,
                            .fracture_energy_density = f.scalar,
                            .traction = {}};
  VtuWriter(mesh).write(folder / "a.vtu", frame_fields(mesh, output), 0.0);
  const auto grid = read_back(folder / "a.vtu");
  for (const char* name : {"damage", "displacement", "stress", "strain", "material", "energy_density"})
    EXPECT_NE(grid->GetCellData()->GetArray(name), nullptr) << name;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_EQ(grid->GetCellData()->GetArray("damage")->GetComponent(c, 0), f.scalar[c]);
    EXPECT_EQ(grid->GetCellData()->GetArray("material")->GetComponent(c, 0), mesh.region[c]);
  }
}

}  // namespace
}  // namespace pfdm::test::this_file
