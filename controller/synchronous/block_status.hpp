#pragma once
// What a block of synchronous control does in a cycle. Plain data.

#include <cstddef>
#include <cstdint>

namespace levitas::synchronous {

inline constexpr std::size_t kMaxBlocks = 8;

enum class BlockState : std::uint8_t {
  kOff = 0,
  kActing = 1,
  kFading = 2,
  kEnded = 3,  ///< until the speed leaves the window
};

enum class Ending : std::uint8_t {
  kNone = 0,
  kSpeed = 1,
  kAngleLost = 2,
  kAngleJumped = 3,
  kSaturated = 4,
  kOrbitGrew = 5,
  kCurrentTooLarge = 6,
  kNotLevitated = 7,
};

struct BlockStatus {
  BlockState state{BlockState::kOff};
  Ending ending{Ending::kNone};  ///< why it ended the last time
  double amplitude{};            ///< largest of an axis [m] or [A]
};

}  // namespace levitas::synchronous
