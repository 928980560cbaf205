#include "mesh/generators/tetgen_wrapper.h"

#include <fmt/format.h>
#include <tetgen.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>

#include "mesh/bounding_box.h"
#include "mesh/generators/expected_cells.h"
#include "mesh/generators/lifted_points.h"
#include "physics/error.h"
#include "physics/system/packed_bytes.h"
#include "physics/system/separate_process.h"

namespace pfdm {
namespace {

constexpr double volume_tolerance = 1.3;  // over the regular one, before a cell is split

// TetGen's tolerances suppose coordinates of order one; a power of two scales them without rounding.
class Scaling {
 public:
  explicit Scaling(const std::vector<Vector>& points) {
    const auto [low, high] = bounding_box(points);
    factor_ = std::exp2(-std::ceil(std::log2((high - low).maxCoeff())));
  }
  void put(const Vector& x, double* to) const { Eigen::Map<Vector>{to} = factor_ * x; }
  Vector get(const double* from) const { return Eigen::Map<const Vector>(from) / factor_; }

 private:
  double factor_;
};

// TetGen's callback takes no context.
struct CallbackContext {
  const Scaling* scaling;
  const std::function<double(const Vector&)>* wanted_size;
};
thread_local CallbackContext callback_context{};

// TetGen 1.5 passes neither edge lengths nor a volume, though its signature has room for them.
bool is_too_large(double* a, double* b, double* c, double* d, double*, double) {
  const Scaling& scaling = *callback_context.scaling;
  const std::array<Vector, 4> x{scaling.get(a), scaling.get(b), scaling.get(c), scaling.get(d)};
  const double volume = std::abs((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0])) / 6.0;
  const double h = (*callback_context.wanted_size)(0.25 * (x[0] + x[1] + x[2] + x[3]));
  return volume > volume_tolerance * regular_volume * h * h * h;
}

// tetgenio frees with delete[] what it is given.
void fill_points(tetgenio& in, const std::vector<Vector>& points, const Scaling& scaling) {
  in.numberofpoints = static_cast<int>(points.size());
  in.pointlist = new double[3 * points.size()];
  for (std::size_t i = 0; i < points.size(); ++i) scaling.put(points[i], in.pointlist + 3 * i);
}

void fill_facets(tetgenio& in, const std::vector<Triangle>& triangles) {
  in.numberoffacets = static_cast<int>(triangles.size());
  in.facetlist = new tetgenio::facet[triangles.size()];
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    tetgenio::facet& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3];
    std::ranges::copy(triangles[i], facet.polygonlist->vertexlist);
  }
}

void fill_holes_and_seeds(tetgenio& in, const TetgenInput& input, const Scaling& scaling) {
  in.numberofholes = static_cast<int>(input.holes.size());
  in.holelist = new double[3 * input.holes.size()];
  for (std::size_t i = 0; i < input.holes.size(); ++i) scaling.put(input.holes[i], in.holelist + 3 * i);
  in.numberofregions = static_cast<int>(input.seeds.size());
  in.regionlist = new double[5 * input.seeds.size()];
  for (std::size_t i = 0; i < input.seeds.size(); ++i) {
    double* seed = in.regionlist + 5 * i;
    scaling.put(input.seeds[i].at, seed);
    seed[3] = input.seeds[i].region;
    seed[4] = -1.0;  // no bound on volumes: the callback decides
  }
}

// Codes of terminatetetgen() in tetgen.h.
[[noreturn]] void throw_tetgen_error(int code) {
  switch (code) {
    case 1: throw ComputationError("TetGen ran out of memory");
    case 3: throw InputError("TetGen: two surfaces of the mesh intersect");
    case 4:
    case 5: throw InputError("TetGen: surfaces of the mesh come too close to each other to fill the gap between them");
    case 10: throw InputError("TetGen refuses the surfaces of the mesh");
    default: throw ComputationError(fmt::format("TetGen stopped with its internal error {}", code));
  }
}

void run_tetgen(const TetgenInput& input, const Scaling& scaling, tetgenio& in, tetgenio& out) {
  // p: surfaces bound the mesh; Y: keep them; q: quality; A: regions; a: volumes, by the callback; Q: quiet.
  std::string switches = fmt::format("pYq{:g}/{:g}AaQ", input.max_radius_edge_ratio, input.min_dihedral_angle);
  callback_context = {&scaling, &input.wanted_size};
  in.tetunsuitable = &is_too_large;
  try {
    tetrahedralize(switches.data(), &in, &out);
  } catch (const int code) {
    throw_tetgen_error(code);
  } catch (const std::bad_alloc&) {
    throw_tetgen_error(1);
  }
}

TetgenOutput read_output(const TetgenInput& input, const Scaling& scaling, const tetgenio& out) {
  TetgenOutput result;
  const std::vector<Vector>& kept = input.surfaces.points;
  if (static_cast<std::size_t>(out.numberofpoints) < kept.size())
    throw ComputationError("TetGen dropped points of the surfaces");
  result.points = kept;
  for (auto i = kept.size(); i < static_cast<std::size_t>(out.numberofpoints); ++i)
    result.points.push_back(scaling.get(out.pointlist + 3 * i));
  const auto n = static_cast<std::size_t>(out.numberoftetrahedra);
  if (n == 0 || out.numberoftetrahedronattributes < 1) throw ComputationError("TetGen made no cells");
  const auto n_attributes = static_cast<std::size_t>(out.numberoftetrahedronattributes);
  for (std::size_t t = 0; t < n; ++t) {
    std::array<Index, 4> cell{};
    std::copy_n(out.tetrahedronlist + 4 * t, 4, cell.begin());
    const Vector& origin = result.points[cell[0]];
    const Vector normal = (result.points[cell[1]] - origin).cross(result.points[cell[2]] - origin);
    if (normal.dot(result.points[cell[3]] - origin) < 0.0) std::swap(cell[1], cell[2]);
    result.tetrahedra.push_back(cell);
    result.region.push_back(static_cast<Index>(std::lround(out.tetrahedronattributelist[t * n_attributes])));
  }
  return result;
}

TetgenOutput tetrahedralized_here(const TetgenInput& input) {
  const Scaling scaling(input.surfaces.points);
  tetgenio in;
  tetgenio out;
  fill_points(in, input.surfaces.points, scaling);
  fill_facets(in, input.surfaces.triangles);
  fill_holes_and_seeds(in, input, scaling);
  run_tetgen(input, scaling, in, out);
  TetgenOutput mesh = read_output(input, scaling, out);
  settle_lifted_points(input.surfaces.points.size(), mesh);
  return mesh;
}

std::string bytes_of(const TetgenOutput& mesh) {
  BytePacker packer;
  packer.put(mesh.points);
  packer.put(mesh.tetrahedra);
  packer.put(mesh.region);
  return packer.take();
}

}  // namespace

// TetGen's destructors crash where it has given up.
TetgenOutput tetrahedralize_regions(const TetgenInput& input) {
  const auto bytes = computed_separately([&] { return bytes_of(tetrahedralized_here(input)); });
  if (!bytes)
    throw InputError(
        "TetGen crashes between the surfaces of the mesh, or takes more memory than there is: they are flat, or far "
        "closer to each other than their triangles are large");
  ByteUnpacker unpacker(*bytes);
  TetgenOutput mesh;
  unpacker.take(mesh.points);
  unpacker.take(mesh.tetrahedra);
  unpacker.take(mesh.region);
  return mesh;
}

}  // namespace pfdm
