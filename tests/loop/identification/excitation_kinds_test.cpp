// Multisine, stepped sine and strokes tell the same response as the PRBS does, each within the
// variance that it states; what is too short for one is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>

#include "benchmark/accuracy/identification/simulated_campaign.hpp"
#include "common/problem.hpp"
#include "identification/frf/frequency_response.hpp"
#include "tests/loop/identification/flexible_rotor.hpp"

namespace levitas::identification {
namespace {

using scenario::SignalKind;
using testing::HasSubstr;
constexpr double kKindsDelayS = 1e-4;

accuracy::ExcitationPlan PlanOf(SignalKind kind) {
  accuracy::ExcitationPlan plan;
  if (kind == SignalKind::kPrbs) return plan;
  scenario::Excitation& e = plan.signal.emplace();
  e.kind = kind;
  if (kind == SignalKind::kMultisine) {
    e.amplitude_a = 0.1;
    e.from_hz = 6.0;
    e.to_hz = 1200.0;
    e.repeat_s = 0.5;
    plan.hold_s = 2.5;
  } else if (kind == SignalKind::kSteppedSine) {
    e.amplitude_a = 0.05;
    e.from_hz = 15.0;
    e.to_hz = 700.0;
    e.frequencies = 24;
    e.dwell_s = 0.3;
    plan.hold_s = e.frequencies * e.dwell_s;
  } else {
    e.amplitude_a = 0.6;
    e.width_s = 5e-4;
    e.repeat_s = 0.25;
    plan.hold_s = 8.0;
  }
  return plan;
}

const session::Recording& RecordOfKind(SignalKind kind) {
  static std::map<SignalKind, session::Recording> records;
  const auto found = records.find(kind);
  if (found != records.end()) return found->second;
  return records.emplace(kind, accuracy::SimulateCampaign(FlexibleRotor(), PlanOf(kind)))
      .first->second;
}

/// An entry in units of the closed form, which takes out that lines differ in frequency.
struct Ratio {
  double frequency_hz{};
  std::complex<double> value;
  double sigma{};
};

std::vector<Ratio> Ratios(const FrequencyResponse& r, Eigen::Index axis) {
  std::vector<Ratio> ratios;
  for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
    const double f = r.frequency_hz[k];
    if (f < 20.0 || f > 650.0) continue;
    const auto exact = Exact(f)(axis, axis);
    ratios.push_back({f, r.plant[k](axis, axis) / exact,
                      std::sqrt(r.variance[k](axis, axis)) / std::abs(exact)});
  }
  return ratios;
}

class Kinds : public testing::TestWithParam<SignalKind> {};

TEST_P(Kinds, GiveTheResponseOfThePrbsWithinTheVariancesOfBoth) {
  const auto prbs = EstimateResponses(RecordOfKind(SignalKind::kPrbs), kKindsDelayS);
  const auto own = EstimateResponses(RecordOfKind(GetParam()), kKindsDelayS);
  ASSERT_EQ(own.size(), 1U);
  std::vector<double> apart;
  std::vector<double> off;
  for (Eigen::Index axis = 0; axis < own.front().axes(); ++axis) {
    const auto reference = Ratios(prbs.front(), axis);
    for (const Ratio& one : Ratios(own.front(), axis)) {
      const auto nearest = std::ranges::min_element(reference, {}, [&one](const Ratio& other) {
        return std::abs(other.frequency_hz - one.frequency_hz);
      });
      apart.push_back(std::abs(one.value - nearest->value) / std::hypot(one.sigma, nearest->sigma));
      off.push_back(std::abs(one.value - 1.0) / std::max(one.sigma, 0.05));
    }
  }
  ASSERT_GT(off.size(), 80U);
  // The median of a Rayleigh variable with unit mean square is 0.83. What each signal makes of the
  // magnets' nonlinearity (a few per cent below 100 Hz) may raise it, a variance that is wrong by
  // four in power, or a response that is another, would by more.
  EXPECT_GT(Median(apart), 0.5);
  EXPECT_LT(Median(apart), 1.6);
  // Against the closed form of the linear rig: half of the lines within the noise or 5 %, which is
  // the nonlinearity at these amplitudes.
  EXPECT_LT(Median(off), 1.0);
}

TEST_P(Kinds, CoherenceIsOneWhereThereIsHardlyAnyNoise) {
  configuration::RigFile silent = FlexibleRotor();
  for (auto& bearing : silent.plant.bearings) bearing.sensor.noise_rms_m = 5e-8;
  accuracy::ExcitationPlan plan = PlanOf(GetParam());
  plan.hold_s = std::min(plan.hold_s, 2.4);  // of a stepped sine the first eight
  const auto own = EstimateResponses(accuracy::SimulateCampaign(silent, plan), kKindsDelayS);
  const FrequencyResponse& r = own.front();
  ASSERT_GT(r.frequency_hz.size(), 5U);
  std::vector<double> near_loop;
  for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
    if (r.frequency_hz[k] > 80.0) break;
    near_loop.push_back(r.coherence[k](0, 0));
  }
  // A step of the converter and as much noise remain; the motion is a hundred times that.
  EXPECT_GT(Median(near_loop), 0.99);
}

