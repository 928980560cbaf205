#pragma once
// Fields on a mesh as binary .vtu files that ParaView and meshio open as they are: no array of texts, which meshio
// takes for an error.

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
/// Of a tensor the symmetric part is written, six components named XX YY ZZ XY YZ XZ as in ParaView, or all nine, row
/// by row.
struct NamedField {
  using Values = std::variant<const CellField<double>*, const CellField<Vector>*, const CellField<Tensor>*,
                              const CellField<Index>*>;
  std::string name;
  Values values;
  Precision precision = Precision::double_precision;  ///< integers have 32 bits whatever it says
  std::string unit{};                                 ///< VTK's UNITS_LABEL; empty: none
  bool all_components = false;                        ///< of a tensor
};

/// A point of the mesh that some of the cells around it have once more.
struct PointCopy {
  Index point = 0;
  std::vector<Index> cells;
};

/// The displacement of the points of a mesh, where some are split.
struct SplitPoints {
  std::vector<PointCopy> copies;
  std::vector<Vector> displacement;  ///< of all points of the mesh, then of the copies [m]
};

enum class Compression { zlib, lz4, none };

struct VtuSettings {
  Compression compression = Compression::zlib;
  std::string time_unit{};  ///< of the array TimeValue; empty: none
};

class VtuWriter {
 public:
  /// Turns the mesh into VTK's grid, once; the mesh may go away afterwards.
  explicit VtuWriter(const Mesh& mesh, VtuSettings settings = {});
  /// The same of these faces alone, each a polygon; fields have one value per face. Without points to be
  /// split.
  VtuWriter(const Mesh& mesh, const std::vector<Index>& faces, VtuSettings settings = {});
  ~VtuWriter();
  VtuWriter(VtuWriter&&) noexcept;
  VtuWriter& operator=(VtuWriter&&) noexcept;

  /// Writes the file whole or not at all. `time` is what ParaView shows as time, in the settings' unit. The number of
  /// each region stands in the field data as region_NAME. With `points` the points have the field "displacement", in
  /// single precision, and copies come after those that the mesh's cells use.
  /// Every field has one value per cell: InputError otherwise. ComputationError if the file cannot be written.
  void write(const std::filesystem::path& path, const std::vector<NamedField>& fields, double time,
             const SplitPoints* points = nullptr) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace pfdm
