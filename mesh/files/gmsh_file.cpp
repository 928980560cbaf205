#include "mesh/files/gmsh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <unordered_map>
#include <utility>

#include "mesh/files/gmsh_stream.h"

namespace pfdm {
namespace {

struct ElementType {
  int gmsh;
  int dimension;
  int n_points;
  int vtk;
};

// Gmsh and VTK number the points of these alike.
constexpr ElementType element_types[] = {{15, 0, 1, 1}, {1, 1, 2, 3},  {2, 2, 3, 5},  {3, 2, 4, 9},
                                         {4, 3, 4, 10}, {5, 3, 8, 12}, {6, 3, 6, 13}, {7, 3, 5, 14}};

class GmshReader {
 public:
  explicit GmshReader(const std::filesystem::path& path) : in_(path) {}

  MeshFile read() {
    read_format();
    for (std::string section = in_.next_section(); !section.empty(); section = in_.next_section()) {
      const bool is_new = version_ > 4.0;
      bool skips = false;
      if (section == "PhysicalNames")
        read_names();
      else if (section == "Entities")
        read_entities();
      else if (section == "PartitionedEntities")
        throw partitioned();
      else if (section == "Nodes")
        is_new ? read_nodes_41() : read_nodes_22();
      else if (section == "Elements")
        is_new ? read_elements_41() : read_elements_22();
      else
        skips = true;  // fields, comments, what is periodic
      in_.end_section(skips);
    }
    file_.region_names.emplace(0, "body");
    file_.has_groups = true;
    file_.has_volumes_without_cells =
        n_volumes_ > 0 && std::ranges::none_of(file_.cell_type, [](int type) { return type >= 10; });
    file_.integer_arrays["gmsh:physical"] = std::move(physical_);
    file_.integer_arrays["gmsh:geometrical"] = std::move(entity_);
    return std::move(file_);
  }

 private:
  using Entity = std::pair<int, int>;  // dimension and number

  InputError partitioned() const {
    return in_.error_in_file("it is partitioned; save it in one part, as with Gmsh's \"Unpartition\"");
  }

  void read_format() {
    if (in_.next_section() != "MeshFormat")
      throw in_.error_in_file("it does not begin with $MeshFormat: not a Gmsh file");
    version_ = in_.real_as_text();
    const int is_binary = in_.integer_as_text(), size = in_.integer_as_text();
    if (version_ != 4.1 && version_ != 2.2)
      throw in_.error_in_file(fmt::format(
          "it is of Gmsh's format {:g}; supported are 4.1 and 2.2 (gmsh -format msh41 or -format msh22)", version_));
    if (size != 8) throw in_.error_in_file(fmt::format("its numbers have {} bytes; supported are 8", size));
    if (is_binary != 0) {
      in_.end_line();
      in_.set_binary(true);
      if (in_.integer() != 1) throw in_.error_in_file("its binary numbers have the opposite byte order");
    }
    in_.end_section();
  }

  void read_names() {
    for (int n = in_.integer_as_text(); n > 0; --n) {
      const int dimension = in_.integer_as_text();
      const int number = in_.integer_as_text();
      const std::string name = in_.quoted();
      if (dimension == 3) file_.region_names[number] = name;
      if (dimension == 2) file_.patch_names[number] = name;
      if (dimension == 1) file_.line_names[number] = name;
    }
  }

  // Which physical group an entity is in; of volumes and surfaces no more than one.
  void read_entities() {
    std::uint64_t n[4];
    for (std::uint64_t& of_dimension : n) of_dimension = in_.count();
    n_volumes_ = n[3];
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::uint64_t i = 0; i < n[dimension]; ++i) {
        const Entity entity{dimension, in_.integer()};
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in_.real();
        for (std::uint64_t k = in_.count(); k > 0; --k) put_in_group(entity, group_of(in_.integer()));
        if (dimension > 0)
          for (std::uint64_t k = in_.count(); k > 0; --k) in_.integer();
      }
  }

  /// Of what is in a group turned round, its number is negative.
  int group_of(int number) const {
    if (number == std::numeric_limits<int>::min())
      throw in_.error(fmt::format("expected the number of a physical group, found {}", number));
    return std::abs(number);
  }

  void put_in_group(const Entity& entity, int group) {
    const auto [place, is_new] = group_of_entity_.emplace(entity, group);
    if (!is_new && place->second != group && entity.first >= 2)
      throw in_.error_in_file(fmt::format("its {} {} is in {} and in {}; it may be in one physical group only",
                                          entity.first == 3 ? "volume" : "surface", entity.second,
                                          called(entity.first, place->second), called(entity.first, group)));
  }

  std::string called(int dimension, int group) const {
    const auto& names = dimension == 3 ? file_.region_names : file_.patch_names;
    const auto found = names.find(group);
    return found == names.end() ? fmt::format("{}", group) : fmt::format("\"{}\"", found->second);
  }

  void add_node(std::uint64_t number, const Vector& x) {
    if (file_.points.size() >= static_cast<std::size_t>(std::numeric_limits<Index>::max()))
      throw in_.error_in_file("it has too many nodes to number");
    if (!node_.emplace(number, count_of(file_.points)).second)
      throw in_.error(fmt::format("node {} is listed twice", number));
    file_.points.push_back(x);
  }

  Vector read_place() {
    const double x = in_.real(), y = in_.real(), z = in_.real();
    return {x, y, z};
  }

