// What sensors that the rig does not have would show of a load, against the slope of its term.

#include "diagnosis/isolability/sensors_beside.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/effect_entry.hpp"
#include "tests/unit/diagnosis/hum.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kMiddleProbes = 0;
constexpr std::size_t kBesideRows = 4'000;  // 3000 of them settle

/// Taking slopes is a run of the model for each term: once for all tests.
const HealthyModel& QuietModel() {
  static const HealthyModel kModel(WeightlessRotor(), {HumRecord(0.0, kBesideRows)}, false,
                                   Judging{}, 50e-6);
  return kModel;
}

const SensorsBeside& Beside() {
  static const SensorsBeside kSensors(QuietModel());
  return kSensors;
}

LinearProblem EmptySignature() {
  const auto terms = static_cast<Eigen::Index>(QuietModel().terms().size());
  LinearProblem empty;
  empty.jtj = Eigen::MatrixXd::Zero(terms, terms);
  empty.jte = Eigen::VectorXd::Zero(terms);
  return empty;
}

Eigen::Index LoadOnDeX() {
  const std::vector<Term>& terms = QuietModel().terms();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].effect == effect::Id::kStaticLoad && terms[i].location.axis == 0U) {
      return static_cast<Eigen::Index>(i);
    }
  }
  throw std::runtime_error("no term of a load on de_x");
}

// The magnets stand at 129.9 and 399.6 mm: 264.75 mm between them.
TEST(SensorsBeside, NamesItsProbesAndWhereTheyStand) {
  ASSERT_EQ(Beside().size(), 2U);
  EXPECT_EQ(Beside().what(0), "displacement probes in x and y at 265 mm");
  EXPECT_EQ(Beside().what(1), "probes of the control current of every axis");
}

TEST(SensorsBeside, AHealthyRigShowsNothingThroughThem) {
  for (std::size_t sensor = 0; sensor < Beside().size(); ++sensor) {
    LinearProblem signature = EmptySignature();
    Beside().Add(sensor, {}, signature);
    EXPECT_EQ(signature.ete, 0.0);
    EXPECT_EQ(signature.jte.norm(), 0.0);
  }
}

// The load of the plant and that of the term are written apart. With slopes J of readings less
// model, per scale, a fault of `share` of the scale has s = -share J: J^T s = -share J^T J and
// s^T s = share^2 J^T J.
TEST(SensorsBeside, ALoadIsSeenInTheMiddleAsItsOwnTermSaysIt) {
  constexpr double kShareOfScale = 0.1;
  const Eigen::Index term = LoadOnDeX();
  const double force_n =
      kShareOfScale * QuietModel().terms()[static_cast<std::size_t>(term)].scale();
  const double z_m = WeightlessRotor().plant.bearings[0].actuator_z_m;
  LinearProblem signature = EmptySignature();
  Beside().Add(kMiddleProbes, {test::Entry(effect::Id::kStaticLoad, {z_m, force_n, 0.0})},
               signature);
  const double square = signature.jtj(term, term);
  ASSERT_GT(square, 0.0);
  // Differences of runs in single precision; what the two loads have in common is all but rounding.
  EXPECT_NEAR(signature.jte[term] / square, -kShareOfScale, 0.01 * kShareOfScale);
  EXPECT_NEAR(signature.ete / square, kShareOfScale * kShareOfScale,
              0.02 * kShareOfScale * kShareOfScale);
}

}  // namespace
}  // namespace levitas::diagnosis
