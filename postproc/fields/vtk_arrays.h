#pragma once
// Values of a field as an array of VTK.

#include "postproc/fields/vtu_writer.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkSmartPointer.h>

#include <string>

namespace pfdm {

/// Gives an array its name, and its unit as VTK's UNITS_LABEL; empty: none.
void name_array(vtkDataArray& array, const std::string& name, const std::string& unit);

/// The values of a field of `n_cells` cells, where they are if its precision allows: they have to outlive the array.
/// Throws InputError if there are more or fewer.
vtkSmartPointer<vtkDataArray> vtk_array(const NamedField& field, Index n_cells);

/// The one value of the array TimeValue, in this unit.
vtkSmartPointer<vtkDoubleArray> vtk_time(double time, const std::string& unit);

}  // namespace pfdm
