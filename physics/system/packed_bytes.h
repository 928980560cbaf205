#pragma once
// Values as bytes for another process of this program on this machine, which takes them out in the same order.

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace pfdm {

class BytePacker {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T)); }
  void put(std::string_view text) {
    put(text.size());
    bytes_.append(text);
  }
  void put(const std::string& text) { put(std::string_view(text)); }
  /// Puts numbers, or fixed-size vectors of numbers.
  template <class T>
  void put(const std::vector<T>& values) {
    static_assert(!std::is_pointer_v<T>);
    put(values.size());
    if constexpr (is_plain<T>) {
      if (!values.empty()) bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    } else {
      for (const T& value : values) put(value);
    }
  }
  /// Puts pairs whose parts can be put.
  template <class Map>
  requires requires { typename Map::mapped_type; }
  void put(const Map& map) {
    put(map.size());
    for (const auto& [key, value] : map) {
      put(key);
      put(value);
    }
  }

  std::string&& take() { return std::move(bytes_); }

  /// Fixed-size matrices are their numbers, although their copy constructors are not trivial.
  template <class T>
  static constexpr bool is_plain = std::is_trivially_copyable_v<T> || requires {
    requires T::SizeAtCompileTime >
    0;
  };

 private:
  std::string bytes_;
};

/// `bytes` must live as long as this, and hold what a BytePacker was given.
class ByteUnpacker {
 public:
  explicit ByteUnpacker(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void take(T& value) { copy(&value, sizeof(T)); }
  void take(std::string& text) {
    text.resize(size());
    copy(text.data(), text.size());
  }
  template <class T>
  void take(std::vector<T>& values) {
    values.resize(size());
    if constexpr (BytePacker::is_plain<T>) {
      copy(values.data(), values.size() * sizeof(T));
    } else {
      for (T& value : values) take(value);
    }
  }
  template <class Map>
  requires requires { typename Map::mapped_type; }
  void take(Map& map) {
    map.clear();
    for (std::size_t n = size(); n > 0; --n) {
      typename Map::key_type key{};
      take(key);
      take(map[key]);
    }
  }

 private:
  std::size_t size() {
    std::size_t n = 0;
    take(n);
    return n;
  }
  void copy(void* to, std::size_t n) {
    if (n > 0) std::memcpy(to, rest_.data(), n);
    rest_.remove_prefix(n);
  }

  std::string_view rest_;
};

}  // namespace pfdm
