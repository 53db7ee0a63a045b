// Teeth as a diagnosis looks at them: lines of run-outs and errors, their rates, the direction that
// the force follows; what geared shafts add to the linear model.

#include "diagnosis/model/mesh_view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/model/train_coupling.hpp"
#include "diagnosis/model/turns.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

using Complex = std::complex<double>;

constexpr double kTurn = 2.0 * std::numbers::pi;

configuration::RigFile Geared() {
  return configuration::LoadRig(configuration::FindConfig("geared_rotor_4dof", "rigs"));
}

class MeshTest : public testing::TestWithParam<gear::Direction> {
 protected:
  MeshTest() {
    configuration::RigFile rig = Geared();
    rig.plant.gears.front().direction = GetParam();
    rig.plant.gears.front().pressure_angle_rad = 0.35;
    view_ = std::make_unique<RigView>(rig.numbers, rig.plant);
  }
  [[nodiscard]] const MeshView& mesh() const { return view_->meshes.front(); }

  std::unique_ptr<RigView> view_;
};

TEST_P(MeshTest, RateOfWhatTurnsIsTheDerivativeOfItsDisplacement) {
  constexpr double kSpeed = 140.0;
  constexpr double kStepS = 1e-7;
  for (const double angle : {0.0, 0.4, 2.9, 31.0}) {
    Complex delta, rate, before, after, ignored;
    mesh().Impose(angle, kSpeed, delta, rate);
    mesh().Impose(angle - kSpeed * kStepS, kSpeed, before, ignored);
    mesh().Impose(angle + kSpeed * kStepS, kSpeed, after, ignored);
    const Complex slope = (after - before) / (2.0 * kStepS);
    // The fifth harmonic of some 30 teeth: (5 x 30 x 140 x 1e-7)^2/6 is 7e-7 of the rate.
    EXPECT_LT(std::abs(rate - slope), 1e-5 * std::abs(rate)) << angle;
    EXPECT_GT(std::abs(rate), 0.0);
  }
}

TEST_P(MeshTest, TeethComeBackAfterAWholeRepeatAndNotBefore) {
  const double repeat = view_->model->train().turns_per_repeat;
  ASSERT_GT(repeat, 1.0);
  Complex here, there, rate;
  mesh().Impose(0.7, 100.0, here, rate);
  mesh().Impose(0.7 + kTurn * repeat, 100.0, there, rate);
  EXPECT_LT(std::abs(here - there), 1e-9 * std::abs(here));  // rounding of some 1e2 rad
  mesh().Impose(0.7 + kTurn, 100.0, there, rate);
  EXPECT_GT(std::abs(here - there), 1e-3 * std::abs(here));
}

TEST_P(MeshTest, DirectionIsAProjectionThatFollowsTheNormalUnlessTheMeshIsIsotropic) {
  const Complex along = 3e-6 * mesh().normal;
  const Complex across = Complex(0.0, 1.0) * along;
  EXPECT_NEAR(std::abs(mesh().normal), 1.0, 1e-12);
  EXPECT_LT(std::abs(mesh().Seen(along) - along), 1e-18);
  const Complex any(1e-6, -4e-6);
  EXPECT_LT(std::abs(mesh().Seen(mesh().Seen(any)) - mesh().Seen(any)), 1e-18);
  const bool isotropic = GetParam() == gear::Direction::kIsotropic;
  EXPECT_NEAR(std::abs(mesh().Seen(across)), isotropic ? 3e-6 : 0.0, 1e-18);
}

TEST_P(MeshTest, DisplacementIsThatOfTheShaftsOnTopOfWhatTurns) {
  Random random(4);
  std::vector<float> q(2 * view_->modes), v(2 * view_->modes), zero(2 * view_->modes, 0.0F);
  for (std::size_t i = 0; i < q.size(); ++i) {
    q[i] = static_cast<float>(1e-5 * random.Normal());
    v[i] = static_cast<float>(1e-3 * random.Normal());
  }
  const TeethMoment rest = mesh().At(1.1, 90.0, zero.data(), zero.data());
  const TeethMoment moved = mesh().At(1.1, 90.0, q.data(), v.data());
  Complex delta, rate;
  for (std::size_t i = 0; i < view_->modes; ++i) {
    delta += (mesh().driving.shape[i] - mesh().driven.shape[i]) *
             Complex(static_cast<double>(q[i]), static_cast<double>(q[view_->modes + i]));
    rate += (mesh().driving.shape[i] - mesh().driven.shape[i]) *
            Complex(static_cast<double>(v[i]), static_cast<double>(v[view_->modes + i]));
  }
  const Complex seen = mesh().Seen(delta);
  // Single precision of some 1e-5 m and 1e-2 m/s.
  EXPECT_NEAR(static_cast<double>(moved.delta_x_m - rest.delta_x_m), seen.real(), 1e-11);
  EXPECT_NEAR(static_cast<double>(moved.delta_y_m - rest.delta_y_m), seen.imag(), 1e-11);
  EXPECT_NEAR(static_cast<double>(moved.rate_x_m_per_s - rest.rate_x_m_per_s),
              mesh().Seen(rate).real(), 1e-7);
}

