// The rig file of a modal identification against the model that it was written from.
#include "identification/identified_rotor.hpp"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "common/problem.hpp"
#include "identification/identified_rig.hpp"
#include "identification/modal/modal_response.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;
constexpr Index kBending = 5;
constexpr double kTop_rad_per_s = 6000.0 / 60.0 * 2.0 * std::numbers::pi;

const configuration::RigFile& FlexibleRotor() {
  static const configuration::RigFile rig =
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  return rig;
}

ModalResult Unchanged() {
  ModalResult found{{}, {}, StartFromRig(FlexibleRotor().plant, kBending), {}, {}, {}, {}, {}, {},
                    {}, 0.0};
  found.rig = ToPhysical(found.start.frame, found.start.vector);
  found.support.assign(kBending, {Support::kShown, 0.0, 0.0});
  return found;
}

/// Written and read again, as a user has it.
configuration::RigFile Written(const ModalResult& found, RotorForm form) {
  return configuration::ParseRig(
      configuration::WriteRig(IdentifiedRig(FlexibleRotor(), found, form)), "written");
}

/// Eigenvalues of the plant, in an order of their own.
std::vector<std::complex<double>> Poles(const plant::PlantConfig& rig, double speed_rad_per_s) {
  const plant::LinearModel linear = plant::Linearise(plant::PlantModel(rig), speed_rad_per_s);
  const Eigen::VectorXcd values = linear.a.eigenvalues();
  return {values.begin(), values.end()};
}

/// Distance to the nearest pole of `among`, the largest over `poles`, as a share.
double Farthest(const std::vector<std::complex<double>>& poles,
                const std::vector<std::complex<double>>& among) {
  double farthest = 0.0;
  for (const auto pole : poles) {
    double nearest = 1e300;
    for (const auto other : among) nearest = std::min(nearest, std::abs(pole - other));
    farthest = std::max(farthest, nearest / std::abs(pole));
  }
  return farthest;
}

/// Largest relative deviation of the file's response from the model's over entries and lines.
double Deviation(const configuration::RigFile& file, const ModalResult& found,
                 double speed_rad_per_s) {
  const plant::PlantModel model(file.plant);
  const auto sampled =
      plant::Discretise(plant::Linearise(model, speed_rad_per_s), 1e-4, file.plant.delay_samples);
  const Index n = sampled.a.rows();
  double most = 0.0;
  for (const double f_hz : {20.0, 60.0, 160.0, 300.0}) {
    const auto z = std::polar(1.0, 2.0 * std::numbers::pi * f_hz * 1e-4);
    const Eigen::MatrixXcd resolvent = z * Eigen::MatrixXcd::Identity(n, n) - sampled.a;
    const Eigen::MatrixXcd exact =
        sampled.c * resolvent.partialPivLu().solve(sampled.b.cast<std::complex<double>>());
    const Eigen::MatrixXcd own = ModalResponse(found.start.frame, found.rig, f_hz, speed_rad_per_s);
    most = std::max(most, (exact - own).norm() / own.norm());
  }
  return most;
}

TEST(IdentifiedRotor, OfAnUnchangedRigHasThePolesOfItsShaftAtRestAndSpinning) {
  const configuration::RigFile file = Written(Unchanged(), RotorForm::kModes);
  ASSERT_TRUE(file.plant.rotor.given);
  for (const double speed : {0.0, kTop_rad_per_s}) {
    const auto shaft = Poles(FlexibleRotor().plant, speed);
    const auto modes = Poles(file.plant, speed);
    ASSERT_EQ(shaft.size(), modes.size());
    EXPECT_LT(Farthest(shaft, modes), 1e-6) << speed;
    EXPECT_LT(Farthest(modes, shaft), 1e-6) << speed;
  }
}

