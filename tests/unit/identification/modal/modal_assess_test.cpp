// What a fit states of itself: standard deviations from an information that is known, directions
// that no data tell, modes of a stabilisation diagram, the band in which a response says something.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "identification/identified_rig.hpp"
#include "identification/modal/modal_response.hpp"
#include "identification/modal/stabilisation.hpp"
#include "identification/modal/uncertainty.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/identification/modal/shipped_rotor.hpp"

namespace levitas::identification {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Index = Eigen::Index;

const ModalStart& AssessStart() {
  static const ModalStart start = StartFromRig(Rig().plant, 5);
  return start;
}

/// A fit of `free` unknowns of which the data say `information` each, apart from one another.
ModalFit Apart(const std::vector<Index>& free, double information) {
  const Index size = AssessStart().vector.size();
  ModalFit fit;
  fit.vector = AssessStart().vector;
  fit.fitted.assign(static_cast<std::size_t>(size), false);
  fit.information = fit.scatter = Eigen::MatrixXd::Zero(size, size);
  for (const Index k : free) {
    fit.fitted[static_cast<std::size_t>(k)] = true;
    fit.information(k, k) = information;
  }
  return fit;
}

TEST(Assess, DeviationsAreThoseOfDataAndPriorTogether) {
  const ModalLayout& at = AssessStart().frame.layout;
  const std::vector<Index> free{at.frequency, at.ki + 1, at.delay};
  const Uncertainty found = Assess(AssessStart(), Apart(free, 400.0));
  for (Index k = 0; k < AssessStart().vector.size(); ++k) {
    const bool fitted = std::ranges::find(free, k) != free.end();
    const double prior = AssessStart().prior[k];
    const double expected = fitted ? 1.0 / std::sqrt(400.0 + 1.0 / (prior * prior)) : 0.0;
    EXPECT_NEAR(found.deviation[k], expected, 1e-12)
        << AssessStart().names[static_cast<std::size_t>(k)];
  }
  EXPECT_TRUE(found.directions.empty());  // 400 x prior^2 is beyond 1 for all three
}

TEST(Assess, MisfitWidensIntervalsAndAFitBetterThanItsNoiseDoesNotNarrowThem) {
  const std::vector<Index> free{AssessStart().frame.layout.frequency};
  ModalFit fit = Apart(free, 400.0);
  const double plain = Assess(AssessStart(), fit).deviation[free[0]];
  fit.reduced_chi_square = 4.0;
  EXPECT_NEAR(Assess(AssessStart(), fit).deviation[free[0]], 2.0 * plain, 1e-12);
  fit.reduced_chi_square = 0.25;
  EXPECT_EQ(Assess(AssessStart(), fit).deviation[free[0]], plain);
  // Scatter nine times the information: C (S + 1/prior^2) C, which is nearly nine times C.
  fit.scatter(free[0], free[0]) = 9.0 * 400.0;
  const double prior = 1.0 / std::pow(AssessStart().prior[free[0]], 2.0);
  EXPECT_NEAR(Assess(AssessStart(), fit).deviation[free[0]],
              std::sqrt(3600.0 + prior) / (400.0 + prior), 1e-12);
}

TEST(Assess, WhatOnlyShowsAsAProductIsNamedWithTheExperimentThatTellsItApart) {
  // The data see ki g/m of axis 0 alone, to a thousandth: one row of the Jacobian.
  const ModalLayout& at = AssessStart().frame.layout;
  ModalFit fit = Apart({at.mass, at.ki, at.gain}, 0.0);
  Eigen::VectorXd row = Eigen::VectorXd::Zero(AssessStart().vector.size());
  row[at.ki] = row[at.gain] = 1e3;
  row[at.mass] = -1e3;
  fit.information = row * row.transpose();
  const Uncertainty found = Assess(AssessStart(), fit);
  EXPECT_NEAR(found.products[0], 1e-3, 1e-6);  // the priors add less than 1e-5 of it
  // By itself ki is known no better than mass and gain are by their priors.
  const double others = std::hypot(AssessStart().prior[at.mass], AssessStart().prior[at.gain]);
  EXPECT_GT(found.deviation[at.ki], 0.9 * others);
  ASSERT_EQ(found.directions.size(), 2U);  // three unknowns, one product
  std::vector<std::string> named;
  for (const Unidentifiable& direction : found.directions) {
    named.insert(named.end(), direction.unknowns.begin(), direction.unknowns.end());
    EXPECT_FALSE(direction.experiment.empty());
  }
  EXPECT_THAT(named, Contains("mass"));
}

/// The nominal response on lines 1.2 Hz apart with noise of one size; `factor` of both.
FrequencyResponse Response(double noise_m_per_a, double factor, bool with_rotor = true) {
  Random random(23);
  FrequencyResponse data;
  data.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  const Physical rig = ToPhysical(AssessStart().frame, AssessStart().vector);
  const double sigma = noise_m_per_a * factor;
  for (double f = 12.0; f < 1100.0; f += 1.2) {
    Eigen::MatrixXcd plant = Eigen::MatrixXcd::Zero(4, 4);
    if (with_rotor) plant = factor * ModalResponse(AssessStart().frame, rig, f, 0.0);
    for (Index i = 0; i < 16; ++i) {
      plant.data()[i] +=
          sigma / std::numbers::sqrt2 * std::complex<double>(random.Normal(), random.Normal());
    }
    data.frequency_hz.push_back(f);
    data.plant.push_back(plant);
    data.variance.push_back(Eigen::MatrixXd::Constant(4, 4, sigma * sigma));
  }
  return data;
}

TEST(Stabilise, ProposesThePolesOfTheRotorInItsMagnetsWithTheirDamping) {
  const Physical rig = ToPhysical(AssessStart().frame, AssessStart().vector);
  const auto hz = PlantFrequenciesHz(rig, false);
  const auto modes = Stabilise(Response(3e-7, 1.0), {.highest_hz = 1050.0}).modes;
  ASSERT_EQ(modes.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    // A sixth of the width of a peak of 0.3 %, with the noise of a campaign of the shipped rig.
    EXPECT_NEAR(modes[i].frequency_hz / hz[hz.size() - 5 + i], 1.0, 1e-3) << i;
    const double damping = rig.damping_ratio[static_cast<Index>(2 + i)];
    EXPECT_NEAR(modes[i].damping_ratio / damping, 1.0, 0.5) << i;
  }
}

TEST(Stabilise, SeesTheSameModesInOtherUnits) {
  const auto metres = Stabilise(Response(3e-7, 1.0), {.highest_hz = 600.0}).modes;
  const auto micrometres = Stabilise(Response(3e-7, 1e6), {.highest_hz = 600.0}).modes;
  ASSERT_EQ(metres.size(), micrometres.size());
  for (std::size_t i = 0; i < metres.size(); ++i) {
    // Weights are relative: rounding alone, magnified by the normal equations' condition.
    EXPECT_NEAR(micrometres[i].frequency_hz, metres[i].frequency_hz, 1e-4 * metres[i].frequency_hz);
  }
}

TEST(Stabilise, ProposesNothingInNoiseAlone) {
  EXPECT_TRUE(Stabilise(Response(1e-7, 1.0, false), {.highest_hz = 600.0}).modes.empty());
}

TEST(UsableBand, EndsWhereTheResponseFallsToTwiceItsNoise) {
  FrequencyResponse data;
  data.channels = {"x"};
  for (double f = 10.0; f < 3000.0; f += 2.0) {
    // |P| = 1e-3/f^2 in a noise of 1e-8/4: twice the noise at sqrt(1e-3/5e-9) = 447 Hz.
    data.frequency_hz.push_back(f);
    data.plant.emplace_back(Eigen::MatrixXcd::Constant(1, 1, 1e-3 / (f * f)));
    data.variance.emplace_back(Eigen::MatrixXd::Constant(1, 1, 6.25e-18));
  }
  // A tenth of an octave is 7 %; its median is half of that off its end.
  EXPECT_NEAR(UsableBandHz(data) / 447.2, 1.0, 0.08);
  for (auto& variance : data.variance) variance.setConstant(1.0);
  EXPECT_EQ(UsableBandHz(data), 0.0);
}

/// What a fit found: the nominal rig, changed by the test.
ModalResult Found() {
  ModalResult found{{},
                    {},
                    AssessStart(),
                    {},
                    {},
                    {},
                    {},
                    ToPhysical(AssessStart().frame, AssessStart().vector),
                    {},
                    {},
                    0.0};
  found.support.assign(5, {Support::kNotShown, 0.0, 0.0});
  found.support[1] = {Support::kShown, 250.0, 250.0};
  return found;
}

TEST(IdentifiedRig, HoldsMagnetsAndChainOfWhatWasFoundInItsKeys) {
  ModalResult found = Found();
  found.rig.ki_n_per_a = Eigen::Vector4d(44.0, 44.0, 36.0, 36.0);
  found.rig.ks_n_per_m = Eigen::Vector4d(1.3e5, 1.3e5, 0.9e5, 0.9e5);
  found.rig.gain = Eigen::Vector4d(1.02, 1.02, 0.97, 0.97);
  found.rig.delay_samples = 1.2;
  const configuration::RigFile rig = IdentifiedRig(Rig(), found, RotorForm::kShaft);
  EXPECT_EQ(rig.numbers.name, "flexible_rotor_identified");
  EXPECT_EQ(rig.plant.delay_samples, 1.2);
  // Read again as a start, the file gives the numbers back: ki = 4 k i0/s0^2, ks = 4 k i0^2/s0^3.
  const ModalStart again = StartFromRig(rig.plant, 5);
  const Physical read = ToPhysical(again.frame, again.vector);
  EXPECT_LT((read.ki_n_per_a - found.rig.ki_n_per_a).norm(), 1e-9);
  EXPECT_LT((read.ks_n_per_m - found.rig.ks_n_per_m).norm(), 1e-6);
  EXPECT_LT((read.gain - found.rig.gain).norm(), 1e-12);
  // Axes of a bearing are alike: the shown mode alone needs entries, frequency and damping.
  ASSERT_EQ(rig.plant.effects.size(), Rig().plant.effects.size() + 2);
  const auto& entry = rig.plant.effects[rig.plant.effects.size() - 2];
  EXPECT_EQ(entry.id, effect::Id::kModalFrequency);
  EXPECT_EQ(entry.mode, 2U);
}

TEST(IdentifiedRig, AnAxisThatDiffersHasItsRatioToTheMeanOfItsBearing) {
  ModalResult found = Found();
  found.rig.ki_n_per_a = Eigen::Vector4d(44.0, 40.0, 40.0, 40.0);
  const configuration::RigFile rig = IdentifiedRig(Rig(), found, RotorForm::kShaft);
  int seen = 0;
  for (const effect::EffectConfig& entry : rig.plant.effects) {
    if (entry.id != effect::Id::kCurrentGain) continue;
    ++seen;
    ASSERT_TRUE(entry.axes == 1U || entry.axes == 2U);
    EXPECT_NEAR(entry.values[0], (entry.axes == 1U ? 44.0 : 40.0) / 42.0, 1e-12);
  }
  EXPECT_EQ(seen, 2);
}

TEST(IdentifiedRig, AForceConstantThatNoMagnetHasIsRefusedWithItsBearing) {
  for (const bool current : {true, false}) {
    ModalResult found = Found();
    (current ? found.rig.ki_n_per_a : found.rig.ks_n_per_m).tail(2).setConstant(-5.0);
    try {
      (void)IdentifiedRig(Rig(), found, RotorForm::kShaft);
      FAIL() << "accepted";
    } catch (const BadInput& problem) {
      EXPECT_THAT(problem.what(), HasSubstr("of bearing nde are no magnet's"));
    }
  }
}

}  // namespace
}  // namespace levitas::identification
