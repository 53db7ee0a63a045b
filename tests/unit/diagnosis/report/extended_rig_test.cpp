// The rig file with a cause switched on: read back strictly, it has the effect that was found.

#include "diagnosis/report/extended_rig.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <tuple>

#include "configuration/rig_file.hpp"
#include "diagnosis/report/calibrated_rig.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/crack.hpp"
#include "plant_sim/rotor/plane_shape.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

configuration::RigFile ReadBack(const DiagnosisResult& answer) {
  return configuration::ParseRig(ExtendedRig(answer, FlexibleRotor()), "extended_rig.yaml");
}

TEST(ExtendedRigTest, WithoutACauseIsTheNominalRig) {
  const DiagnosisResult answer = NothingFound();
  EXPECT_THAT(EffectEntries(answer), IsEmpty());
  EXPECT_EQ(configuration::WriteRig(ReadBack(answer)), configuration::WriteRig(FlexibleRotor()));
}

TEST(ExtendedRigTest, IsReadBackForEveryEffectAtEveryPlace) {
  const DiagnosisResult nothing = NothingFound();
  std::set<effect::Id> effects;
  for (const Hypothesis& h : MakeHypotheses(*nothing.view, nothing.terms)) {
    effects.insert(h.effect);
    const DiagnosisResult answer = Found(h.effect, h.place);
    const std::string text = ExtendedRig(answer, FlexibleRotor());
    EXPECT_THAT(text, Not(HasSubstr("not known to this build")))
        << effect::At(h.effect).name << " at " << h.place;
    const configuration::RigFile rig = configuration::ParseRig(text, "extended_rig.yaml");
    EXPECT_EQ(rig.plant.effects.size(), EffectEntries(answer).size()) << effect::At(h.effect).name;
    EXPECT_FALSE(rig.plant.effects.empty()) << effect::At(h.effect).name << " at " << h.place;
  }
  EXPECT_GT(effects.size(), 25U);
}

TEST(ExtendedRigTest, SaysThePresentEffectInTheUnitsOfTheFile) {
  const auto only = [](const DiagnosisResult& answer) {
    const auto entries = EffectEntries(answer);
    if (entries.size() != 1) throw std::runtime_error("not one entry");
    return entries.front();
  };
  // half of the prior standard deviation 0.15
  const effect::EffectConfig gain = only(Found(effect::Id::kCurrentGain, "nde_x"));
  EXPECT_EQ(gain.id, effect::Id::kCurrentGain);
  EXPECT_EQ(gain.axes, 0b0100U);
  EXPECT_EQ(gain.values[0], 1.075);
  // sqrt(tau) of 5e-3 s^0.5, half of it: 6.25 us
  EXPECT_THAT(ExtendedRig(Found(effect::Id::kEddyCurrent, "de_x"), FlexibleRotor()),
              HasSubstr("tau_us: 6.25\n"));
  EXPECT_EQ(only(Found(effect::Id::kEddyCurrent, "de_x")).values[1], 1.0);
  EXPECT_EQ(only(Found(effect::Id::kEddyCurrent, "de_x, current alone")).values[1], 0.0);
  // 5 N
  const effect::EffectConfig load = only(Found(effect::Id::kStaticLoad, "de_y"));
  EXPECT_EQ(load.values[1], 0.0);
  EXPECT_EQ(load.values[2], 2.5);
  // 0.05 rad
  const effect::EffectConfig turned = only(Found(effect::Id::kAxisRotation, "sensor nde"));
  EXPECT_EQ(turned.bearing, 1U);
  EXPECT_TRUE(turned.on_sensor);
  EXPECT_NEAR(turned.values[0], 0.025, 1e-7);
  // cosine and sine of 10e-6 kg m each: an eighth of a turn, sqrt(2) times one of them
  const effect::EffectConfig unbalance = only(Found(effect::Id::kUnbalance, "z 299.2 mm"));
  EXPECT_EQ(unbalance.values[0], 0.2992);
  EXPECT_NEAR(unbalance.values[1], 10e-6 * std::numbers::sqrt2, 1e-10);
  EXPECT_NEAR(unbalance.values[2], 0.25 * std::numbers::pi, 1e-9);
}

