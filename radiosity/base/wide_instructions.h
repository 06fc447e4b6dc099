#pragma once

namespace radiosity {

/// Whether the processor has AVX2 and FMA.
inline bool has_wide_instructions() {
#if defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
#else
  return false;
#endif
}

}  // namespace radiosity
