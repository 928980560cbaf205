// The file, in this machine's byte order: magic, format version, size of the whole file; case hash and the state, each
// list behind its length; FNV-1a checksum of all before it.
#include "postproc/fields/checkpoint.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/other_case.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace pfdm {
namespace {

constexpr std::string_view magic = "PFDMCKPT";
constexpr std::uint32_t format_version = 18;
constexpr std::size_t size_position = magic.size() + sizeof(format_version);
constexpr std::size_t header_size = size_position + sizeof(std::uint64_t);
constexpr std::size_t checksum_size = sizeof(std::uint64_t);

// 64-bit FNV-1a (Fowler, Noll, Vo; IETF draft-eastlake-fnv).
std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return hash;
}

class Writer {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    append(&value, sizeof(T));
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(std::uint64_t{list.size()});
    append(list.data(), list.size() * sizeof(T));
  }
  template <class T, class Place>
  void operator()(const Field<T, Place>& field) {
    (*this)(field.values());
  }
  std::string& bytes() { return bytes_; }

 private:
  void append(const void* data, std::size_t n) { bytes_.append(static_cast<const char*>(data), n); }
  std::string bytes_;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::filesystem::path& path) : rest_(bytes), path_(path) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<T>);
    take(&value, sizeof(T));
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    std::uint64_t n = 0;
    (*this)(n);
    if (n > rest_.size() / sizeof(T)) fail();
    list.resize(n);
    take(list.data(), list.size() * sizeof(T));
  }
  template <class T, class Place>
  void operator()(Field<T, Place>& field) {
    (*this)(field.values());
  }
  void expect_end() const {
    if (!rest_.empty()) fail();
  }

 private:
  void take(void* data, std::size_t n) {
    if (n > rest_.size()) fail();
    if (n > 0) std::memcpy(data, rest_.data(), n);
    rest_.remove_prefix(n);
  }
  [[noreturn]] void fail() const {
    throw InputError(
        fmt::format("the checkpoint {} is corrupt: the lengths of its lists do not match its size", path_.string()));
  }

  std::string_view rest_;
  const std::filesystem::path& path_;
};

/// Whether all that is not whole is finite.
class FiniteCheck {
 public:
  /// `unknown` may be infinite.
  explicit FiniteCheck(const double& unknown) : unknown_(&unknown) {}

  void operator()(const double& value) {
    is_finite_ = is_finite_ && (std::isfinite(value) || (&value == unknown_ && value > 0.0));
  }
  void operator()(const Vector& value) { is_finite_ = is_finite_ && value.allFinite(); }
  void operator()(const InterfaceHistory& h) {
    for (const double value :
         {h.reached, h.reached_in_shear, h.dissipated, h.rubbed, h.viscous, h.overstress, h.opening})
      (*this)(value);
    for (const Vector& q : h.branch) (*this)(q);
    (*this)(h.slip);
    (*this)(h.shear);
  }
  template <std::integral T>
  void operator()(T) {}
  template <class T>
  void operator()(const std::vector<T>& list) {
    for (const T& value : list) (*this)(value);
  }
  template <class T, class Place>
  void operator()(const Field<T, Place>& field) {
    (*this)(field.values());
  }
  bool is_finite() const { return is_finite_; }

 private:
  const double* unknown_;
  bool is_finite_ = true;
};

// The one list of what is in a state, for both directions; it does not compile any more when the state gets a member.
template <class Archive, class State>
void archive_state(Archive& archive, State& state) {
  auto& [step, load, increment, displacement, damage, driving_energy, closure, histories, interfaces, boundary_force,
         energy, heat, fatigue, balance] = state;
  const auto each = [&](auto&... members) { (archive(members), ...); };
  each(step, load, increment, displacement, damage, driving_energy, closure, histories.first, histories.values,
       interfaces, boundary_force);
  for (const EnergyEntry& entry : energy_entries) archive(energy.*entry.value);
  auto& [rise, made, cycle, transmitted, cycle_transmittance, cycle_change, account, duration, elapsed, stood_for,
         stretch, felt] = heat;
  each(rise, made, cycle, transmitted, cycle_transmittance, cycle_change, account.made, account.stored, account.lost,
       duration, elapsed, stood_for, stretch, felt);
  auto& [accumulated, active, spent, cycle_start, cycle_growth, computed_cycles, whole_cycles, jumped_cycles] = fatigue;
  each(accumulated, active, spent, cycle_start, cycle_growth, computed_cycles, whole_cycles, jumped_cycles);
  each(balance.greatest_force, balance.tightening, balance.is_tightest);
}

template <class T>
T value_at(std::string_view bytes, std::size_t position) {
  T value{};
  std::memcpy(&value, bytes.data() + position, sizeof(T));
  return value;
}

// What lies between header and checksum.
std::string_view checked_payload(std::string_view bytes, const std::filesystem::path& path) {
  const std::string name = path.string();
  if (bytes.size() < header_size + checksum_size || !bytes.starts_with(magic))
    throw InputError(fmt::format("{} is not a checkpoint, or is truncated", name));
  const auto version = value_at<std::uint32_t>(bytes, magic.size());
  if (version != format_version)
    throw InputError(fmt::format(
        "the checkpoint {} has format {}; this program reads format {}: run the case again, without --restart", name,
        version, format_version));
  const auto size = value_at<std::uint64_t>(bytes, size_position);
  if (bytes.size() != size)
    throw InputError(fmt::format("the checkpoint {} has {} bytes instead of {}: it was truncated or extended", name,
                                 bytes.size(), size));
  const std::size_t body = bytes.size() - checksum_size;
  if (fnv1a(bytes.substr(0, body)) != value_at<std::uint64_t>(bytes, body))
    throw InputError(fmt::format("the checkpoint {} is corrupt: its checksum is wrong", name));
  return bytes.substr(header_size, body - header_size);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const FractureState& state, const std::string& case_hash) {
  Writer writer;
  writer.bytes() = magic;
  writer(format_version);
  writer(std::uint64_t{0});
  writer(std::vector<char>(case_hash.begin(), case_hash.end()));
  archive_state(writer, state);
  const std::uint64_t size = writer.bytes().size() + checksum_size;
  std::memcpy(writer.bytes().data() + size_position, &size, sizeof(size));
  writer(fnv1a(writer.bytes()));
  write_file(path, writer.bytes());
}

FractureState read_checkpoint(const std::filesystem::path& path, const std::string& case_hash) {
  const std::string bytes = read_file(path);
  Reader reader(checked_payload(bytes, path), path);
  std::vector<char> hash;
  reader(hash);
  if (!std::equal(hash.begin(), hash.end(), case_hash.begin(), case_hash.end()))
    throw OtherCase(fmt::format("the checkpoint {} belongs to another case or to other input ({} instead of {})",
                                path.string(), std::string(hash.begin(), hash.end()), case_hash));
  FractureState state;
  archive_state(reader, state);
  reader.expect_end();
  return state;
}

bool is_finite(const FractureState& state) {
  FiniteCheck check(state.heat.cycle_change);
  archive_state(check, state);
  return check.is_finite();
}

}  // namespace pfdm
