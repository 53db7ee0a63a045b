// A record is cut where the excitation says, and refused with one sentence where it cannot be.
#include "identification/frf/experiments.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "identification/frf/checks.hpp"
#include "tests/unit/identification/frf/linear_loop.hpp"

namespace levitas::identification {
namespace {

using test::LinearLoop;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t kPeriod = 100;
constexpr std::size_t kPause = 2000;  // 0.2 s: the longest pause within a piece

/// Rows begin .. begin + length of an axis repeat a pattern of `period` samples.
void Excite(session::Recording& record, std::size_t axis, std::size_t begin, std::size_t length,
            std::size_t period = kPeriod, std::uint64_t seed = 3) {
  Random random(seed);
  std::vector<double> pattern(period);
  for (double& value : pattern) value = random.Uniform() < 0.5 ? -0.1 : 0.1;
  for (std::size_t n = 0; n < length; ++n)
    record.excitation_a[axis][begin + n] = pattern[n % period];
}

/// Sines held one after the other, `dwell` samples each.
void Sweep(session::Recording& record, std::size_t axis, std::size_t begin, std::size_t dwell,
           const std::vector<double>& cycles_per_sample, double amplitude_a = 0.1) {
  std::size_t row = begin;
  for (const double f : cycles_per_sample) {
    for (std::size_t n = 0; n < dwell; ++n, ++row) {
      record.excitation_a[axis][row] =
          amplitude_a * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) + 0.3);
    }
  }
}

/// Both axes excited, x in rows 50 .. 449, y in rows 500 .. 899.
session::Recording TwoAxes(double speed_rad_per_s = 0.0) {
  session::Recording record = LinearLoop::Empty(1000, speed_rad_per_s);
  Excite(record, 0, 50, 4 * kPeriod);
  Excite(record, 1, 500, 4 * kPeriod);
  return record;
}

std::string Refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

std::string Refusal(const session::Recording& record) {
  return Refusal([&] { (void)GroupBySpeed(record, FindExperiments(record)); });
}

TEST(FindExperiments, CutsWholePeriodsAfterTheTransientAndLeavesOutTheRest) {
  session::Recording record = LinearLoop::Empty(1000, 0.0);
  Excite(record, 0, 50, 3 * kPeriod + 37);
  // The signal stops within a period and another axis follows at once: 37 rows stay out.
  Excite(record, 1, 50 + 3 * kPeriod + 37, 3 * kPeriod);
  const auto found = FindExperiments(record);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].axis, 0U);
  EXPECT_EQ(found[0].begin, 50 + kPeriod);
  EXPECT_EQ(found[0].period_samples, kPeriod);
  EXPECT_EQ(found[0].periods, 2U);
  EXPECT_EQ(found[0].end(), 50 + 3 * kPeriod);
  EXPECT_EQ(found[1].axis, 1U);
  EXPECT_EQ(found[1].begin, 50 + 3 * kPeriod + 37 + kPeriod);
}

// Its last period is not silent, as that of an impulse train is, so nothing after it belongs to it.
TEST(FindExperiments, ASignalThatIsEndedWithinAPeriodGivesTheWholeOnes) {
  session::Recording record = TwoAxes();
  Excite(record, 1, 500, 4 * kPeriod + 7);
  const std::vector<Experiment> whole = FindExperiments(TwoAxes(), {});
  EXPECT_EQ(FindExperiments(record, {}).back().periods, whole.back().periods);
  record.levitated[950] = 0;  // landed since
  EXPECT_EQ(FindExperiments(record, {}).back().periods, whole.back().periods);
}

TEST(FindExperiments, DropsAsManyPeriodsAsAsked) {
  const session::Recording record = TwoAxes();
  const auto found = FindExperiments(record, {.dropped_periods = 2});
  EXPECT_EQ(found[0].begin, 50 + 2 * kPeriod);
  EXPECT_EQ(found[0].periods, 2U);
  const std::string text =
      Refusal([&] { (void)FindExperiments(record, {.dropped_periods = 2, .needed_periods = 3}); });
  EXPECT_THAT(text, HasSubstr("4 whole periods of 100 samples, needed are 5: 2 for the transient "
                              "and 3 to average"));
}

TEST(FindExperiments, StrokesThatAreAlikeAndEvenlySpacedAreOneTrainHoweverLongThePauses) {
  constexpr std::size_t kSpacing = 3 * kPause;
  session::Recording record = LinearLoop::Empty(5 * kSpacing, 0.0);
  for (std::size_t stroke = 0; stroke < 4; ++stroke) {
    Excite(record, 0, 10 + stroke * kSpacing, 20, 20);
  }
  const auto found = FindExperiments(record);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].period_samples, kSpacing);
  // The last stroke's period goes on, as nothing else begins: four periods, the first dropped.
  EXPECT_EQ(found[0].periods, 3U);
  // A stroke of another height, or one that comes late, ends the train.
  session::Recording uneven = record;
  for (std::size_t n = 0; n < 20; ++n) uneven.excitation_a[0][10 + 3 * kSpacing + n] *= 1.01;
  EXPECT_THAT(Refusal(uneven), HasSubstr("does not repeat itself"));
}

