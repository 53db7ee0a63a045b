#pragma once
// Four numbers in double precision side by side: one register of AVX2, two of every processor.
//
// Use     in functions that are compiled for both and chosen at start-up. Inlined always, so that
//         each takes the registers of its caller.
// Thread  plain data.

#include <cstddef>
#include <cstring>

// Inlined into a version for AVX2 and one for every processor.
#define LEVITAS_INLINE [[gnu::always_inline]] inline  // NOLINT: an attribute cannot be a constant

namespace levitas::diagnosis {

using Four [[gnu::vector_size(4 * sizeof(double))]] = double;

LEVITAS_INLINE void Load(const double* from, Four& to) noexcept {
  std::memcpy(&to, from, sizeof to);
}
LEVITAS_INLINE void Store(const Four& from, double* to) noexcept {
  std::memcpy(to, &from, sizeof from);
}

}  // namespace levitas::diagnosis
