// --partner-timeout as people type it; what it does with a partner that stays away is tested with
// processes (tests/process/pair).

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "programs/plant/plant_options.hpp"

namespace levitas::plant_run {
namespace {

constexpr PlantProgram kProgram{"amb-plant", "a rig", "a port", "lcm", 1000, ""};

/// 0 and the time, or the status of the refusal.
std::pair<int, double> Read(const std::string& time) {
  std::array<std::string, 5> words{"amb-plant", "--rig", "flexible_rotor", "--partner-timeout",
                                   time};
  std::array<char*, 5> argv{};
  for (std::size_t i = 0; i < words.size(); ++i) argv[i] = words[i].data();
  PlantOptions options;
  ExitStatus status = ExitStatus::kDone;
  const bool read =
      ReadCommandLine(static_cast<int>(argv.size()), argv.data(), kProgram, options, status);
  return {read ? 0 : static_cast<int>(status), options.partner_timeout_s};
}

TEST(PartnerTimeout, IsATimeThatFitsNanoseconds) {
  EXPECT_EQ(Read("3"), std::make_pair(0, 3.0));
  EXPECT_EQ(Read("0.5"), std::make_pair(0, 0.5));
  EXPECT_EQ(Read("1e8"), std::make_pair(0, 1e8));  // three years
}

// As nanoseconds they would be no number, and a program would give up at once.
TEST(PartnerTimeout, IsRefusedWhereItIsNoTime) {
  for (const char* time : {"nan", "inf", "1e300", "1e9", "0", "-1", "soon", "3s", ""}) {
    EXPECT_EQ(Read(time).first, static_cast<int>(ExitStatus::kUsage)) << time;
  }
}

}  // namespace
}  // namespace levitas::plant_run