TEST(FindExperiments, HeldSinesGiveWholePeriodsOfTheirSettledHalf) {
  session::Recording record = LinearLoop::Empty(4000, 0.0);
  const std::vector<double> f{0.0101, 0.0203, 0.0407};
  Sweep(record, 0, 100, 1000, f);
  const auto found = FindExperiments(record);
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].sines.size(), 3U);
  EXPECT_EQ(found[0].period_samples, 0U);
  EXPECT_EQ(found[0].periods, 5U);  // (500 - 1) x 0.0101 = 5.04 periods of the slowest
  for (std::size_t k = 0; k < 3; ++k) {
    const HeldSine& sine = found[0].sines[k];
    EXPECT_NEAR(sine.cycles_per_sample, f[k], 1e-9);  // a sine without noise
    const double periods = static_cast<double>(sine.end - sine.begin) * f[k];
    // A whole number of them but for the rounding to samples.
    EXPECT_NEAR(periods, std::round(periods), 0.5 * f[k] + 1e-9);
    EXPECT_GE(sine.begin, 100 + 1000 * k + 500);
    EXPECT_LE(sine.end, 100 + 1000 * (k + 1));
  }
}

TEST(FindExperiments, ASweepThatBeginsAgainIsASecondExperimentAndOneThatBreaksOffIsNone) {
  session::Recording record = LinearLoop::Empty(6000, 0.0);
  Sweep(record, 0, 0, 1000, {0.0101, 0.0203, 0.0101, 0.0203, 0.0101});
  const auto found = FindExperiments(record);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].sines.size(), 2U);
  EXPECT_EQ(found[1].sines.size(), 2U);
  EXPECT_GE(found[1].sines[0].begin, 2500U);
}

TEST(FindExperiments, AHeldSineThatIsTooShortIsNamedWithItsFrequency) {
  session::Recording record = LinearLoop::Empty(3000, 0.0);
  Sweep(record, 0, 0, 1000, {0.003, 0.0203});  // (500 - 1) x 0.003 = 1.5 periods
  EXPECT_THAT(Refusal(record),
              AllOf(HasSubstr("excitation of x"), HasSubstr("30.00 Hz is held for 1 whole periods"),
                    HasSubstr("hold it longer (dwell_s)")));
}

struct Defect {
  const char* name;
  void (*spoil)(session::Recording&);
  std::vector<const char*> says;
};

class Refused : public testing::TestWithParam<Defect> {};

