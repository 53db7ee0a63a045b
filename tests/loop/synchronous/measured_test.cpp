// T from what a record measured of a rotor that is not the file's: the harm of the file's T, and
// none with the measured one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/loop_response.hpp"
#include "analysis/synchronous_loop.hpp"
#include "common/problem.hpp"
#include "common/random.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "design/notch/measured_plant.hpp"
#include "tests/loop/synchronous/notch_loop.hpp"
#include "tests/support/modes_within.hpp"

namespace levitas::test {
namespace {

using synchronous::Target;

/// What a record at this speed would give: lines of 1.22 Hz, each entry with 2 % of noise, without
/// those next to the rotation's first orders, as amb identify frf leaves them out.
design::MeasuredPlant MeasuredAt(const plant::PlantConfig& rig, const law::LawConfig& law,
                                 double speed_rad_per_s, Random& noise) {
  const analysis::LoopResponse response(analysis::CloseLoop(rig, law, speed_rad_per_s));
  const double rotation_hz = speed_rad_per_s / (2.0 * std::numbers::pi);
  design::MeasuredPlant measured;
  measured.speed_rad_per_s = speed_rad_per_s;
  for (double f = 1.22; f < 400.0; f += 1.22) {
    const bool beside = rotation_hz > 0.0 && f < 5.5 * rotation_hz &&
                        std::abs(std::remainder(f, rotation_hz)) < 2.0;
    if (beside) continue;
    Eigen::MatrixXcd plant = response.Plant(f);
    for (auto& entry : plant.reshaped()) {
      entry *= 1.0 + 0.02 * std::complex<double>(noise.Normal(), noise.Normal());
    }
    measured.frequency_hz.push_back(f);
    measured.plant.push_back(plant);
  }
  return measured;
}

synchronous::SynchronousConfig With(const synchronous::BlockConfig& block) {
  synchronous::SynchronousConfig control;
  control.blocks.push_back(block);
  control.blocks.front().time_constant_s = 1.0;
  return control;
}

class MeasuredT : public testing::TestWithParam<Target> {};

TEST_P(MeasuredT, IsStableOnRotorsOnWhichTheFilesIsNot) {
  const auto law = CommissionedCycle().law;
  const auto file = With(WithBlock(Asked(GetParam(), 1500.0, 4200.0)).synchronous.blocks.front());
  const auto parameters =
      ModesWithin(0.3, uncertainty::Stated(ShippedRig(), {.current_gain = 0.1, .stiffness = 0.1}));
  Random draw(43);
  int held = 0;
  int harmed = 0;
  for (int n = 0; n < 20; ++n) {
    const auto rig =
        uncertainty::At(ShippedRig(), parameters, uncertainty::DrawPlace(draw, parameters.size()));
    design::NotchRequest request = Asked(GetParam(), 1500.0, 4200.0);
    bool alone = true;
    for (const double rpm : {0.0, 3000.0, 4500.0}) {
      const double speed = RpmToRadPerS(rpm);
      const auto loop = analysis::CloseLoop(rig.plant, law, speed);
      alone = alone && analysis::LargestPoleModulus(loop) < std::exp(-2.0 * loop.period_s);
      request.measured.push_back(MeasuredAt(rig.plant, law, speed, draw));
    }
    if (!alone) continue;
    // The file that the table is made with is the shipped one: of it, only the law counts.
    const auto measured = With(design::WithInverse(ShippedRig(), law, request));
    bool by_file = false;
    for (double rpm = 1500.0; rpm <= 4200.0; rpm += 300.0) {
      const double speed = RpmToRadPerS(rpm);
      const auto loop = analysis::CloseLoop(rig.plant, law, speed);
      const auto judged = analysis::JudgeSynchronous(loop, measured, speed);
      EXPECT_TRUE(judged.stable()) << "rotor " << n << " at " << rpm << " rpm: decay "
                                   << judged.blocks.front().slowest_decay;
      by_file |= !analysis::JudgeSynchronous(loop, file, speed).stable();
    }
    ++held;
    harmed += by_file ? 1 : 0;
  }
  EXPECT_GE(held, 5);
  EXPECT_GT(harmed, 0);
  RecordProperty("held", std::to_string(held));
  RecordProperty("harmed_by_the_files_rotor", std::to_string(harmed));
}

INSTANTIATE_TEST_SUITE_P(OfBothTargets, MeasuredT,
                         testing::Values(Target::kCurrent, Target::kVibration));

TEST(MeasuredPlant, IsOnTheLineBetweenItsLinesAndSpeeds) {
  const auto at = [](double speed, double slope) {
    design::MeasuredPlant record;
    record.speed_rad_per_s = speed;
    for (const double f : {100.0, 104.0, 108.0}) {
      record.frequency_hz.push_back(f);
      record.plant.push_back(Eigen::MatrixXcd::Constant(1, 1, {slope * f, -f}));
    }
    return record;
  };
  const std::vector<design::MeasuredPlant> records{at(0.0, 1.0), at(100.0, 3.0)};
  const auto one = [&](double speed, double f) { return PlantAt(records, speed, f)(0, 0); };
  EXPECT_NEAR(std::abs(one(0.0, 105.0) - std::complex<double>(105.0, -105.0)), 0.0, 1e-9);
  EXPECT_NEAR(std::abs(one(25.0, 102.0) - std::complex<double>(153.0, -102.0)), 0.0, 1e-9);
  EXPECT_EQ(one(900.0, 104.0), one(100.0, 104.0)) << "beyond the records: the nearest";
  EXPECT_THROW((void)one(0.0, 90.0), BadInput);
  EXPECT_THROW((void)one(0.0, 109.0), BadInput);
}

}  // namespace
}  // namespace levitas::test
