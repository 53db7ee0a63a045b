// Sensitivities by one linear propagation against finite differences of the nonlinear model's runs.

#include "diagnosis/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "controller/law/axis_law.hpp"
#include "diagnosis/terms/terms.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kRows = 3'000;
constexpr double kSpeed = 3000.0 * test::kRpm;

RigNumbers Numbers() {
  RigNumbers numbers;
  numbers.name = "flexible_rotor";
  numbers.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  numbers.bearings = {"de", "nde"};
  return numbers;
}

/// Levitated at 3000 rpm; the sensors' noise excites everything.
Record ClosedLoop() {
  const law::LawCoefficients law(test::FlexibleRotorLaw());
  law::LawState state(law);
  plant::Plant plant(test::FlexibleRotor(), 20261121);
  plant.SetSpeed(kSpeed, 0.0);
  Record record;
  for (std::size_t n = 0; n < kRows; ++n) {
    const SensorFrame frame = plant.Sample();
    AxisArray error_m{};
    for (std::size_t i = 0; i < 4; ++i) error_m[i] = -frame.position_m[i];
    plant::PlantCommand command;
    command.bias_current_a = 1.0;
    command.control_current_a = law::Step(law, state, error_m, {}, 1.0).control_current_a;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = kSpeed;
    analysis::RecordedRow row;
    row.cycle = frame.cycle;
    row.levitated = true;
    row.sample = {frame.position_m, command, frame.speed_rad_per_s, frame.angle_rad};
    record.rows.push_back(row);
    plant.Advance(command);
  }
  record.mean_speed_rad_per_s = kSpeed;
  return record;
}

/// Relative difference of propagated and finite-difference derivatives of one term.
double Difference(const RigView& rig, const Record& record, const std::vector<Term>& terms,
                  std::size_t which) {
  analysis::ObserverTuning tuning;
  tuning.speed_rad_per_s = kSpeed;
  tuning.force_noise_share = 0.001;
  const auto gain = std::make_shared<const analysis::ObserverGain>(
      analysis::DesignObserver(rig.model->config(), tuning));
  std::vector<double> theta(terms.size(), 0.0);
  const Trajectory base = RunModel(rig, record, gain, terms, theta, 0.0);
  const Term& term = terms[which];
  const double step = term.linear ? 0.01 * term.scale() : term.step;
  theta[which] = step;
  const Trajectory moved = RunModel(rig, record, gain, terms, theta, 0.0);
  theta[which] = 0.0;
  SensitivityBlock block(rig, gain, terms, theta, {which});
  std::array<float, kMaxAxes * kLanes> derivative{};
  double error = 0.0;
  double size = 0.0;
  for (std::size_t n = 0; n < base.moments.size(); ++n) {
    block.Step(base.moments[n], derivative.data());
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const double finite =
          static_cast<double>(moved.moments[n].innovation_m[a] - base.moments[n].innovation_m[a]) *
          term.scale() / step;
      error += std::pow(finite - static_cast<double>(derivative[a * kLanes]), 2);
      size += finite * finite;
    }
  }
  return std::sqrt(error / size);
}

TEST(Sensitivities, AreTheDerivativesOfTheNonlinearModelForEveryTermThatMovesTheRotor) {
  const RigView rig(Numbers(), test::FlexibleRotor());
  const auto terms = AllTerms(rig, Tolerances{}, 30e-6);
  const Record record = ClosedLoop();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::string& effect = terms[i].effect;
    const bool one_of_each = i == 0 || terms[i - 1].effect != effect;
    const bool smooth = !effect.empty() && effect != "touchdown_rub" && effect != "modal_frequency";
    if (!one_of_each || !smooth) continue;
    // 12 %: half a sample of delay and the curvature of the step of what is not linear; a wrong
    // sign or a forgotten path shows as 100 %.
    EXPECT_LT(Difference(rig, record, terms, i), 0.12) << effect << " at " << terms[i].place;
    ++compared;
  }
  EXPECT_GT(compared, 20U);
}

}  // namespace
}  // namespace levitas::diagnosis
