// A verdict says up to which speed it was shown: what was not levitated there is not claimed.

#include "verdict/speed_range.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "common/rotational_speed.hpp"
#include "tests/unit/verdict/synthetic_session.hpp"
#include "verdict/report.hpp"

namespace levitas::verdict {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

RigNumbers RatedRig(double rated_rpm) {
  RigNumbers rig = TwoBearingRig();
  rig.max_speed_rad_per_s = RpmToRadPerS(rated_rpm);
  return rig;
}

SyntheticSession SpunTo(double rpm, Mode mode = Mode::kSpinning) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 400, {.radius_m = 4e-6});
  if (rpm > 0.0) {
    session.Append(mode, 400, {.radius_m = 4e-6, .speed_rad_per_s = RpmToRadPerS(rpm)});
  }
  return session;
}

Verdict Judged(const SyntheticSession& session, double rated_rpm) {
  Inputs inputs;
  inputs.rig = RatedRig(rated_rpm);
  inputs.session = session.Figures(inputs.rig);
  return Judge(inputs);
}

struct Said {
  double shown_rpm;
  double rated_rpm;
  const char* beginning;
};

TEST(SpeedRange, IsPartOfTheSentenceUnlessTheRigDoesNotTurn) {
  // Standstill is 1 rad/s, 9.5 rpm: a rig rated for 1 rpm does not turn.
  for (const Said& said :
       {Said{3000.0, 15'000.0, "ACCEPTED up to 3000 of 15000 rpm: orbit"},
        Said{14'800.0, 15'000.0, "ACCEPTED up to 14800 of 15000 rpm: orbit"},
        Said{14'900.0, 15'000.0, "ACCEPTED up to the rated 15000 rpm: orbit"},
        Said{0.0, 15'000.0, "ACCEPTED standing, 0 of 15000 rpm: orbit"},
        Said{3000.0, 0.0, "ACCEPTED up to 3000 rpm: orbit"}, Said{0.0, 1.0, "ACCEPTED: orbit"}}) {
    const Verdict verdict = Judged(SpunTo(said.shown_rpm), said.rated_rpm);
    EXPECT_THAT(verdict.sentence, StartsWith(said.beginning));
    EXPECT_NEAR(RadPerSToRpm(verdict.range.shown_rad_per_s), said.shown_rpm, 1e-9);
  }
}

TEST(SpeedRange, StandsInTableAndJson) {
  const Verdict verdict = Judged(SpunTo(3000.0), 15'000.0);
  EXPECT_THAT(Table(verdict), HasSubstr("\nspeed     levitated up to 3000 of 15000 rpm, 20 %"));
  const auto json = Json(verdict);
  EXPECT_NEAR(json["speed_range"]["shown_rpm"].get<double>(), 3000.0, 1e-9);
  EXPECT_NEAR(json["speed_range"]["rated_rpm"].get<double>(), 15'000.0, 1e-9);
  EXPECT_NEAR(json["speed_range"]["shown_share"].get<double>(), 0.2, 1e-12);
  EXPECT_FALSE(json["speed_range"]["whole"].get<bool>());
  EXPECT_TRUE(json.contains("top_speed_rpm"));
  EXPECT_THAT(Table(Judged(SpunTo(0.0), 1.0)), Not(HasSubstr("\nspeed ")));
}

// The same motion counts while the law holds the rotor and does not while it runs down unheld.
TEST(SpeedRange, CountsOnlyWhatWasLevitated) {
  for (const Mode mode : {Mode::kSpinning, Mode::kCoastDown, Mode::kTripped, Mode::kLanding}) {
    const SessionFigures figures = SpunTo(3000.0, mode).Figures(RatedRig(6000.0));
    const double shown_rpm = RadPerSToRpm(figures.levitated_speed_rad_per_s);
    EXPECT_NEAR(shown_rpm, IsLevitated(mode) ? 3000.0 : 0.0, 1e-9) << Name(mode);
    EXPECT_NEAR(RadPerSToRpm(figures.top_speed_rad_per_s), 3000.0, 1e-9) << Name(mode);
  }
}

TEST(SpeedRange, IsNotStretchedByASingleWrongFrame) {
  for (const std::size_t wrong_frames : {1U, 2U}) {
    SyntheticSession session = SpunTo(3000.0);
    for (std::size_t i = 0; i < wrong_frames; ++i) {
      session.records()[500U + i].in.frame.speed_rad_per_s = RpmToRadPerS(5000.0);
    }
    session.records()[600].in.frame.speed_rad_per_s = std::numeric_limits<double>::infinity();
    session.records()[601].in.frame.speed_rad_per_s = std::numeric_limits<double>::quiet_NaN();
    const SessionFigures figures = session.Figures(RatedRig(6000.0));
    EXPECT_NEAR(RadPerSToRpm(figures.levitated_speed_rad_per_s),
                wrong_frames == 1 ? 3000.0 : 5000.0, 1e-9);
  }
}

}  // namespace
}  // namespace levitas::verdict
