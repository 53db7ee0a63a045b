// A mode stands out by its shape over frequency, noise does not; whirl frequencies lead the
// gyroscopic matrix to where the data have it.
#include "identification/modal/mode_scan.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "identification/modal/modal_response.hpp"
#include "identification/modal/whirl_start.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

const ModalStart& ScanStart() {
  static const ModalStart start = StartFromRig(
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml").plant, 5);
  return start;
}

/// The rig file's response on lines 1.2 Hz apart, noise of the same size on all of them; with
/// `without` bending mode that takes no force.
FrequencyResponse Noisy(double noise_m_per_a, Eigen::Index without = -1) {
  Random random(19);
  FrequencyResponse data;
  data.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  Physical rig = ToPhysical(ScanStart().frame, ScanStart().vector);
  if (without >= 0) rig.actuator.row(2 + without).setZero();
  for (double f = 12.0; f < 1100.0; f += 1.2) {
    Eigen::MatrixXcd plant = ModalResponse(ScanStart().frame, rig, f, 0.0);
    for (Eigen::Index i = 0; i < 16; ++i) {
      plant.data()[i] += noise_m_per_a / std::numbers::sqrt2 *
                         std::complex<double>(random.Normal(), random.Normal());
    }
    data.frequency_hz.push_back(f);
    data.plant.push_back(plant);
    data.variance.push_back(Eigen::MatrixXd::Constant(4, 4, noise_m_per_a * noise_m_per_a));
  }
  return data;
}

std::vector<double> InMagnets() {
  auto hz = PlantFrequenciesHz(ToPhysical(ScanStart().frame, ScanStart().vector), false);
  return {hz.end() - 5, hz.end()};
}

TEST(ModeScan, FindsEveryBendingModeAndNoOther) {
  const auto truth = InMagnets();
  // So clean that the planes' own frequencies and the coarse damping matter, and as noisy as a
  // campaign leaves it.
  for (const double noise_m_per_a : {2e-8, 3e-7}) {
    const auto modes = ScanModes(Noisy(noise_m_per_a), 20.0, 1050.0);
    ASSERT_EQ(modes.size(), truth.size()) << noise_m_per_a;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      // Within the width of a resonance of 0.3 % damping.
      EXPECT_NEAR(modes[i].frequency_hz / truth[i], 1.0, 3e-3);
    }
  }
}

TEST(ModeScan, AModeThatNoForceReachesIsNotSeen) {
  const auto modes = ScanModes(Noisy(2e-8, 3), 20.0, 1050.0);
  const auto truth = InMagnets();
  EXPECT_EQ(modes.size(), truth.size() - 1);
  for (const ScannedMode& mode : modes) {
    EXPECT_GT(std::abs(mode.frequency_hz / truth[3] - 1.0), 0.01) << mode.frequency_hz;
  }
}

TEST(ModeScan, SeesNothingInNoise) {
  FrequencyResponse data = Noisy(2e-8);
  Random random(3);
  for (Eigen::MatrixXcd& plant : data.plant) {
    for (Eigen::Index i = 0; i < 16; ++i) {
      plant.data()[i] =
          2e-8 / std::numbers::sqrt2 * std::complex<double>(random.Normal(), random.Normal());
    }
  }
  EXPECT_TRUE(ScanModes(data, 20.0, 1050.0).empty());
}

TEST(WhirlStart, WhirlsAreThoseOfTheFreeRotorWithoutMagnets) {
  Physical rig = ToPhysical(ScanStart().frame, ScanStart().vector);
  rig.ks_n_per_m.setConstant(1e-6);
  // Without G each mode has its own frequency twice.
  Physical still = rig;
  still.gyroscopic.setZero();
  const auto standing = WhirlsInMagnets(still, RpmToRadPerS(3000.0));
  const auto turning = WhirlsInMagnets(rig, RpmToRadPerS(3000.0));
  for (std::size_t i = 0; i < turning.size(); ++i) {
    const auto mode = static_cast<Eigen::Index>(i);
    const double own_hz = rig.frequency_rad_per_s[2 + mode] / kTwoPi;
    EXPECT_NEAR(standing[i].backward_hz, own_hz, 1e-6 * own_hz);
    EXPECT_NEAR(standing[i].forward_hz, own_hz, 1e-6 * own_hz);
    // First order in G: apart by W G_ii / 2 pi; the other entries act to the second, a tenth here.
    const double apart_hz = RpmToRadPerS(3000.0) * rig.gyroscopic(2 + mode, 2 + mode) / kTwoPi;
    EXPECT_NEAR(turning[i].forward_hz - turning[i].backward_hz, apart_hz, 0.1 * apart_hz);
  }
}

TEST(WhirlStart, TheDiagonalOfTheMatrixComesFromTheSplits) {
  const ModalStart& start = ScanStart();
  const ModalLayout& at = start.frame.layout;
  std::vector<ProposedMode> shown;
  for (const Whirl& whirl :
       WhirlsInMagnets(ToPhysical(start.frame, start.vector), RpmToRadPerS(3000.0))) {
    shown.push_back({whirl.backward_hz, 0.003, 1.0});
    shown.push_back({whirl.forward_hz, 0.003, 1.0});
  }
  shown.pop_back();  // of the last mode only one whirl is seen
  Eigen::VectorXd vector = start.vector;
  for (Eigen::Index i = 0; i < at.bending; ++i) {
    vector[at.gyroscopic_at(1 + i, 1 + i)] *= i % 2 == 0 ? 0.6 : 1.4;
  }
  MeetWhirls(start.frame, RpmToRadPerS(3000.0), shown, vector);
  for (Eigen::Index i = 0; i < at.bending; ++i) {
    const Eigen::Index k = at.gyroscopic_at(1 + i, 1 + i);
    EXPECT_NEAR(vector[k] / start.vector[k], 1.0, 0.01) << "mode " << i + 1;
  }
}

TEST(WhirlStart, WithoutWhirlsInTheDataNothingMoves) {
  Eigen::VectorXd vector = ScanStart().vector;
  MeetWhirls(ScanStart().frame, RpmToRadPerS(3000.0), {}, vector);
  EXPECT_EQ(vector, ScanStart().vector);
}

}  // namespace
}  // namespace levitas::identification
