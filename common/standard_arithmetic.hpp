#pragma once
// The arithmetic that sessions are recorded and replayed in: IEEE 754 round to nearest, subnormal
// numbers kept, no traps. Set for the calling thread.
//
// Why      replay compares bits. A library that was compiled for speed alone (-ffast-math) sets the
//          processor to take subnormal numbers for zero when it is loaded; the same inputs would
//          then give other bits than on a machine without that library.
// Decision subnormal numbers are not flushed to zero. A filter's memory decays to them where its
//          input is exactly zero, and they cost a law of four axes nothing that can be measured and
//          the largest state-space law a fraction of a microsecond (docs/timing.md).
// Stays    set: what the thread computed in before is not restored.
// Failure  std::terminate where the processor refuses its default state, which none does.

#include <cfenv>
#include <exception>

namespace levitas {

inline void UseStandardArithmetic() noexcept {
  if (std::fesetenv(FE_DFL_ENV) != 0) std::terminate();
}

}  // namespace levitas
