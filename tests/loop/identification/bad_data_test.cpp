// Each defect of a record gets one sentence that names it, never a model.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "benchmark/accuracy/identification/simulated_campaign.hpp"
#include "common/problem.hpp"
#include "identification/frf/frequency_response.hpp"
#include "tests/loop/identification/flexible_rotor.hpp"

namespace levitas::identification {
namespace {

using testing::HasSubstr;

/// A short campaign: 255 bits of two samples, three periods on each axis.
const session::Recording& GoodCampaign() {
  static const session::Recording record = [] {
    accuracy::ExcitationPlan plan;
    plan.order = 8;
    plan.periods = 3;
    return accuracy::SimulateCampaign(FlexibleRotor(), plan);
  }();
  return record;
}
constexpr std::size_t kPeriod = 510;
constexpr std::size_t kRowsPerAxis = 3 * kPeriod;
constexpr double kDelayS = 1e-4;

std::string SpoiltRefusal(const std::function<void(session::Recording&)>& spoil) {
  session::Recording record = GoodCampaign();
  spoil(record);
  try {
    (void)EstimateResponses(record, kDelayS);
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

void Erase(session::Recording& r, std::size_t from, std::size_t count) {
  const auto erase = [&](auto& column) {
    const auto begin = column.begin() + static_cast<std::ptrdiff_t>(from);
    column.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  erase(r.cycle);
  erase(r.levitated);
  erase(r.speed_rad_per_s);
  erase(r.angle_rad);
  for (auto* columns : {&r.position_m, &r.current_a, &r.excitation_a}) {
    for (session::Column& column : *columns) erase(column);
  }
}

TEST(BadData, AGoodRecordIsAccepted) {
  EXPECT_EQ(SpoiltRefusal([](session::Recording&) {}), "accepted");
}

TEST(BadData, ADeadChannelIsNamed) {
  const std::string text =
      SpoiltRefusal([](session::Recording& r) { r.position_m[2].assign(r.rows(), 1e-6); });
  EXPECT_THAT(text, HasSubstr("position nde_x is dead"));
}

TEST(BadData, AClippedPositionIsNamed) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (double& value : r.position_m[1]) value = value > 2e-6 ? r.sensor_range_m[1] : value;
  });
  EXPECT_THAT(text, HasSubstr("position de_y is clipped"));
}

TEST(BadData, APositionThatIsCutOffBelowTheRangeIsNamed) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (double& value : r.position_m[1]) value = std::min(value, 2e-6);
  });
  EXPECT_THAT(text, HasSubstr("position de_y is cut off below the sensor's range"));
}

TEST(BadData, ASaturatedCurrentIsNamed) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (double& value : r.current_a[3]) value = value > 0.1 ? r.current_limit_a : value;
  });
  EXPECT_THAT(text, HasSubstr("control current nde_y is at its limit (1 A)"));
  EXPECT_THAT(text, HasSubstr("allowed 2 %"));
}

TEST(BadData, NoExcitationIsSaid) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (session::Column& column : r.excitation_a) column.assign(r.rows(), 0.0);
  });
  EXPECT_THAT(text, HasSubstr("no excitation in the record"));
}

TEST(BadData, AMissingPeriodIsSaid) {
  // Of three periods of the last axis one and a half remain.
  const std::string text = SpoiltRefusal(
      [](session::Recording& r) { Erase(r, r.rows() - 3 * kPeriod / 2, 3 * kPeriod / 2); });
  EXPECT_THAT(text, HasSubstr("excitation of nde_y"));
  EXPECT_THAT(text, HasSubstr("does not repeat itself"));
}

TEST(BadData, TwoPeriodsAreTooFewToAverage) {
  const std::string text =
      SpoiltRefusal([](session::Recording& r) { Erase(r, r.rows() - kPeriod, kPeriod); });
  EXPECT_THAT(text, HasSubstr("2 whole periods of 510 samples, needed are 3"));
}

TEST(BadData, SignalsOfUnequalLengthAreRefused) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (std::size_t n = 3 * kRowsPerAxis; n < r.rows(); ++n) {
      r.excitation_a[3][n] = n % 100 < 50 ? 0.1 : -0.1;
    }
  });
  EXPECT_THAT(text, HasSubstr("repeats after 510 samples, that of nde_y after 100"));
}

TEST(BadData, AProbeWiredTheWrongWayIsNamed) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (double& value : r.position_m[0]) value = -value;
  });
  EXPECT_THAT(text, HasSubstr("de_x moves with the current"));
}

TEST(BadData, AnExcitationColumnOfTheWrongSignIsNamed) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (double& value : r.excitation_a[1]) value = -value;
  });
  EXPECT_THAT(text, HasSubstr("control current de_y follows its excitation with the wrong sign"));
}

TEST(BadData, MissingRowsAreCounted) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (std::size_t n = 700; n < r.rows(); ++n) r.cycle[n] += 3;
  });
  EXPECT_THAT(text, HasSubstr("3 samples are missing"));
}

TEST(BadData, AnAxisWithoutExperimentIsNamed) {
  const std::string text =
      SpoiltRefusal([](session::Recording& r) { Erase(r, kRowsPerAxis, kRowsPerAxis); });
  EXPECT_THAT(text, HasSubstr("de_y not excited at 0 rpm"));
}

TEST(BadData, TwoAxesAtOnceAreRefused) {
  const std::string text =
      SpoiltRefusal([](session::Recording& r) { r.excitation_a[2].assign(r.rows(), 0.01); });
  EXPECT_THAT(text, HasSubstr("excites de_x and nde_x together"));
}

TEST(BadData, ASpeedThatChangesIsRefused) {
  const std::string text = SpoiltRefusal([](session::Recording& r) {
    for (std::size_t n = 0; n < r.rows(); ++n) r.speed_rad_per_s[n] = 0.01 * static_cast<double>(n);
  });
  EXPECT_THAT(text, HasSubstr("the speed changes"));
}

}  // namespace
}  // namespace levitas::identification