TEST_P(MeshTest, CouplingIsSymmetricAndGivesEnergyToNoMotion) {
  const TrainCoupling coupling = CouplingOf(*view_, {});
  for (const Eigen::MatrixXd& matrix : {coupling.stiffness, coupling.damping}) {
    ASSERT_EQ(matrix.rows(), static_cast<Eigen::Index>(2 * view_->modes));
    // Of mass-normalised modes; rounding of numbers of some 1e6.
    EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-9 * matrix.norm());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-9 * solver.eigenvalues().maxCoeff());
  }
}

TEST_P(MeshTest, AStifferMeshAddsItsSpringBetweenTheWheelsAndNothingElse) {
  LinearChange stiffer;
  stiffer.mesh[0].stiffness = 1.5;
  const Eigen::MatrixXd added =
      CouplingOf(*view_, stiffer).stiffness - CouplingOf(*view_, {}).stiffness;
  const auto n = static_cast<Eigen::Index>(view_->modes);
  // k d d^T along the normal, of both directions when isotropic; d the wheels' relative shape.
  Eigen::VectorXd along = Eigen::VectorXd::Zero(2 * n);
  Eigen::VectorXd across = along;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double d = mesh().shape[static_cast<std::size_t>(i)];
    along[i] = d * mesh().normal.real();
    along[n + i] = d * mesh().normal.imag();
    across[i] = -d * mesh().normal.imag();
    across[n + i] = d * mesh().normal.real();
  }
  Eigen::MatrixXd expected = along * along.transpose();
  if (mesh().isotropic) expected += across * across.transpose();
  expected *= 0.5 * mesh().stiffness_n_per_m;
  EXPECT_LT((added - expected).norm(), 1e-9 * expected.norm());
  EXPECT_EQ(CouplingOf(*view_, stiffer).damping, CouplingOf(*view_, {}).damping);
}

INSTANTIATE_TEST_SUITE_P(Directions, MeshTest,
                         testing::Values(gear::Direction::kIsotropic,
                                         gear::Direction::kLineOfAction),
                         [](const auto& p) {
                           return p.param == gear::Direction::kIsotropic ? "Isotropic" : "Line";
                         });

TEST(MeshViews, OfOneRotorAreNoneAndItHasNoCoupling) {
  EXPECT_TRUE(TheRig().meshes.empty());
  EXPECT_EQ(CouplingOf(TheRig(), {}).stiffness.size(), 0);
}

/// A record whose angles are wrapped into one turn; `missing` cycles are left out after row 50.
Record Turning(double speed_rad_per_s, std::uint64_t missing) {
  Record record;
  for (std::uint64_t n = 0; n < 200; ++n) {
    analysis::RecordedRow& row = record.rows.emplace_back();
    row.cycle = n < 50 ? n : n + missing;
    row.sample.speed_rad_per_s = speed_rad_per_s;
    const double total = 0.3 + speed_rad_per_s * 1e-4 * static_cast<double>(row.cycle);
    row.sample.angle_rad = total - kTurn * std::floor(total / kTurn);
  }
  return record;
}

struct Run {
  const char* name;
  double speed_rad_per_s;
  std::uint64_t missing;
};

class UnwrapTest : public testing::TestWithParam<Run> {};

TEST_P(UnwrapTest, AnglesGrowOnWithTheSpeedAcrossTurnsAndGaps) {
  const auto& [name, speed, missing] = GetParam();
  Record record = Turning(speed, missing);
  Unwrap(record, 1e-4);
  for (const auto& row : record.rows) {
    const double total = 0.3 + speed * 1e-4 * static_cast<double>(row.cycle);
    // Rounding of some hundred turns.
    EXPECT_NEAR(row.sample.angle_rad, total, 1e-9) << row.cycle;
  }
}

INSTANTIATE_TEST_SUITE_P(Runs, UnwrapTest,
                         testing::Values(Run{"Forward", 900.0, 0}, Run{"Backward", -900.0, 0},
                                         Run{"GapOfManyTurns", 900.0, 300}, Run{"AtRest", 0.0, 7}),
                         [](const auto& p) { return p.param.name; });

/// State of a rig that stood at 0.5 rad, was turned to an angle, and moved for twenty periods.
Eigen::VectorXd MovedFrom(const std::shared_ptr<const plant::PlantModel>& model, double angle_rad) {
  plant::Plant plant(model, 1);
  plant.PlaceAtRest({});
  plant.SetSpeed(0.0, 0.5);
  TurnTo(plant, 0.5, angle_rad);
  for (int n = 0; n < 20; ++n) plant.Advance({});
  const auto state = plant.state();
  return Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size()));
}

TEST(TurnTo, WheelsStandAlikeAfterAWholeRepeatAndOtherwiseAfterATurn) {
  const auto model = std::make_shared<const plant::PlantModel>(Geared().plant);
  const double repeat = model->train().turns_per_repeat;
  const double angle = kTurn * 3.0 + 1.25;
  const Eigen::VectorXd there = MovedFrom(model, angle);
  EXPECT_GT(there.norm(), 0.0);
  // The teeth's errors move the shafts; the same pose by way of a repeat differs by rounding.
  EXPECT_LT((MovedFrom(model, angle - kTurn * repeat) - there).norm(), 1e-8 * there.norm());
  EXPECT_LT((MovedFrom(model, angle + kTurn * repeat) - there).norm(), 1e-8 * there.norm());
  EXPECT_GT((MovedFrom(model, angle + kTurn) - there).norm(), 1e-4 * there.norm());
}

}  // namespace
}  // namespace levitas::diagnosis
