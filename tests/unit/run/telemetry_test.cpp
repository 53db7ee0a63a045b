#include "cli/run/telemetry.hpp"

#include <gtest/gtest.h>

#include <levitas_msg/controller_state_t.hpp>

#include "transport/lcm_packet.hpp"

namespace levitas::cli {
namespace {

constexpr std::size_t kAxes = 4;

std::vector<std::uint8_t> Datagram() {
  levitas_msg::controller_state_t state{};
  state.cycle = 7;
  state.mode = static_cast<std::int8_t>(Mode::kSpinning);
  state.axes = kAxes;
  state.position_m = state.reference_m = state.control_current_a = {1e-6, 0.0, 0.0, 0.0};
  const std::size_t header = transport::HeaderSize(transport::channel::kState);
  std::vector<std::uint8_t> datagram(header + static_cast<std::size_t>(state.getEncodedSize()));
  transport::WriteHeader(datagram, 0, transport::channel::kState);
  state.encode(datagram.data(), static_cast<int>(header), state.getEncodedSize());
  return datagram;
}

TEST(Telemetry, ReadsTheStateOfTheController) {
  const auto sample = StateIn(Datagram());
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->cycle, 7U);
  EXPECT_EQ(sample->mode, Mode::kSpinning);
  EXPECT_EQ(sample->position_m.size(), kAxes);
}

// LCM's own decoder throws at -1 axes and reads far beyond the datagram at 2^31 - 1.
TEST(Telemetry, RefusesAStateWhoseNumberOfAxesLies) {
  const std::size_t axes_at = transport::HeaderSize(transport::channel::kState) + 8 + 8 + 8 + 3;
  for (const std::uint32_t lie : {0U, 3U, 5U, 9U, 0x7fffffffU, 0x80000000U, 0xffffffffU}) {
    std::vector<std::uint8_t> datagram = Datagram();
    for (std::size_t i = 0; i < 4; ++i) {
      datagram[axes_at + i] = static_cast<std::uint8_t>(lie >> (8U * (3U - i)));
    }
    EXPECT_FALSE(StateIn(datagram)) << lie;
  }
}

TEST(Telemetry, RefusesAStateThatIsCutOff) {
  const std::vector<std::uint8_t> datagram = Datagram();
  for (std::size_t size = 0; size < datagram.size(); ++size) {
    EXPECT_FALSE(StateIn(std::span(datagram).first(size))) << size;
  }
}

}  // namespace
}  // namespace levitas::cli
