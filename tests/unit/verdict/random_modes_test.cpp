// Phase splitting and the sums of a session over random sequences of modes, against the definition
// applied to the whole list at once.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/random.hpp"
#include "tests/unit/verdict/synthetic_session.hpp"

namespace levitas::verdict {
namespace {

struct Cycle {
  std::uint64_t number;
  Mode mode;
  double speed_rad_per_s;
};

std::vector<Cycle> DrawRun(Random& draw, std::size_t spans) {
  std::vector<Cycle> run;
  std::uint64_t number = draw.Bits() % 100'000;
  for (std::size_t span = 0; span < spans; ++span) {
    const auto mode = static_cast<Mode>(draw.Bits() % kModeCount);
    const std::size_t length = 1 + draw.Bits() % 60;
    double speed_rad_per_s = 4.0 * draw.Uniform() - 2.0;
    for (std::size_t i = 0; i < length; ++i) {
      speed_rad_per_s += 0.2 * draw.Normal();
      run.push_back({number, mode, speed_rad_per_s});
      number += draw.Bits() % 30 == 0 ? 1 + draw.Bits() % 20 : 1;  // records may be lost
    }
  }
  return run;
}

bool Levitated(Mode mode) {
  return mode == Mode::kLevitating || mode == Mode::kSpinning || mode == Mode::kCoastDown;
}

/// The definition, looking back from each cycle to where its levitation began.
Phase PhaseOf(const std::vector<Cycle>& run, std::size_t at, std::uint64_t settle_cycles) {
  if (!Levitated(run[at].mode)) return Phase::kNotJudged;
  std::size_t begin = at;
  while (begin > 0 && Levitated(run[begin - 1].mode)) --begin;
  if (run[at].number - run[begin].number < settle_cycles) return Phase::kNotJudged;
  return std::abs(run[at].speed_rad_per_s) <= 1.0 ? Phase::kStanding : Phase::kSpinning;
}

TEST(PhaseSplitter, AgreesWithTheDefinitionOverRandomModes) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random draw{seed};
    const std::vector<Cycle> run = DrawRun(draw, 60);
    const std::uint64_t settle_cycles = draw.Bits() % 80;
    PhaseSplitter split(1.0, settle_cycles);
    for (std::size_t i = 0; i < run.size(); ++i) {
      ASSERT_EQ(split.Next(run[i].number, run[i].mode, run[i].speed_rad_per_s),
                PhaseOf(run, i, settle_cycles))
          << "seed " << seed << ", record " << i;
    }
  }
}

TEST(SessionStatistics, SumsOfRandomRunsAgreeWithTheDefinition) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random draw{seed};
    const std::vector<Cycle> run = DrawRun(draw, 40);
    const RigNumbers rig = TwoBearingRig();
    constexpr std::uint64_t kSettleCycles = 20;
    SessionStatistics statistics(rig, 1.0, static_cast<double>(kSettleCycles) * rig.period_s());
    std::uint64_t standing = 0;
    std::uint64_t spinning = 0;
    double worst_standing_m = 0.0;
    double top_rad_per_s = 0.0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      cycle::CycleRecord record;
      record.in.cycle = run[i].number;
      record.in.frame_present = true;
      record.in.frame.axes = 4;
      record.in.frame.speed_rad_per_s = run[i].speed_rad_per_s;
      for (std::size_t axis = 0; axis < 4; ++axis) {
        record.in.frame.position_m[axis] = 1e-5 * draw.Normal();
      }
      record.out.mode = run[i].mode;
      statistics.Add(record);
      const Phase phase = PhaseOf(run, i, kSettleCycles);
      standing += phase == Phase::kStanding ? 1 : 0;
      spinning += phase == Phase::kSpinning ? 1 : 0;
      if (phase == Phase::kStanding) {
        const AxisArray& at = record.in.frame.position_m;
        worst_standing_m = std::max(worst_standing_m, std::hypot(at[2], at[3]));
      }
      top_rad_per_s = std::max(top_rad_per_s, std::abs(run[i].speed_rad_per_s));
    }
    const SessionFigures figures = statistics.Figures();
    ASSERT_EQ(figures.cycles, run.size()) << seed;
    EXPECT_EQ(figures.standing.cycles, standing) << seed;
    EXPECT_EQ(figures.spinning.cycles, spinning) << seed;
    EXPECT_EQ(figures.standing.bearings[1].orbit.max_m, worst_standing_m) << seed;
    EXPECT_EQ(figures.top_speed_rad_per_s, top_rad_per_s) << seed;
    const std::uint64_t span = run.back().number - run.front().number + 1;
    EXPECT_EQ(figures.missing_records, span - run.size()) << seed;
    EXPECT_NEAR(figures.duration_s, static_cast<double>(span) * rig.period_s(), 1e-12);
    std::uint64_t binned = 0;
    for (const ProfileBin& bin : figures.profile) binned += bin.cycles;
    EXPECT_EQ(binned, spinning) << "a spinning cycle is in exactly one bin of speed";
    double in_modes_s = 0.0;
    for (const ModeSpan& mode : figures.modes) in_modes_s += mode.duration_s;
    // Lost records between two modes belong to none of them.
    EXPECT_LE(in_modes_s, figures.duration_s + 1e-12) << seed;
    for (std::size_t i = 1; i < figures.modes.size(); ++i) {
      EXPECT_NE(figures.modes[i].mode, figures.modes[i - 1].mode) << seed;
    }
  }
}

// A damaged reading of the speed must neither fill the memory with bins nor lose the cycle.
TEST(SessionStatistics, ASpeedThatIsNoNumberOrImpossibleHasNoBinOfItsProfile) {
  for (const double speed_rad_per_s :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), 1e300, 1e9}) {
    SyntheticSession session;
    session.Append(Mode::kSpinning, 10, {.radius_m = 5e-6, .speed_rad_per_s = 300.0});
    session.Append(Mode::kSpinning, 1, {.radius_m = 5e-6, .speed_rad_per_s = speed_rad_per_s});
    const SessionFigures figures = session.Figures(TwoBearingRig());
    EXPECT_EQ(figures.spinning.cycles, 11U);
    ASSERT_EQ(figures.profile.size(), 1U) << speed_rad_per_s;
    EXPECT_EQ(figures.profile[0].cycles, 10U);
  }
}

}  // namespace
}  // namespace levitas::verdict
