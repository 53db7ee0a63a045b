#pragma once
// Counts every allocation of the calling thread while it lives. Link `allocation_guard`, which
// replaces operator new; memory got from malloc by C code is not seen.
//
//   AllocationGuard guard;
//   for (int i = 0; i < 10'000; ++i) Cycle();
//   EXPECT_EQ(guard.count(), 0U);

#include <cstdint>

namespace levitas::test {

class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  [[nodiscard]] std::uint64_t count() const noexcept;  ///< since construction, this thread

 private:
  std::uint64_t start_;
};

}  // namespace levitas::test
