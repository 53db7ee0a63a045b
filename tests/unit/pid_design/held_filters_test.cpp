// The options of `amb design pid` that hold filters: what is taken, and what is refused by name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <string>
#include <vector>

#include "cli/study/design/pid_options.hpp"
#include "common/problem.hpp"

namespace levitas::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const configuration::RigFile& TenKilohertz() {
  static const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  return rig;
}

PidCommandOptions Parsed(const std::string& line) {
  PidCommandOptions options;
  CLI::App command;
  AddPidSearchOptions(command, options);
  command.parse(line);
  CompleteSearch(TenKilohertz(), options);
  return options;
}

std::string UsageRefusal(const std::string& line) {
  try {
    static_cast<void>(Parsed(line));
  } catch (const Problem& refused) {
    EXPECT_EQ(refused.status(), ExitStatus::kUsage) << line;
    return refused.what();
  }
  return "taken: " + line;
}

TEST(HeldFilters, AreTakenInTheirOrder) {
  const auto none = Parsed("").search;
  EXPECT_TRUE(none.lead_lags_at_hz.empty());
  EXPECT_TRUE(none.notches_at_hz.empty());
  const auto search = Parsed("--lead-lag-hz 510 --notch-hz 1210,730 --lead-lags 1").search;
  EXPECT_THAT(search.lead_lags_at_hz, ElementsAre(510.0));
  EXPECT_THAT(search.notches_at_hz, ElementsAre(1210.0, 730.0));
  EXPECT_TRUE(search.own_filters);
  EXPECT_FALSE(Parsed("--shared-filters").search.own_filters);
}

// From 20 Hz to 0.45 of 10 kHz, both included.
TEST(HeldFilters, ReachFromTheLowestToTheHighestCorner) {
  ASSERT_EQ(TenKilohertz().numbers.period_s(), 1e-4);
  for (const char* option : {"--lead-lag-hz", "--notch-hz"}) {
    for (const char* hz : {"20", "4500"}) {
      EXPECT_NO_THROW(static_cast<void>(Parsed(std::string(option) + " " + hz))) << option << hz;
    }
    for (const char* hz : {"19.9", "4501", "0", "-510", "nan", "inf", "-inf", "1e300"}) {
      const std::string refusal = UsageRefusal(std::string(option) + "=" + hz);
      EXPECT_THAT(refusal, HasSubstr(std::string(option) + ": found ")) << hz;
      EXPECT_THAT(refusal, HasSubstr("allowed 20 to 4500 Hz")) << hz;
    }
    // One that fits excuses none that does not.
    EXPECT_THAT(UsageRefusal(std::string(option) + " 510,nan --lead-lags 2"),
                HasSubstr("found nan"));
  }
}

TEST(HeldFilters, AreNoMoreThanThereAre) {
  EXPECT_THAT(UsageRefusal("--lead-lag-hz 510,700"),
              HasSubstr("--lead-lag-hz names 2 filters, but there are 1 (--lead-lags)"));
  EXPECT_THAT(UsageRefusal("--notch-hz 510,700,900"),
              HasSubstr("--notch-hz names 3 filters, but there are 2 (--notches)"));
  EXPECT_THAT(UsageRefusal("--notches 0 --notch-hz 510"), HasSubstr("but there are 0 (--notches)"));
  EXPECT_THAT(Parsed("--lead-lag-hz 510,700 --lead-lags 2").search.lead_lags_at_hz,
              ElementsAre(510.0, 700.0));
}

TEST(HeldFilters, AreNumbers) {
  EXPECT_THROW(static_cast<void>(Parsed("--notch-hz fast")), CLI::ParseError);
}

}  // namespace
}  // namespace levitas::cli
