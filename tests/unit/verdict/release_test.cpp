// A run that let go of a turning rotor is never accepted, and says so.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/verdict/synthetic_session.hpp"
#include "verdict/report.hpp"

namespace levitas::verdict {
namespace {

using testing::HasSubstr;

constexpr double kTurns = RpmToRadPerS(2663.0);

void Held(cycle::CycleRecord& record) { record.out.current.amplifiers_enabled = true; }

/// Levitated at speed, landed on one wrong frame, and then off at `speed_after_rad_per_s`.
SessionFigures LandedAt(double speed_after_rad_per_s, double last_held_rad_per_s) {
  SyntheticSession session;
  session.Append(Mode::kSpinning, 10'000, {.radius_m = 4e-6, .speed_rad_per_s = kTurns}, Held);
  session.Append(Mode::kLanding, 5'000, {.radius_m = 4e-6, .speed_rad_per_s = last_held_rad_per_s},
                 Held);
  session.Append(Mode::kOff, 5'000, {.speed_rad_per_s = speed_after_rad_per_s});
  return session.Figures(TwoBearingRig());
}

Verdict Judged(const SessionFigures& figures) {
  Inputs inputs;
  inputs.rig = TwoBearingRig();
  inputs.session = figures;
  return Judge(std::move(inputs));
}

TEST(ReleaseAtSpeed, IsNeverAcceptedThoughEveryOrbitIsSmall) {
  const Verdict verdict = Judged(LandedAt(kTurns, kTurns));
  EXPECT_EQ(verdict.outcome, Outcome::kNotAccepted);
  EXPECT_THAT(verdict.sentence,
              HasSubstr("the amplifiers went off while the rotor turned at 2663 rpm, 1.500 s"));
  EXPECT_EQ(Json(verdict)["released_at_speed"]["time_s"], 1.5);
  EXPECT_NEAR(Json(verdict)["released_at_speed"]["speed_rpm"].get<double>(), 2663.0, 1e-6);
}

TEST(ReleaseAtSpeed, TheSameRunWithARotorThatStandsIsAccepted) {
  const Verdict verdict = Judged(LandedAt(0.0, 0.0));
  EXPECT_EQ(verdict.outcome, Outcome::kAccepted);
  EXPECT_TRUE(Json(verdict)["released_at_speed"].is_null());
}

TEST(ReleaseAtSpeed, IsSeenWhenOnlyTheFrameOfTheReleaseReadsZero) {
  SyntheticSession session;
  session.Append(Mode::kSpinning, 10'000, {.radius_m = 4e-6, .speed_rad_per_s = kTurns}, Held);
  session.Append(Mode::kOff, 1, {.speed_rad_per_s = 0.0});
  session.Append(Mode::kOff, 5'000, {.speed_rad_per_s = kTurns});
  EXPECT_EQ(Judged(session.Figures(TwoBearingRig())).outcome, Outcome::kNotAccepted);
}

TEST(ReleaseAtSpeed, OneWrongFrameOfARotorThatStandsIsNone) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 10'000, {.radius_m = 4e-6}, Held);
  session.Append(Mode::kOff, 1, {.speed_rad_per_s = 1e4});
  session.Append(Mode::kOff, 5'000, {});
  EXPECT_EQ(Judged(session.Figures(TwoBearingRig())).outcome, Outcome::kAccepted);
}

TEST(ReleaseAtSpeed, IsSaidOfATrippedAndOfAnIncompleteRunAsWell) {
  SessionFigures figures = LandedAt(kTurns, kTurns);
  Inputs incomplete;
  incomplete.rig = TwoBearingRig();
  incomplete.session = figures;
  incomplete.incomplete_reason = "ended at once on request";
  const Verdict broken_off = Judge(std::move(incomplete));
  EXPECT_EQ(broken_off.outcome, Outcome::kIncomplete);
  EXPECT_THAT(broken_off.sentence, HasSubstr("while the rotor turned at 2663 rpm"));
  figures.trip = TripFigures{Fault::kSensorFrozen, 0, 6.0, 6.0, 1.5, Mode::kSpinning, kTurns};
  const Verdict tripped = Judged(figures);
  EXPECT_EQ(tripped.outcome, Outcome::kTripped);
  EXPECT_THAT(tripped.sentence, HasSubstr("while the rotor turned at 2663 rpm"));
}

}  // namespace
}  // namespace levitas::verdict
