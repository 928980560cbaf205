#include "postproc/fields/vtk_arrays.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>

#include <array>
#include <type_traits>
#include <variant>

namespace pfdm {
namespace {

// VTK reads the values where they are; its interface has no notion of arrays that it may not write to.
template <class Array, class T>
vtkSmartPointer<vtkDataArray> view(const T* values, Index n_cells, int n_components) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(n_components);
  constexpr int keep_ownership = 1;
  array->SetArray(const_cast<T*>(values), vtkIdType{n_components} * n_cells, keep_ownership);
  return array;
}

template <class Array, class Field, class Components>
vtkSmartPointer<vtkDataArray> copy(const Field& field, int n_components, const Components& components_of) {
  using Real = typename Array::ValueType;
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(field.size());
  Real* out = array->GetPointer(0);
  for (const auto& value : field)
    for (const double component : components_of(value)) *out++ = static_cast<Real>(component);
  return array;
}

template <class Field, class Components>
vtkSmartPointer<vtkDataArray> copy(const Field& field, Precision precision, int n, const Components& components_of) {
  return precision == Precision::single_precision ? copy<vtkFloatArray>(field, n, components_of)
                                                  : copy<vtkDoubleArray>(field, n, components_of);
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<double>& field, Precision precision) {
  if (precision == Precision::double_precision) return view<vtkDoubleArray>(field.data(), field.size(), 1);
  return copy(field, precision, 1, [](double value) { return std::array{value}; });
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<Vector>& field, Precision precision) {
  static_assert(sizeof(Vector) == 3 * sizeof(double));
  if (precision == Precision::double_precision) {
    const double* values = field.size() == 0 ? nullptr : field.data()->data();
    return view<vtkDoubleArray>(values, field.size(), 3);
  }
  return copy(field, precision, 3, [](const Vector& v) { return std::array{v.x(), v.y(), v.z()}; });
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<Tensor>& field, Precision precision) {
  auto array = copy(field, precision, 6, [](const Tensor& tensor) {
    const Tensor s = symmetric_part(tensor);
    return std::array{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
  });
  vtkIdType component = 0;
  for (const char* name : {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}) array->SetComponentName(component++, name);
  return array;
}

vtkSmartPointer<vtkDataArray> all_components(const CellField<Tensor>& field, Precision precision) {
  return copy(field, precision, 9, [](const Tensor& a) {
    return std::array{a(0, 0), a(0, 1), a(0, 2), a(1, 0), a(1, 1), a(1, 2), a(2, 0), a(2, 1), a(2, 2)};
  });
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<Index>& field, Precision) {
  static_assert(sizeof(Index) == sizeof(int));
  return view<vtkIntArray>(field.data(), field.size(), 1);
}

}  // namespace

void name_array(vtkDataArray& array, const std::string& name, const std::string& unit) {
  array.SetName(name.c_str());
  if (!unit.empty()) array.GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
}

vtkSmartPointer<vtkDataArray> vtk_array(const NamedField& field, Index n_cells) {
  const auto convert = [&](const auto* values) {
    if (values->size() != n_cells)
      throw InputError(fmt::format("the field \"{}\" has {} values for {} cells", field.name, values->size(), n_cells));
    if constexpr (std::is_same_v<decltype(values), const CellField<Tensor>*>)
      if (field.all_components) return all_components(*values, field.precision);
    return to_array(*values, field.precision);
  };
  auto array = std::visit(convert, field.values);
  name_array(*array, field.name, field.unit);
  return array;
}

vtkSmartPointer<vtkDoubleArray> vtk_time(double time, const std::string& unit) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  name_array(*array, "TimeValue", unit);
  array->InsertNextValue(time);
  return array;
}

}  // namespace pfdm