TEST(IdentifiedRotor, WithoutItsGyroscopicMatrixMissesTheSplittingOfTheModes) {
  configuration::RigFile file = Written(Unchanged(), RotorForm::kModes);
  const auto shaft = Poles(FlexibleRotor().plant, kTop_rad_per_s);
  file.plant.rotor.given->gyroscopic.clear();
  EXPECT_GT(Farthest(shaft, Poles(file.plant, kTop_rad_per_s)), 1e-3);
}

TEST(IdentifiedRotor, RespondsAsTheModelWhereTheFilesShaftDoesNot) {
  ModalResult found = Unchanged();
  // Larger deflections, a stronger gyroscopic effect of the second mode, another rigid body.
  found.rig.actuator.bottomRows(kBending) *= 1.2;
  found.rig.sensor.bottomRows(kBending) *= 1.3;
  found.rig.gyroscopic(3, 3) *= 1.5;
  found.rig.frequency_rad_per_s[2] *= 1.05;
  found.start.vector[found.start.frame.layout.mass] += 0.02;
  const Physical other = ToPhysical(found.start.frame, found.start.vector);
  found.rig.mass_kg = other.mass_kg;
  found.rig.actuator.topRows(2) = other.actuator.topRows(2);
  found.rig.sensor.topRows(2) = other.sensor.topRows(2);
  for (const double speed : {0.0, kTop_rad_per_s}) {
    // The model leaves out the hold's images and what ks makes of modes beyond: 1e-3 of a force.
    EXPECT_LT(Deviation(Written(found, RotorForm::kModes), found, speed), 0.005) << speed;
    EXPECT_GT(Deviation(Written(found, RotorForm::kShaft), found, speed), 0.05) << speed;
  }
}

TEST(IdentifiedRotor, KeepsTheFilesShapeBetweenThePlanesAndMovesItByWhatWasMeasured) {
  ModalResult found = Unchanged();
  found.rig.actuator.row(2).array() += 0.05;
  found.rig.sensor.row(2).array() += 0.05;
  const rotor::GivenRotor changed = IdentifiedRotor(FlexibleRotor(), found);
  const rotor::GivenRotor file = IdentifiedRotor(FlexibleRotor(), Unchanged());
  ASSERT_EQ(changed.modes.size(), file.modes.size());
  for (std::size_t i = 0; i < file.modes[0].shape.size(); ++i) {
    // The same everywhere, so it must be so at every place: between the planes and beyond them.
    EXPECT_NEAR(changed.modes[0].shape[i].deflection - file.modes[0].shape[i].deflection, 0.05,
                1e-12);
    EXPECT_EQ(changed.modes[1].shape[i].deflection, file.modes[1].shape[i].deflection);
  }
}

TEST(IdentifiedRig, CountsNothingTwiceThatTheFileHeldAsAnEffect) {
  configuration::RigFile rig = FlexibleRotor();
  const auto count = [](const configuration::RigFile& file) {
    return std::ranges::count(file.plant.effects, effect::Id::kCurrentGain,
                              &effect::EffectConfig::id);
  };
  effect::EffectConfig weak;
  weak.id = effect::Id::kCurrentGain;
  weak.values[0] = 0.8;
  rig.plant.effects.push_back(weak);
  EXPECT_EQ(count(IdentifiedRig(rig, Unchanged(), RotorForm::kModes)), 0);
  // What sets in later was not there when the rig was measured.
  rig.plant.effects.back().at_s = 3.0;
  EXPECT_EQ(count(IdentifiedRig(rig, Unchanged(), RotorForm::kModes)), 1);
}

TEST(IdentifiedRig, AsModesRefusesACrackWhichNeedsTheShaft) {
  configuration::RigFile rig = FlexibleRotor();
  effect::EffectConfig crack;
  crack.id = effect::Id::kBreathingCrack;
  crack.values = {0.2, 0.05};
  rig.plant.effects.push_back(crack);
  EXPECT_NO_THROW((void)IdentifiedRig(rig, Unchanged(), RotorForm::kShaft));
  try {
    (void)IdentifiedRig(rig, Unchanged(), RotorForm::kModes);
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("--rotor shaft"));
  }
}

}  // namespace
}  // namespace levitas::identification
