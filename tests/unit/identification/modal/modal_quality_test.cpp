// What the measures of a modal fit are made of, and how its random starts are drawn.
#include "identification/modal/modal_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "identification/modal/identify_modal.hpp"
#include "identification/modal/modal_response.hpp"
#include "identification/modal/modal_starts.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;

const ModalStart& QualityStart() {
  static const ModalStart start = StartFromRig(
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml").plant, 5);
  return start;
}

Physical QualityNominal() { return ToPhysical(QualityStart().frame, QualityStart().vector); }

/// The nominal response on some lines, all axes excited apart, with a variance of its own.
FrequencyResponse Exact(double sigma_m_per_a) {
  FrequencyResponse data;
  data.period_s = 1e-4;
  data.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(4, 4);
  data.moments = {zero, zero, zero};
  for (double f = 5.0; f < 1000.0; f *= 1.03) {
    data.frequency_hz.push_back(f);
    data.plant.push_back(ModalResponse(QualityStart().frame, QualityNominal(), f, 0.0));
    data.currents.emplace_back(Eigen::MatrixXcd::Identity(4, 4));
    data.variance.push_back(Eigen::MatrixXd::Constant(4, 4, sigma_m_per_a * sigma_m_per_a));
  }
  return data;
}

TEST(Misfit, IsZeroForTheModelOfTheDataAndOneForAnErrorOfTheAllowedSize) {
  // Entries across the planes are zero: a variance far below everything keeps them at zero error.
  const FrequencyResponse data = Exact(1e-15);
  const ModalFitOptions options{.floor = 0.02};
  auto model = ModelOn(QualityStart(), QualityStart().vector, data);
  EXPECT_LT(Misfit(data, model, options), 1e-20);  // the same equation twice
  for (Eigen::MatrixXcd& line : model) line *= Complex(1.0, 0.02);
  // Within a plane, which is half of the entries, each is off by 2 % of itself.
  EXPECT_NEAR(Misfit(data, model, options), 0.5, 1e-6);
}

TEST(Misfit, OfNoiseOfTheStatedVarianceIsOneAndOnlyTheNoisyChannelHasIt) {
  constexpr double kSigma = 1e-8;
  FrequencyResponse data = Exact(kSigma);
  const auto model = data.plant;
  Random random(21);
  for (Eigen::MatrixXcd& line : data.plant) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      line(2, j) += kSigma / std::numbers::sqrt2 * Complex(random.Normal(), random.Normal());
    }
  }
  const ModalFitOptions options{.highest_hz = 1000.0, .floor = 0.0};
  const Eigen::VectorXd by_channel = MisfitByChannel(data, model, options);
  // 180 lines of 4 complex entries: 1440 degrees of freedom, 3.7 % of one sigma; four of them.
  EXPECT_NEAR(by_channel[2], 1.0, 0.15);
  EXPECT_EQ(by_channel[0] + by_channel[1] + by_channel[3], 0.0);
  EXPECT_NEAR(Misfit(data, model, options), 0.25 * by_channel[2], 1e-12);
}

TEST(Misfit, LinesOutsideTheBandDoNotCount) {
  FrequencyResponse data = Exact(1e-8);
  const auto model = data.plant;
  for (std::size_t k = 0; k < data.plant.size(); ++k) {
    if (data.frequency_hz[k] < 50.0 || data.frequency_hz[k] > 300.0) data.plant[k] *= 2.0;
  }
  const ModalFitOptions options{.lowest_hz = 50.0, .highest_hz = 300.0};
  EXPECT_EQ(Misfit(data, model, options), 0.0);
  EXPECT_EQ(FitOf(data, model, options).fit, 100.0);
}

TEST(FitOf, IsTheShareThatTheModelExplainsAndItsCeilingThatOfTheNoise) {
  // With a floor far above the noise every entry counts alike: |P - 0.9 P|/|P| = 0.1.
  FrequencyResponse data = Exact(0.0);
  for (std::size_t k = 0; k < data.plant.size(); ++k) {
    data.plant[k].setConstant(Complex(3e-6, -4e-6));     // |P| = 5e-6
    data.variance[k].setConstant(0.04 * 0.04 * 25e-12);  // sigma = 4 % of it
  }
  auto model = data.plant;
  for (Eigen::MatrixXcd& line : model) line *= 0.9;
  const FitShare percent = FitOf(data, model, {.floor = 1.0});
  EXPECT_NEAR(percent.fit, 90.0, 1e-9);
  EXPECT_NEAR(percent.ceiling, 96.0, 1e-9);
}