INSTANTIATE_TEST_SUITE_P(Signals, Kinds,
                         testing::Values(SignalKind::kMultisine, SignalKind::kSteppedSine,
                                         SignalKind::kImpulse),
                         [](const auto& kind) {
                           switch (kind.param) {
                             case SignalKind::kMultisine:
                               return "Multisine";
                             case SignalKind::kSteppedSine:
                               return "SteppedSine";
                             default:
                               return "Impulse";
                           }
                         });

std::string Refusal(SignalKind kind, const std::function<void(session::Recording&)>& spoil) {
  session::Recording record = RecordOfKind(kind);
  spoil(record);
  try {
    (void)EstimateResponses(record, kKindsDelayS);
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

/// Of every axis' signal only the first `seconds` remain.
std::function<void(session::Recording&)> OnlyTheFirst(double seconds, double of_s) {
  return [seconds, of_s](session::Recording& r) {
    const auto keep = static_cast<std::size_t>(std::lround(seconds / r.period_s()));
    const auto all = static_cast<std::size_t>(std::lround(of_s / r.period_s()));
    for (session::Column& column : r.excitation_a) {
      for (std::size_t n = 0; n < column.size(); ++n) {
        if (n % all >= keep) column[n] = 0.0;
      }
    }
  };
}

TEST(ShortSignals, HalfAPeriodOfAMultisineIsRefused) {
  EXPECT_THAT(Refusal(SignalKind::kMultisine, OnlyTheFirst(0.25, 2.5)),
              HasSubstr("does not repeat itself"));
}

TEST(ShortSignals, TwoPeriodsOfAMultisineAreTooFew) {
  EXPECT_THAT(Refusal(SignalKind::kMultisine, OnlyTheFirst(1.0, 2.5)),
              HasSubstr("2 whole periods of 5000 samples, needed are 3"));
}

TEST(ShortSignals, OneStrokeIsNoTrain) {
  EXPECT_THAT(Refusal(SignalKind::kImpulse, OnlyTheFirst(0.2, 8.0)),
              HasSubstr("does not repeat itself"));
}

TEST(ShortSignals, ASineThatIsNotHeldLongEnoughIsNamed) {
  session::Recording record = RecordOfKind(SignalKind::kSteppedSine);
  ExperimentOptions options;
  options.settle_share = 0.9;  // of 0.3 s at 15 Hz nothing whole remains
  EXPECT_THROW(
      {
        try {
          (void)EstimateResponses(record, kKindsDelayS, options);
        } catch (const BadInput& problem) {
          EXPECT_THAT(problem.what(), HasSubstr("15.00 Hz is held for 0 whole periods"));
          throw;
        }
      },
      BadInput);
}

TEST(ShortSignals, AnAxisWhoseSweepBreaksOffIsNamed) {
  const std::string text = Refusal(SignalKind::kSteppedSine, [](session::Recording& r) {
    session::Column& last = r.excitation_a[3];
    for (std::size_t n = r.rows() - 12'000; n < r.rows(); ++n) last[n] = 0.0;
  });
  EXPECT_THAT(text, HasSubstr("the sines of de_x (24 frequencies) are not those of nde_y (20)"));
}

TEST(ShortSignals, ASweepThatWasCutBackIsRefused) {
  const std::string text = Refusal(SignalKind::kSteppedSine, [](session::Recording& r) {
    for (std::size_t n = 31'000; n < 36'000; ++n) r.excitation_a[0][n] *= 0.3;
  });
  EXPECT_THAT(text, HasSubstr("orbit limit"));
}

}  // namespace
}  // namespace levitas::identification
