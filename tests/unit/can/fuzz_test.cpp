// Whatever the bus carries is refused or understood, never more. LEVITAS_FUZZ_FRAMES sets how many
// mutated frames are tried (run under the sanitizers, ten million take minutes).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "hil/can/assemblers.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::can {
namespace {

constexpr std::uint64_t kFuzzSeed = 20261121;

std::uint64_t Frames() {
  const char* wanted = std::getenv("LEVITAS_FUZZ_FRAMES");
  return wanted == nullptr ? 200'000 : std::strtoull(wanted, nullptr, 10);
}

/// Changes identifier, length, format or up to four bytes; keeps the checksum right in half of the
/// cases, so that what lies behind it is reached as well.
class Mutator {
 public:
  Mutator(const Layout& layout, std::uint64_t seed) : layout_(layout), random_(seed) {}

  WireFrame operator()() {
    const Message& message = layout_.messages[random_.Bits() % layout_.messages.size()];
    WireFrame wire;
    wire.id = message.id;
    wire.length = message.bytes;
    wire.fd = layout_.format == Format::kFd;
    for (auto& byte : wire.data) byte = static_cast<std::uint8_t>(random_.Bits());
    if (random_.Bits() % 2 == 0) {
      Protect(message.profile, message.data_id(), static_cast<std::uint8_t>(random_.Bits()),
              wire.payload());
    }
    const std::uint64_t kind = random_.Bits() % 16;
    if (kind == 0) wire.id = static_cast<std::uint32_t>(random_.Bits());
    if (kind == 1) wire.length = static_cast<std::uint8_t>(random_.Bits() % (kMaxPayload + 1));
    if (kind == 2) wire.fd = !wire.fd;
    if (kind >= 8 && kind < 12) {
      wire.data[random_.Bits() % wire.data.size()] ^= static_cast<std::uint8_t>(random_.Bits());
    }
    return wire;
  }

 private:
  const Layout& layout_;
  Random random_;
};

void ExpectPlausible(const SensorFrame& frame, std::size_t axes) {
  ASSERT_EQ(frame.axes, axes);
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    const double position_m = frame.position_m[axis];
    ASSERT_TRUE(std::isnan(position_m) || std::abs(position_m) <= 32767 * 1.0001e-8);
    ASSERT_TRUE(axis < axes || position_m == 0.0);
  }
  ASSERT_GE(frame.angle_rad, 0.0);
  ASSERT_LT(frame.angle_rad, 6.2832);
  ASSERT_EQ(frame.rig_status & ~15U, 0U);
}

void ExpectPlausible(const CurrentFrame& frame, std::size_t axes, std::uint64_t own) {
  ASSERT_EQ(frame.axes, axes);
  ASSERT_LE(frame.cycle, own);
  for (const double current_a : frame.control_current_a) {
    ASSERT_LE(std::abs(current_a), 32767 * 1.0001e-4);
  }
  ASSERT_GE(frame.bias_current_a, 0.0);
  ASSERT_TRUE(std::isfinite(frame.speed_set_point_rad_per_s));
}

/// Frames that were taken, whole or in part.
std::uint64_t Bombard(std::size_t axes, Format format, std::uint64_t frames) {
  const Layout layout = MakeLayout(TestRig(axes), format);
  Mutator mutate(layout, kFuzzSeed + axes);
  RigAssembler rig(layout);
  CommandAssembler commands(layout);
  for (std::uint64_t count = 0; count < frames; ++count) {
    const WireFrame wire = mutate();
    SensorFrame sensor;
    if (rig.Take(wire, sensor) == Outcome::kFrame) ExpectPlausible(sensor, axes);
    CurrentFrame current;
    const Outcome outcome = commands.Take(wire, count, current);
    if (outcome == Outcome::kFrame || outcome == Outcome::kGoodbye) {
      ExpectPlausible(current, axes, count);
    }
    if (testing::Test::HasFatalFailure()) return 0;
  }
  // Both ways are reached: much is refused, and what is whole is taken.
  EXPECT_GT(rig.outcomes()[Outcome::kDamaged], frames / 20);
  return rig.outcomes()[Outcome::kFrame] + rig.outcomes()[Outcome::kPart];
}

TEST(CanFuzz, MutatedFdFramesAreRefusedOrGiveNumbersWithinTheirRange) {
  EXPECT_GT(Bombard(4, Format::kFd, Frames() / 2), Frames() / 1000);
}
TEST(CanFuzz, MutatedClassicalFramesAreRefusedOrGiveNumbersWithinTheirRange) {
  EXPECT_GT(Bombard(4, Format::kClassical, Frames() / 4), Frames() / 1000);
}
TEST(CanFuzz, MutatedFramesOfEightAxesAreRefusedOrGiveNumbersWithinTheirRange) {
  EXPECT_GT(Bombard(8, Format::kFd, Frames() / 4), Frames() / 1000);
}

}  // namespace
}  // namespace levitas::can
