// The vector that a search moves, and the law that it stands for: what is held stays, what is not
// moves, and nothing leaves its bounds.

#include "design/pid/law_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/random.hpp"

namespace levitas::design {
namespace {

constexpr double kPeriod_s = 1e-4;
constexpr double kHighest_hz = kHighestCornerShare / kPeriod_s;

/// Two lead-lags and three notches of each bearing, of which the first ones are held.
LawShape PartlyHeld(bool own_filters) {
  LawShape shape;
  shape.bearings = 2;
  shape.axes = 4;
  shape.lead_lags = 2;
  shape.notches = 3;
  shape.lead_lags_at_hz = {510.0};
  shape.notches_at_hz = {730.0, 1210.0};
  shape.own_filters = own_filters;
  shape.period_s = kPeriod_s;
  return shape;
}

PlainGains Gains() {
  return {
      .kp_a_per_m = {4e3, 5e3}, .kd_a_s_per_m = {10.0, 15.0}, .notch_hz = {300.0, 900.0, 640.0}};
}

/// Zero and pole are rounded to six digits each.
void ExpectAbout(const law::LeadLag& lead, double hz) {
  EXPECT_NEAR(std::sqrt(lead.zero_hz * lead.pole_hz), hz, 1e-5 * hz);
}

void ExpectHeld(const law::AxisLawConfig& axis) {
  ASSERT_EQ(axis.lead_lags.size(), 2U);
  ASSERT_EQ(axis.notches.size(), 3U);
  ExpectAbout(axis.lead_lags[0], 510.0);
  EXPECT_EQ(axis.notches[0].frequency_hz, 730.0);
  EXPECT_EQ(axis.notches[1].frequency_hz, 1210.0);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(axis.notches[i].prewarp);
    EXPECT_LE(axis.notches[i].zero_damping, axis.notches[i].pole_damping);
  }
  EXPECT_FALSE(axis.notches[2].prewarp);
}

void ExpectWithinBounds(const law::AxisLawConfig& axis) {
  const auto corner = [](double hz) {
    EXPECT_GE(hz, kLowestCornerHz * (1.0 - 1e-5));
    EXPECT_LE(hz, kHighest_hz * (1.0 + 1e-5));
  };
  corner(axis.derivative_hz);
  for (const auto& lead : axis.lead_lags) {
    corner(lead.zero_hz);
    corner(lead.pole_hz);
  }
  for (const auto& notch : axis.notches) {
    corner(notch.frequency_hz);
    for (const double damping : {notch.zero_damping, notch.pole_damping}) {
      EXPECT_GE(damping, 0.02);
      EXPECT_LE(damping, 3.0);
    }
  }
}

// Small steps as a search takes, and steps that throw every value against its bounds.
TEST(LawVector, HoldsWhatIsHeldOnEveryBearingAndMovesTheRest) {
  for (const bool own : {false, true}) {
    const LawShape shape = PartlyHeld(own);
    const Eigen::VectorXd start = StartAt(shape, Gains());
    ASSERT_EQ(static_cast<std::size_t>(start.size()), shape.unknowns());
    Random random(5);
    for (const double step : {0.2, 20.0}) {
      std::set<double> free_notch_hz;
      std::set<double> free_zero_hz;
      std::set<double> held_zero_hz;
      for (int n = 0; n < 40; ++n) {
        Eigen::VectorXd x = start;
        for (auto& value : x) value += step * random.Normal();
        const law::LawConfig law = LawAt(shape, x);
        ASSERT_EQ(law.axes.size(), 4U);
        for (const auto& axis : law.axes) {
          ExpectHeld(axis);
          ExpectWithinBounds(axis);
        }
        // Of one bearing alike; of two only where the filters are shared.
        EXPECT_EQ(law.axes[0].notches[2].frequency_hz, law.axes[1].notches[2].frequency_hz);
        if (step < 1.0) {
          EXPECT_EQ(law.axes[0].notches[2].frequency_hz == law.axes[2].notches[2].frequency_hz,
                    !own);
        }
        free_notch_hz.insert(law.axes[0].notches[2].frequency_hz);
        free_zero_hz.insert(law.axes[0].lead_lags[1].zero_hz);
        held_zero_hz.insert(law.axes[0].lead_lags[0].zero_hz);
      }
      const std::size_t most = step < 1.0 ? 40 : 2;  // bounds, and little between
      EXPECT_GE(free_notch_hz.size(), most);
      EXPECT_GE(free_zero_hz.size(), most);
      EXPECT_GE(held_zero_hz.size(), most);
    }
  }
}

// At the lowest and the highest corner nothing is left on the other side: no lead, no lag.
TEST(LawVector, LeavesNoRoomForALeadHeldAtTheEndsOfTheRange) {
  for (const double hz : {kLowestCornerHz, kHighest_hz}) {
    LawShape shape = PartlyHeld(false);
    shape.lead_lags_at_hz = {hz, hz};
    Random random(6);
    for (int n = 0; n < 10; ++n) {
      Eigen::VectorXd x = StartAt(shape, Gains());
      for (auto& value : x) value += random.Normal();
      const law::LawConfig law = LawAt(shape, x);
      for (const law::LeadLag& lead : law.axes[0].lead_lags) {
        EXPECT_DOUBLE_EQ(lead.zero_hz, hz);
        EXPECT_DOUBLE_EQ(lead.pole_hz, hz);
      }
    }
  }
}

// Phase of (1 + j f/z)/(1 + j f/p): lead with the zero below, lag with it above, most at 510 Hz.
TEST(LawVector, HoldsTheFrequencyOfTheLargestLeadOrLag) {
  const LawShape shape = PartlyHeld(false);
  const Eigen::VectorXd start = StartAt(shape, Gains());
  const Eigen::Index first_lead = 2 * 2 + 1 + 1;  // behind the gains and the derivative's corner
  for (const double apart : {0.8, -0.8}) {
    Eigen::VectorXd x = start;
    x[first_lead] += apart;
    const law::LeadLag lead = LawAt(shape, x).axes[3].lead_lags[0];
    const auto phase = [&](double hz) {
      return std::atan(hz / lead.zero_hz) - std::atan(hz / lead.pole_hz);
    };
    EXPECT_EQ(phase(510.0) > 0.0, apart > 0.0);
    for (const double beside : {0.9, 1.1}) {
      EXPECT_LT(std::abs(phase(beside * 510.0)), std::abs(phase(510.0)));
    }
  }
}

TEST(LawVector, OfOwnFiltersStandsForTheSameLawAtFirst) {
  const LawShape shared = PartlyHeld(false);
  Eigen::VectorXd x = StartAt(shared, Gains());
  Random random(7);
  for (auto& value : x) value += 0.3 * random.Normal();
  const Eigen::VectorXd untied = Untied(shared, x);
  const LawShape own = PartlyHeld(true);
  ASSERT_EQ(static_cast<std::size_t>(untied.size()), own.unknowns());
  const law::LawConfig before = LawAt(shared, x);
  const law::LawConfig after = LawAt(own, untied);
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_EQ(after.axes[a].kp_a_per_m, before.axes[a].kp_a_per_m);
    EXPECT_EQ(after.axes[a].lead_lags[0].zero_hz, before.axes[a].lead_lags[0].zero_hz);
    EXPECT_EQ(after.axes[a].lead_lags[1].pole_hz, before.axes[a].lead_lags[1].pole_hz);
    EXPECT_EQ(after.axes[a].notches[1].pole_damping, before.axes[a].notches[1].pole_damping);
    EXPECT_EQ(after.axes[a].notches[2].frequency_hz, before.axes[a].notches[2].frequency_hz);
  }
}

}  // namespace
}  // namespace levitas::design