TEST(ExtendedRigTest, GivesACrackTheDepthThatSoftensTheShaftAsMuch) {
  const configuration::RigFile rig =
      ReadBack(Found(effect::Id::kBreathingCrack, "z 228.6 mm, direction 90.0 deg"));
  ASSERT_EQ(rig.plant.effects.size(), 1U);
  const auto& [z_m, depth, phase_rad] =
      std::tie(rig.plant.effects[0].values[0], rig.plant.effects[0].values[1],
               rig.plant.effects[0].values[2]);
  EXPECT_NEAR(z_m, 0.2286, 1e-6);
  EXPECT_NEAR(phase_rad, 0.5 * std::numbers::pi, 1e-3);
  // Half of the width 0.05: the first mode loses a fortieth of its stiffness w^2 = S k^2 where the
  // crack is open, k the curvature of the mode there.
  const RigView view(rig.numbers, rig.plant);
  const auto curvature = rotor::CurvatureAt(view.model->parameters().modes, z_m);
  constexpr double kDiameterM = 9.525e-3;
  const double stiffness_n_m2 =
      rig.plant.rotor.material.young_pa * std::numbers::pi / 64.0 * std::pow(kDiameterM, 4);
  const double softening_n_m2 = effect::CrackCompliance(depth, rig.plant.rotor.material.poisson) *
                                kDiameterM * stiffness_n_m2;
  // The cubic between two nodes knows the curvature to an eighth: thick elements shear.
  EXPECT_NEAR(softening_n_m2 * curvature[2] * curvature[2],
              0.025 * std::pow(view.omega_rad_per_s[2], 2),
              0.125 * 0.025 * std::pow(view.omega_rad_per_s[2], 2));
}

TEST(ExtendedRigTest, ChangesNothingButTheEffects) {
  configuration::RigFile rig = ReadBack(Found(effect::Id::kModalFrequency, "mode 2"));
  ASSERT_EQ(rig.plant.effects.size(), 1U);
  rig.plant.effects.clear();
  EXPECT_EQ(configuration::WriteRig(rig), configuration::WriteRig(FlexibleRotor()));
}

TEST(ExtendedRigTest, HoldsThePhaseUnderTheKeyAndWithTheDigitsThatAreTold) {
  DiagnosisResult answer = Found(effect::Id::kUnbalance, "z 299.2 mm");
  for (const std::size_t t : answer.answer.causes.front().terms) {
    answer.answer.extended.theta[t] = answer.terms[t].parameter == "sine" ? 7.3e-6 : -25.1e-6;
  }
  // 180 deg less atan(7.3/25.1)
  EXPECT_THAT(ExtendedRig(answer, FlexibleRotor()),
              AllOf(HasSubstr("# unbalance phase_deg[z 299.2 mm] = 163.78 deg"),
                    HasSubstr("phase_deg: 163.784\n"), HasSubstr("in all 10.")));
}

TEST(ExtendedRigTest, NamesTheParametersWithTheirIntervals) {
  const std::string text = ExtendedRig(Found(effect::Id::kCurrentGain, "de_x"), FlexibleRotor());
  // 1.075 and 1.645 standard deviations of 0.0075 either side
  EXPECT_THAT(text, HasSubstr("# current_gain"));
  EXPECT_THAT(text, HasSubstr("ratio[de_x] = 1.075 (1.063 to 1.087, 90 % interval)"));
}

TEST(CalibratedRigTest, IsReadBackWithWhatWasCalibratedAndTheCause) {
  DiagnosisResult answer = Found(effect::Id::kEddyCurrent, "de_x");
  for (std::size_t t = 0; t < answer.terms.size(); ++t) {
    const Term& term = answer.terms[t];
    if (!term.nuisance() || term.effect_name() == "eddy_current") continue;
    answer.answer.calibration.push_back({t, 0.5 * term.tolerance, 0.1 * term.tolerance});
  }
  const std::string text = CalibratedRig(answer, FlexibleRotor());
  EXPECT_THAT(text, Not(HasSubstr("not known to this build")));
  EXPECT_THAT(text, HasSubstr("# no key for shape of magnet de, mode 1: +0.01000"));
  const configuration::RigFile rig = configuration::ParseRig(text, "calibrated_rig.yaml");
  // Half a tolerance of 0.05 of a period.
  EXPECT_NEAR(rig.plant.delay_samples, FlexibleRotor().plant.delay_samples + 0.025, 1e-9);
  EXPECT_EQ(rig.plant.unbalance.size(), FlexibleRotor().plant.unbalance.size());
  EXPECT_NE(rig.plant.unbalance[0].moment_kg_m, FlexibleRotor().plant.unbalance[0].moment_kg_m);
  ASSERT_EQ(rig.plant.effects.size(), 1U + CalibratedEntries(answer).size());
  EXPECT_EQ(effect::At(rig.plant.effects[0].id).name, "eddy_current");
  EXPECT_GT(rig.plant.effects.size(), 40U);
}

}  // namespace
}  // namespace levitas::diagnosis
