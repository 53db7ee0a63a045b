#pragma once
// What a fuzz target asserts: a broken sentence ends the process, which libFuzzer reports.

#include <cstdio>
#include <cstdlib>

namespace levitas::fuzz {

inline void Verify(bool holds, const char* sentence) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", sentence);
  std::abort();
}

}  // namespace levitas::fuzz