TEST(RandomStart, MovesWhatIsFittedWithinItsSpreadAndNothingElse) {
  const ModalStart& start = QualityStart();
  const ModalLayout& at = start.frame.layout;
  std::vector<bool> fitted(static_cast<std::size_t>(at.size), true);
  fitted[static_cast<std::size_t>(at.mass)] = false;
  Random random(8);
  const Eigen::VectorXd moved =
      RandomStart(start, fitted, {.everything = 0.2, .gains = 0.05}, random);
  EXPECT_EQ(moved[at.mass], start.vector[at.mass]);
  const Physical from = QualityNominal();
  const Physical to = ToPhysical(start.frame, moved);
  const auto apart = [](const auto& a, const auto& b) {
    return (a.cwiseQuotient(b).array() - 1.0).abs().maxCoeff();
  };
  for (const auto& [a, b] : {std::pair{to.ki_n_per_a, from.ki_n_per_a},
                             {to.ks_n_per_m, from.ks_n_per_m},
                             {to.gain, from.gain}}) {
    EXPECT_LE(apart(a, b), 0.05);
    EXPECT_GT(apart(a, b), 0.0);
  }
  const Eigen::VectorXd modes_to = to.frequency_rad_per_s.tail(5);
  const Eigen::VectorXd modes_from = from.frequency_rad_per_s.tail(5);
  EXPECT_LE(apart(modes_to, modes_from), 0.2);
  EXPECT_GT(apart(modes_to, modes_from), 0.05);  // five draws, all within 5 % of 20: 1e-3
  Random again(8);
  EXPECT_EQ(RandomStart(start, fitted, {.everything = 0.2, .gains = 0.05}, again), moved);
  EXPECT_EQ(RandomStart(start, fitted, {.everything = 0.0, .gains = 0.0}, again), start.vector);
}

TEST(Apart, OfPlantsWhoseSensorsDifferByAShareIsItsSquareInUnitsOfTheFloor) {
  const FrequencyResponse data = Exact(1e-15);
  const auto result = [](double gain) {
    ModalResult r{{}, {.floor = 0.01}, QualityStart(), {}, {}, {}, {}, {}, {}, {}, 0.0};
    r.fit.vector = QualityStart().vector;
    r.fit.vector.segment(QualityStart().frame.layout.gain, 4).array() += std::log(gain);
    r.quality.resize(1);
    r.quality[0].fitted = true;
    return r;
  };
  EXPECT_EQ(Apart(result(1.0), result(1.0), {data}), 0.0);
  // Half of the entries are zero in both, see above.
  EXPECT_NEAR(Apart(result(1.003), result(1.0), {data}), 0.5 * 0.09, 1e-6);
  EXPECT_NEAR(Apart(result(1.0), result(1.003), {data}), 0.5 * 0.09, 1e-6);
  // Mass and magnets half as large again: the plant is the same, and so are the fits.
  ModalResult heavier = result(1.0);
  const ModalLayout& at = QualityStart().frame.layout;
  heavier.fit.vector[at.mass] += std::log(1.5);
  heavier.fit.vector[at.inertia] += std::log(1.5);
  heavier.fit.vector.segment(at.ki, 8).array() += std::log(1.5);
  heavier.fit.vector.segment(at.shape, 20) /= std::sqrt(1.5);
  ModalResult lighter = result(1.0);
  // The modes beyond the fitted ones belong to the frame and scale with no unknown.
  heavier.start.frame.beyond.frequency_rad_per_s.resize(0);
  lighter.start.frame.beyond.frequency_rad_per_s.resize(0);
  EXPECT_LT(Apart(heavier, lighter, {data}), 1e-12);
}

}  // namespace
}  // namespace levitas::identification
