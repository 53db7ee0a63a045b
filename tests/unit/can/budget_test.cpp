// Rates against figures of an independent calculation: at 80 % load a loop of four axes fits one FD
// bus up to 5.8 kHz (5 Mbit/s) or 7.2 kHz (8 Mbit/s), two buses up to 11.0 or 13.8 kHz, and
// classical CAN up to 1.5 kHz, each without slow messages.

#include "hil/can/budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "configuration/rig_file.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::can {
namespace {

using testing::HasSubstr;

constexpr double kPrintedRate_hz = 50.0;  // half of the last printed digit

std::vector<BusConfig> One(double data_rate, double limit = 0.8) {
  return {{"loop", "can0", {1e6, data_rate}, Carries::kEverything, limit}};
}
std::vector<BusConfig> Two(double data_rate) {
  return {{"positions", "can0", {1e6, data_rate}, Carries::kFromRig, 0.8},
          {"currents", "can1", {1e6, data_rate}, Carries::kToRig, 0.8}};
}

Layout FastOnly(Format format) {
  Layout layout = MakeLayout(TestRig(4), format);
  std::erase_if(layout.messages, [](const Message& message) { return message.every > 1; });
  return layout;
}

double HighestRate(const Layout& layout, const std::vector<BusConfig>& buses) {
  return MakeBudget(layout, buses).highest_rate_hz;
}

TEST(Budget, OfOneBusEndsAt5800HertzWith5And7200With8MegabitPerSecond) {
  const Layout layout = FastOnly(Format::kFd);
  EXPECT_NEAR(HighestRate(layout, One(5e6)), 5'800.0, kPrintedRate_hz);
  EXPECT_NEAR(HighestRate(layout, One(8e6)), 7'200.0, kPrintedRate_hz);
}

TEST(Budget, OfTwoBusesEndsAt11000HertzWith5And13800With8MegabitPerSecond) {
  const Layout layout = FastOnly(Format::kFd);
  EXPECT_NEAR(HighestRate(layout, Two(5e6)), 11'000.0, kPrintedRate_hz);
  EXPECT_NEAR(HighestRate(layout, Two(8e6)), 13'800.0, kPrintedRate_hz);
}

TEST(Budget, OfClassicalCanEndsAt1500Hertz) {
  EXPECT_NEAR(HighestRate(FastOnly(Format::kClassical), One(0.0)), 1'500.0, kPrintedRate_hz);
}

TEST(Budget, CountsSlowMessagesByTheirShare) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  const Budget budget = MakeBudget(layout, Two(5e6));
  // 72.6 % of positions; 64.6 % of currents and a sixteenth of 56.6 %.
  EXPECT_NEAR(budget.buses[0].load, 0.726, 1e-9);
  EXPECT_NEAR(budget.buses[1].load, 0.646 + 0.566 / 16.0, 1e-9);
  EXPECT_NEAR(budget.transport_s(), 137.2e-6, 1e-9);
  EXPECT_NEAR(budget.blocking_s, 56.6e-6, 1e-9);
}

TEST(Budget, FitsExactlyUpToTheRateItNames) {
  RigNumbers rig = TestRig(4);
  for (const double data_rate : {2e6, 5e6, 8e6}) {
    const double rate_hz = HighestRate(MakeLayout(rig, Format::kFd), One(data_rate));
    rig.period_ns = static_cast<std::int64_t>(1e9 / rate_hz) + 1;
    EXPECT_TRUE(MakeBudget(MakeLayout(rig, Format::kFd), One(data_rate)).fits());
    rig.period_ns -= 10;
    EXPECT_FALSE(MakeBudget(MakeLayout(rig, Format::kFd), One(data_rate)).fits());
  }
}

TEST(Budget, RefusesWithLoadLimitAndTheRateThatFits) {
  const Budget budget = MakeBudget(MakeLayout(TestRig(4), Format::kFd), One(5e6));
  EXPECT_FALSE(budget.fits());
  const std::string text = RefusalText(budget);
  EXPECT_THAT(text, HasSubstr("CAN bus loop (FD, 1 / 5 Mbit/s)"));
  EXPECT_THAT(text, HasSubstr("10000 Hz would load it to 140.7 %, allowed 80 %"));
  EXPECT_THAT(text, HasSubstr("at most 5684 Hz fits"));  // 0.8 / 140.74 us
  EXPECT_THAT(text, HasSubstr("carries: from_rig"));
}

TEST(Budget, SaysNothingAgainstBusesThatFit) {
  const Budget budget = MakeBudget(MakeLayout(TestRig(4), Format::kFd), Two(5e6));
  EXPECT_TRUE(budget.fits());
  EXPECT_EQ(RefusalText(budget), "");
  EXPECT_THAT(BudgetText(budget), HasSubstr("fits; at most 11019 Hz"));  // 0.8 / 72.6 us
}

TEST(Budget, OfTheShippedRigFitsAtItsRate) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  ASSERT_EQ(rig.buses.size(), 2U);
  const Layout layout = MakeLayout(rig.numbers, FormatOf(rig.buses));
  EXPECT_TRUE(MakeBudget(layout, rig.buses).fits());
}

TEST(BusKeys, RefuseADirectionThatNoBusOrSeveralCarry) {
  const configuration::RigFile shipped =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  for (const auto& [first, second] : {std::pair{Carries::kFromRig, Carries::kFromRig},
                                      std::pair{Carries::kEverything, Carries::kToRig}}) {
    configuration::RigFile rig = shipped;
    rig.buses[0].carries = first;
    rig.buses[1].carries = second;
    EXPECT_THROW(
        static_cast<void>(configuration::ParseRig(configuration::WriteRig(rig), "rig.yaml")),
        std::runtime_error);
  }
}

TEST(BusKeys, SurviveBeingWrittenAndReadAgain) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const configuration::RigFile again =
      configuration::ParseRig(configuration::WriteRig(rig), "rig.yaml");
  ASSERT_EQ(again.buses.size(), rig.buses.size());
  for (std::size_t at = 0; at < rig.buses.size(); ++at) {
    EXPECT_EQ(again.buses[at].name, rig.buses[at].name);
    EXPECT_EQ(again.buses[at].interface, rig.buses[at].interface);
    EXPECT_EQ(again.buses[at].rates.data_bit_per_s, rig.buses[at].rates.data_bit_per_s);
    EXPECT_EQ(again.buses[at].carries, rig.buses[at].carries);
    EXPECT_EQ(again.buses[at].load_limit, rig.buses[at].load_limit);
  }
}

}  // namespace
}  // namespace levitas::can