TEST_P(Refused, InOneSentenceWithTheRecordTheChannelAndTheRemedy) {
  session::Recording record = TwoAxes();
  ASSERT_EQ(Refusal(record), "accepted");
  GetParam().spoil(record);
  const std::string text = Refusal(record);
  EXPECT_THAT(text, testing::StartsWith("loop.csv: "));
  for (const char* part : GetParam().says) EXPECT_THAT(text, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    Defects, Refused,
    testing::Values(
        Defect{"Landed",
               [](session::Recording& r) { r.levitated[300] = 0; },
               {"excitation of x from 0.0050 s", "not levitated throughout"}},
        Defect{
            "ShortOnOneAxis",
            [](session::Recording& r) { std::fill_n(r.excitation_a[1].begin() + 679, 221, 0.0); },
            {"excitation of y from 0.0500 s", "does not repeat itself", "raise orbit_limit_um"}},
        Defect{"Together",
               [](session::Recording& r) { r.excitation_a[1][120] = 0.1; },
               {"excites x and y together", "excite one axis after the other"}},
        Defect{"Quiet",
               [](session::Recording& r) {
                 for (auto& column : r.excitation_a) column.clear();
               },
               {"no excitation in the record", "--scenario identify", "excitation_<channel>_a"}},
        Defect{"OneAxisOnly",
               [](session::Recording& r) { r.excitation_a[0].clear(); },
               {"x not excited at 0 rpm", "a rig with 2 axes needs an experiment on each"}},
        Defect{"Accelerates",
               [](session::Recording& r) {
                 for (std::size_t n = 0; n < r.rows(); ++n) {
                   r.speed_rad_per_s[n] = RpmToRadPerS(3000.0) + 0.1 * static_cast<double>(n);
                 }
               },
               {"excitation of x", "the speed changes from"}},
        Defect{"GapOfSevenRows",
               [](session::Recording& r) {
                 for (std::size_t n = 200; n < r.rows(); ++n) r.cycle[n] += 7;
               },
               {"7 samples are missing at 0.0207 s", "record it again"}}),
    [](const auto& p) { return p.param.name; });

TEST(FindExperiments, AFrameThatDidNotArriveIsNamedWithItsTime) {
  // The count of the sensor frame stays while none arrives, and such a row is not levitated.
  session::Recording record = TwoAxes();
  for (std::size_t n = 300; n < record.rows(); ++n) record.cycle[n] -= 1;
  record.levitated[300] = 0;
  EXPECT_THAT(Refusal(record),
              AllOf(HasSubstr("excitation of x"), HasSubstr("no frame arrived after 0.0299 s"),
                    HasSubstr("record it again")));
}

TEST(FindExperiments, AGapAfterTheLastWholePeriodDoesNotMatter) {
  session::Recording record = TwoAxes();
  for (std::size_t n = 470; n < record.rows(); ++n) record.cycle[n] += 7;
  EXPECT_EQ(Refusal(record), "accepted");
}

TEST(GroupBySpeed, OrdersCampaignsByAscendingSpeedWhateverTheOrderOfTheRecord) {
  session::Recording record = LinearLoop::Empty(4000, 0.0);
  const std::vector<double> rpm{6000.0, 0.0, 3000.0};
  for (std::size_t k = 0; k < rpm.size(); ++k) {
    std::fill_n(record.speed_rad_per_s.begin() + static_cast<std::ptrdiff_t>(1000 * k), 1000,
                RpmToRadPerS(rpm[k]));
    Excite(record, 0, 1000 * k + 50, 4 * kPeriod);
    Excite(record, 1, 1000 * k + 500, 4 * kPeriod);
  }
  const auto campaigns = GroupBySpeed(record, FindExperiments(record));
  ASSERT_EQ(campaigns.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(campaigns[k].speed_rad_per_s, RpmToRadPerS(3000.0 * static_cast<double>(k)), 1e-9);
    ASSERT_EQ(campaigns[k].experiments.size(), 2U);
    EXPECT_EQ(campaigns[k].experiments[0].axis, 0U);
  }
}

TEST(GroupBySpeed, SpeedsWithinAPerCentAreOneCampaignAndThoseBeyondAreTwo) {
  for (const auto& [second_rpm, campaigns] :
       {std::pair{3025.0, std::size_t{1}}, std::pair{3040.0, std::size_t{2}}}) {
    session::Recording record = TwoAxes(RpmToRadPerS(3000.0));
    std::vector<Experiment> experiments = FindExperiments(record);
    const std::size_t once = experiments.size();
    for (std::size_t k = 0; k < once; ++k) {
      experiments.push_back(experiments[k]);
      experiments.back().speed_rad_per_s = RpmToRadPerS(second_rpm);
    }
    EXPECT_EQ(GroupBySpeed(record, experiments).size(), campaigns) << second_rpm;
  }
}

TEST(GroupBySpeed, SinesThatAreNotThoseOfTheOtherAxisAreRefusedWithBothNumbers) {
  session::Recording record = LinearLoop::Empty(6000, 0.0);
  Sweep(record, 0, 0, 1000, {0.0101, 0.0203, 0.0407});
  Sweep(record, 1, 3000, 1000, {0.0101, 0.0203});
  EXPECT_THAT(Refusal(record),
              AllOf(HasSubstr("the sines of x (3 frequencies)"), HasSubstr("not those of y (2)"),
                    HasSubstr("use one signal for all axes")));
}

/// One experiment over all 1000 rows of axis x; readings are distinct and small.
std::vector<Experiment> Whole(session::Recording& record) {
  Random random(9);
  for (auto& column : record.position_m) {
    for (double& value : column) value = 0.1 * random.Normal();
  }
  return {Experiment{0, SummingPoint::kCurrent, 0, 250, 4, 0.0, {}}};
}

TEST(RefuseBadSignals, ClippedReadingsAreCountedAtBothEndsOfTheRangeFromOneInAThousandOn) {
  session::Recording record = LinearLoop::Empty(1000, 0.0);
  const auto experiments = Whole(record);
  record.position_m[1][100] = -record.sensor_range_m[1];
  EXPECT_EQ(Refusal([&] { RefuseBadSignals(record, experiments); }), "accepted");
  record.position_m[1][700] = record.sensor_range_m[1];  // two in a thousand
  EXPECT_THAT(Refusal([&] { RefuseBadSignals(record, experiments); }),
              AllOf(HasSubstr("position y is clipped"), HasSubstr("0.2 % of the samples"),
                    HasSubstr("allowed 0.1 %"), HasSubstr("use a smaller amplitude")));
}

TEST(RefuseBadSignals, AllDefectsAreListedAtOnceEachChannelInALineOfItsOwn) {
  session::Recording record = LinearLoop::Empty(1000, 0.0);
  const auto experiments = Whole(record);
  record.position_m[0].assign(1000, 1e-6);
  record.current_a[1].assign(1000, -record.current_limit_a);
  const std::string text = Refusal([&] { RefuseBadSignals(record, experiments); });
  EXPECT_THAT(text, AllOf(HasSubstr("loop.csv: not usable for identification"),
                          HasSubstr("\n  position x is dead (1 different values)"),
                          HasSubstr("\n  control current y is at its limit (10 A) in 100.0 %")));
}

}  // namespace
}  // namespace levitas::identification
