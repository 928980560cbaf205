#pragma once
// Cell fields on a mesh as binary, compressed .vtu files that ParaView opens as they are.

#include "mesh/mesh.h"

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace pfdm {

/// What a frame needs to be read back exactly is written in double precision, what is only looked at in single.
enum class Precision { single_precision, double_precision };

/// A field under the name it has in the file. Points to the values: they have to outlive the write.
/// Of a tensor the symmetric part is written, six components named XX YY ZZ XY YZ XZ as in ParaView.
struct NamedField {
  using Values = std::variant<const CellField<double>*, const CellField<Vector>*, const CellField<Tensor>*,
                              const CellField<Index>*>;
  std::string name;
  Values values;
  Precision precision = Precision::double_precision;  ///< integers have 32 bits whatever it says
};

class VtuWriter {
 public:
  /// Turns the mesh into VTK's grid, once; the mesh may go away afterwards.
  explicit VtuWriter(const Mesh& mesh);
  ~VtuWriter();
  VtuWriter(VtuWriter&&) noexcept;
  VtuWriter& operator=(VtuWriter&&) noexcept;

  /// Writes the file whole or not at all. `time` is what ParaView shows as time: the load parameter [-] or [s].
  /// Every field has one value per cell: InputError otherwise. ComputationError if the file cannot be written.
  void write(const std::filesystem::path& path, const std::vector<NamedField>& fields, double time) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace pfdm
