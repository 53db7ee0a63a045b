#include "cli/study/kept_memory.hpp"

#include <cstdlib>  // __GLIBC__

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace levitas::cli {

void KeepFreedMemory() noexcept {
#if defined(__GLIBC__)
  constexpr int kNever = 1 << 30;  // [bytes]
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  // Arenas of threads give back what is freed at their end; one for all does not.
  mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace levitas::cli