  void read_nodes_22() {
    for (int n = in_.integer_as_text(), i = (in_.end_line(), 0); i < n; ++i) {
      const int number = in_.integer();
      add_node(static_cast<std::uint64_t>(number), read_place());
    }
  }

  void read_nodes_41() {
    std::uint64_t n_blocks = in_.count();
    for (int i = 0; i < 3; ++i) in_.count();  // how many nodes, the least and the largest number
    for (; n_blocks > 0; --n_blocks) {
      const int dimension = in_.integer();
      in_.integer();
      const int n_parameters = in_.integer() != 0 ? dimension : 0;
      std::vector<std::uint64_t> numbers;
      for (std::uint64_t n = in_.count(); n > 0; --n) numbers.push_back(in_.count());
      for (const std::uint64_t number : numbers) {
        add_node(number, read_place());
        for (int i = 0; i < n_parameters; ++i) in_.real();
      }
    }
  }

  const ElementType& type_of(int gmsh, std::uint64_t element) const {
    const auto* const found = std::ranges::find(element_types, gmsh, &ElementType::gmsh);
    if (found == std::end(element_types))
      throw in_.error(fmt::format(
          "the element {} is of Gmsh's type {}; supported are types 1 to 7 and 15: points, lines, triangles, "
          "quadrilaterals and cells of first order (Mesh.ElementOrder = 1)",
          element, gmsh));
    return *found;
  }

  template <class ReadNode>
  void add_element(const ElementType& type, std::uint64_t number, Index group, Index entity,
                   const ReadNode& read_node) {
    for (int i = 0; i < type.n_points; ++i) {
      const std::uint64_t node = read_node();
      const auto found = node_.find(node);
      if (found == node_.end())
        throw in_.error(fmt::format("element {} refers to node {}, which does not exist", number, node));
      file_.cell_points.push_back(found->second);
    }
    file_.cell_type.push_back(type.vtk);
    file_.cell_offsets.push_back(count_of(file_.cell_points));
    file_.cell_number.push_back(static_cast<std::int64_t>(number));
    physical_.push_back(group);
    entity_.push_back(entity);
    if (type.dimension >= 2 && version_ < 4.0) group_once(type.dimension);
  }

  // The format 2.2 has an element of two groups twice.
  void group_once(int dimension) {
    std::vector<Index> key(file_.cell_points.end() - (file_.cell_offsets.back() - *(file_.cell_offsets.end() - 2)),
                           file_.cell_points.end());
    std::ranges::sort(key);
    const auto [place, is_new] = cell_of_points_.emplace(std::move(key), count_of(physical_) - 1);
    const Index group = physical_.back(), other = physical_[place->second];
    if (!is_new && other != group)
      throw in_.error_in_file(
          fmt::format("its {} element {} is in {} and, as {}, in {}; it may be in one physical group only",
                      dimension == 3 ? "volume" : "surface", file_.cell_number[place->second], called(dimension, other),
                      file_.cell_number.back(), called(dimension, group)));
  }

  void read_elements_22() {
    const int n_elements = in_.integer_as_text();
    in_.end_line();
    for (int read = 0; read < n_elements;) {
      // Text: number type n_tags; binary: type n_elements n_tags, then the number of each.
      const int first = in_.integer(), second = in_.integer(), n_tags = in_.integer();
      const int gmsh_type = in_.is_binary() ? first : second;
      for (int left = in_.is_binary() ? second : 1; left > 0; --left, ++read) {
        const auto number = static_cast<std::uint64_t>(in_.is_binary() ? in_.integer() : first);
        const ElementType& type = type_of(gmsh_type, number);
        std::vector<int> tags;
        for (int i = 0; i < n_tags; ++i) tags.push_back(in_.integer());
        if (tags.size() > 2 && tags[2] > 0) throw partitioned();
        tags.resize(std::max<std::size_t>(tags.size(), 2), 0);
        add_element(type, number, group_of(tags[0]), tags[1],
                    [&] { return static_cast<std::uint64_t>(in_.integer()); });
      }
    }
  }

  void read_elements_41() {
    std::uint64_t n_blocks = in_.count();
    for (int i = 0; i < 3; ++i) in_.count();  // how many elements, the least and the largest number
    for (; n_blocks > 0; --n_blocks) {
      const int dimension = in_.integer();
      const int entity = in_.integer();
      const int gmsh_type = in_.integer();
      const auto group = group_of_entity_.find({dimension, entity});
      for (std::uint64_t n = in_.count(); n > 0; --n) {
        const std::uint64_t number = in_.count();
        add_element(type_of(gmsh_type, number), number, group == group_of_entity_.end() ? 0 : group->second, entity,
                    [&] { return in_.count(); });
      }
    }
  }

  GmshStream in_;
  double version_ = 0.0;
  std::uint64_t n_volumes_ = 0;  // of the geometry
  MeshFile file_;
  std::map<Entity, int> group_of_entity_;
  std::unordered_map<std::uint64_t, Index> node_;       // by Gmsh's number
  std::map<std::vector<Index>, Index> cell_of_points_;  // sorted points of surface and volume elements
  std::vector<Index> physical_, entity_;                // of each cell
};

}  // namespace

MeshFile read_gmsh_file(const std::filesystem::path& path) { return GmshReader(path).read(); }

}  // namespace pfdm
