#pragma once
// The level of processors that this program was compiled for.

#include <string_view>

namespace pfdm {

/// As in "x86-64-v3", which has AVX2; what -march= allowed the compiler to use.
constexpr std::string_view instruction_set() {
#if defined(__AVX512BW__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
  return "x86-64-v4";
#elif defined(__AVX2__) && defined(__BMI__) && defined(__BMI2__) && defined(__LZCNT__) && defined(__MOVBE__) && \
    defined(__F16C__)
  return "x86-64-v3";
#elif defined(__AVX2__)
  return "x86-64-v2 with AVX2";
#elif defined(__SSE4_2__) && defined(__SSSE3__) && defined(__POPCNT__)
  return "x86-64-v2";
#elif defined(__x86_64__)
  return "x86-64";
#elif defined(__aarch64__)
  return "arm64";
#else
  return "other processors than x86-64 and arm64";
#endif
}

/// Whether this processor has what the compiler may have used.
inline bool processor_has_instruction_set() {
#if defined(__AVX512VL__)
  return __builtin_cpu_supports("avx512vl");
#elif defined(__AVX2__)
  return __builtin_cpu_supports("avx2");
#else
  return true;
#endif
}

}  // namespace pfdm
