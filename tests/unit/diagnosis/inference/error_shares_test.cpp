// Shares of the rig file's error, for answers whose parts are known because they were put there.

#include "diagnosis/inference/error_shares.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kSize = 5e-6;  // [m]
constexpr std::size_t kDeX = 0, kDeY = 1;

/// Adds to the reading of one axis; at different frequencies two of them have nothing in common.
Term ReadingOf(effect::Id id, std::size_t axis, double hz) {
  return MakeReading({id, AtMode(0), "amplitude_m", "m"}, kSize, kSize,
                     [axis, hz](const SamplePoint& m, double theta, Contribution& out) {
                       out.reading_m[axis] += Sine(theta, hz, m.time_s);
                     });
}

/// Readings of nothing but noise, no current.
std::vector<Record> Noise() {
  Random random(5);
  Record record;
  record.rows.resize(8000);
  for (std::size_t n = 0; n < record.rows.size(); ++n) {
    analysis::RecordedRow& row = record.rows[n];
    row.cycle = n;
    row.levitated = true;
    row.sample.command.bias_current_a = TheRig().numbers.bias_current_a;
    for (std::size_t a = 0; a < TheRig().axes; ++a) {
      row.sample.position_m[a] = kNoise * random.Normal();
    }
  }
  return {record};
}

Hypothesis CauseOf(std::size_t term, const std::vector<Term>& terms) {
  Hypothesis cause;
  cause.effect = terms[term].effect.value();
  cause.place = "de_x";
  cause.terms = {term};
  cause.directions = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(terms.size()), 1);
  cause.directions(static_cast<Eigen::Index>(term), 0) = 1.0;
  return cause;
}

std::vector<ErrorShare> Shares(const std::vector<Term>& terms, const std::vector<double>& theta,
                               std::vector<Hypothesis> causes) {
  SearchResult answer;
  answer.extended = PointAt(terms, theta);
  answer.causes = std::move(causes);
  const std::vector<double> noise(TheRig().axes, kNoise);
  return ErrorShares(Search(TheRig(), terms), terms, answer, Noise(), noise);
}

// Three times as large: nine times the squared error.
TEST(ErrorShares, AreThoseOfTheSquaredErrorAndAddUpToOne) {
  const std::vector<Term> terms{ReadingOf(effect::Id::kEddyCurrent, kDeX, 310.0),
                                ReadingOf(effect::Id::kExtraDelay, kDeX, 330.0)};
  const auto shares = Shares(terms, {kSize, 3.0 * kSize}, {CauseOf(0, terms)});
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_EQ(shares[0].effect, effect::Id::kExtraDelay);
  EXPECT_EQ(shares[0].place, "") << "calibrated";
  EXPECT_NEAR(shares[0].share, 0.9, 0.03);
  EXPECT_EQ(shares[1].effect, effect::Id::kEddyCurrent);
  EXPECT_EQ(shares[1].place, "de_x") << "a cause";
  EXPECT_NEAR(shares[0].share + shares[1].share, 1.0, 0.01);
}

TEST(ErrorShares, OfANumberThatUndoesAnotherIsNegative) {
  const std::vector<Term> terms{ReadingOf(effect::Id::kEddyCurrent, kDeX, 310.0),
                                ReadingOf(effect::Id::kExtraDelay, kDeX, 310.0)};
  const auto shares = Shares(terms, {3.0 * kSize, -kSize}, {});
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_NEAR(shares[0].share, 1.5, 0.03);
  EXPECT_NEAR(shares[1].share, -0.5, 0.03);
}

TEST(ErrorShares, TakeTheCalibratedNumbersOfAnEffectTogetherAndLeaveOutWhatStayed) {
  const std::vector<Term> terms{ReadingOf(effect::Id::kEddyCurrent, kDeX, 310.0),
                                ReadingOf(effect::Id::kEddyCurrent, kDeY, 310.0),
                                ReadingOf(effect::Id::kExtraDelay, kDeX, 330.0)};
  const auto shares = Shares(terms, {kSize, kSize, 0.0}, {});
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_EQ(shares[0].effect, effect::Id::kEddyCurrent);
  EXPECT_NEAR(shares[0].share, 1.0, 0.01);
}

TEST(ErrorShares, OfAnAnswerThatChangesNothingAreNone) {
  const std::vector<Term> terms{ReadingOf(effect::Id::kEddyCurrent, kDeX, 310.0)};
  EXPECT_TRUE(Shares(terms, {0.0}, {}).empty());
}

// Samples that are lost or kept for validation say nothing of the fitted data.
TEST(ErrorShares, LookAtSamplesThatCount) {
  Trajectory from = NoiseRun(1, 100);
  Trajectory to = from;
  for (SamplePoint& m : to.moments) m.innovation_m[0] += static_cast<float>(2.0 * kNoise);
  for (std::size_t n = 0; n < 40; ++n) from.moments[n].counts = false;
  const std::vector<Trajectory> a{from};
  const std::vector<Trajectory> b{to};
  EXPECT_NEAR(ProjectedChange({a, b, a, b}, std::vector<double>(TheRig().axes, kNoise)), 240.0,
              0.1);
}

}  // namespace
}  // namespace levitas::diagnosis
