// Every effect on one page: what it changes, in which place, at which order, with which sign, and
// how much, from closed forms. Each is studied further in the tests named after it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>
#include <vector>

#include "tests/loop/effects/signature_probes.hpp"
#include "tests/loop/effects/signature_row.hpp"

namespace levitas::plant::test {
namespace {

using effect::Id;
using effect::Place;

constexpr double kZ_m = 0.23;  // between the bearings
constexpr double kExact = 1e-9;

std::vector<SignatureRow> TimingAndAmplifiers() {
  // A tone of 100 Hz in commands held for 100 us; the first-order lag seen at the samples is
  // (1 - d)/(z - d), d = exp(-2 pi B T).
  const auto lag_rad = [](double bandwidth_hz) {
    const double d = std::exp(-kTwoPi * bandwidth_hz * kPeriod_s);
    return std::arg((1.0 - d) / (std::polar(1.0, kTwoPi * kTone_hz * kPeriod_s) - d));
  };
  return {
      {Id::kExtraDelay, Place::kTiming, "1f", -1,
       [] { return std::arg(ToneRatio(Entry(Id::kExtraDelay, {kPeriod_s}))); },
       -kTwoPi * kTone_hz * kPeriod_s, kExact,
       [] { return std::abs(ToneRatio(Entry(Id::kExtraDelay, {kPeriod_s}))) - 1.0; }},
      // 1800 bursts: 2.4 % of their number, times 4.
      {Id::kDroppedSamples, Place::kTiming, "random", 1,
       [] {
         return HeldShare(Entry(Id::kDroppedSamples, {0.05, 3.0}));
       },
       0.05 * 3.0 / (1.0 + 0.05 * 2.0), 0.1, nullptr},
      // 4000 samples: 1.1 % of their deviation, times 4.
      {Id::kSampleJitter, Place::kTiming, "random", 1,
       [] { return MovingReadingRms(Entry(Id::kSampleJitter, {5e-6}), 5e-4); }, 5e-6 * 5e-4, 0.045,
       [] { return MovingReadingRms(Entry(Id::kSampleJitter, {5e-6}), 0.0) / 2.5e-9; }},
      {Id::kAmplifierBandwidth, Place::kAmplifier, "1f", -1,
       [] { return std::arg(ToneRatio(Entry(Id::kAmplifierBandwidth, {300.0}))); },
       lag_rad(300.0) - lag_rad(720.0), kExact, nullptr},
      // All slope: a triangle, whose third harmonic is 1/9, of the other sign. Near the tips the
      // law of the amplifier rounds it off within 9 mA of 100 mA.
      {Id::kAmplifierSlew, Place::kAmplifier, "3f", 1,
       [] { return ThirdHarmonic(Entry(Id::kAmplifierSlew, {40.0}), 0.9); }, 1.0 / 9.0, 0.05,
       [] { return ThirdHarmonic(Entry(Id::kAmplifierSlew, {40.0}), 0.01); }},
  };
}

std::vector<SignatureRow> Magnets() {
  const double knee_a = 1.3;
  const auto flux_a = [knee_a](double i) {
    return i / std::pow(1.0 + std::pow(i / knee_a, 4.0), 0.25);
  };
  const auto saturated_n = [flux_a](double i) {
    return kKi_n_per_a / 4.0 * (std::pow(flux_a(1.0 + i), 2) - std::pow(flux_a(1.0 - i), 2));
  };
  const std::complex<double> root = std::sqrt(std::complex<double>(0.0, kTwoPi * kTone_hz * 2e-4));
  return {
      {Id::kCurrentGain, Place::kAmplifier, "1f", -1,
       [] {
         return ForceOf(Entry(Id::kCurrentGain, {0.8}), 0.2, 0.0)[0] / (kKi_n_per_a * 0.2) - 1;
       },
       -0.2, kExact,
       [] {
         return ForceOf(Entry(Id::kCurrentGain, {0.8}), 0.0, 2e-5)[0] / ForceOf({}, 0.0, 2e-5)[0] -
                1.0;
       }},
      {Id::kCommandOffset, Place::kAmplifier, "static", 1,
       [] { return ForceLeft(Entry(Id::kCommandOffset, {0.03})); }, kKi_n_per_a * 0.03, kExact,
       [] { return std::abs(ToneRatio(Entry(Id::kCommandOffset, {0.03}))) - 1.0; }},
      {Id::kForceConstant, Place::kMagnet, "1f", -1,
       [] {
         return ForceOf(Entry(Id::kForceConstant, {0.8}), 0.2, 0.0)[0] / (kKi_n_per_a * 0.2) - 1;
       },
       -0.2, kExact,
       [] {  // ki/ks stays, unlike with a current gain
         const auto entry = Entry(Id::kForceConstant, {0.8});
         return ForceOf(entry, 0.0, 2e-5)[0] / ForceOf({}, 0.0, 2e-5)[0] -
                ForceOf(entry, 0.2, 0.0)[0] / ForceOf({}, 0.2, 0.0)[0];
       }},
      {Id::kMagneticCoupling, Place::kMagnet, "1f", 1,
       [] { return ForceOf(Entry(Id::kMagneticCoupling, {0.1}), 0.2, 0.0)[1]; },
       0.1 * kKi_n_per_a * 0.2, kExact,
       [] {  // a displacement makes none
         return ForceOf(Entry(Id::kMagneticCoupling, {0.1}), 0.0, 2e-5)[1];
       }},
      {Id::kDisplacementStiffness, Place::kMagnet, "static", 1,
       [] {
         const auto entry = Entry(Id::kDisplacementStiffness, {1.25});
         return (ForceOf(entry, 0.0, 2e-5)[0] - ForceOf({}, 0.0, 2e-5)[0]) / (kKs_n_per_m * 2e-5);
       },
       0.25, kExact,
       [] {
         return ForceOf(Entry(Id::kDisplacementStiffness, {1.25}), 0.2, 0.0)[0] /
                    (kKi_n_per_a * 0.2) -
                1.0;
       }},
      {Id::kCoilAsymmetry, Place::kMagnet, "static, 2f", 1,
       [] { return ForceOf(Entry(Id::kCoilAsymmetry, {1.2}), 0.0, 0.0)[0]; },
       0.2 / 2.2 * kKi_n_per_a / 2.0, kExact,
       [] {  // the odd part, ki ic, stays
         const auto entry = Entry(Id::kCoilAsymmetry, {1.2});
         return (ForceOf(entry, 0.2, 0.0)[0] - ForceOf(entry, -0.2, 0.0)[0]) / (0.4 * kKi_n_per_a) -
                1.0;
       }},
      {Id::kMagneticSaturation, Place::kMagnet, "3f", -1,
       [] {  // what an odd force has beyond a straight line
         const auto entry = Entry(Id::kMagneticSaturation, {1.3, 4.0});
         return ForceOf(entry, 0.6, 0.0)[0] - 2.0 * ForceOf(entry, 0.3, 0.0)[0];
       },
       saturated_n(0.6) - 2.0 * saturated_n(0.3), kExact,
       [] {
         return ForceOf(Entry(Id::kMagneticSaturation, {1.3, 4.0}), 0.0, 0.0)[0];
       }},
      {Id::kHysteresis, Place::kMagnet, "remanence", 1,
       [] {
         return ForceLeft(Entry(Id::kHysteresis, {0.03, 0.0}));
       },
       kKi_n_per_a * 0.03, kExact, [] { return ForceLeft({}) / (kKi_n_per_a * 0.03); }},
      // 1/(1 + sqrt(s tau)); the bank of lags is within 0.6 % of it, of a phase of 0.2 rad.
      {Id::kEddyCurrent, Place::kMagnet, "1f", -1,
       [] {
         return std::arg(ForceToneRatio(Entry(Id::kEddyCurrent, {2e-4, 1.0})));
       },
       -std::arg(1.0 + root), 0.04, nullptr},
      {Id::kAxisRotation, Place::kMagnet, "1f across", 1,
       [] { return ForceOf(Entry(Id::kAxisRotation, {0.1}), 0.2, 0.0)[1] / (kKi_n_per_a * 0.2); },
       std::sin(0.1), kExact, [] { return ForceOf(Entry(Id::kAxisRotation, {0.1}), 0.2, 0.0)[3]; }},
  };
}

std::vector<SignatureRow> Sensors() {
  const auto unfelt = [](const effect::EffectConfig& entry) {
    return [entry] { return RotorFeels(entry); };
  };
  const auto gain = Entry(Id::kSensorGain, {1.1});
  const auto offset = Entry(Id::kSensorOffset, {15e-6});
  const auto bent = Entry(Id::kSensorNonlinearity, {500.0, 0.0});
  const auto slow = Entry(Id::kSensorBandwidth, {800.0});
  const auto moved = Entry(Id::kSensorPosition, {0.012});
  const auto runout = Entry(Id::kSensorRunout, {1.0, 5e-6, 0.4});
  const auto mains = Entry(Id::kMainsPickup, {50.0, 2e-6, 0.5});
  const auto noise = Entry(Id::kSensorNoise, {3e-6, 0.0});
  return {
      {Id::kSensorGain, Place::kSensor, "1f", 1,
       [=] { return ReadingOf(gain, 2e-5, 0.0)[0] / 2e-5 - 1.0; }, 0.1, kExact, unfelt(gain)},
      {Id::kSensorOffset, Place::kSensor, "static", 1,
       [=] { return ReadingOf(offset, 0.0, 0.0)[0]; }, 15e-6, kExact, unfelt(offset)},
      {Id::kSensorNonlinearity, Place::kSensor, "2f", 1,
       [=] { return 0.5 * (ReadingOf(bent, 2e-5, 0.0)[0] + ReadingOf(bent, -2e-5, 0.0)[0]); },
       500.0 * 4e-10, 1e-8, unfelt(bent)},  // two readings of 20 um make one of 0.2
      {Id::kSensorBandwidth, Place::kSensor, "1f", -1,
       [=] { return StepReading(slow) / StepReading({}) - 1.0; },
       std::expm1(-kTwoPi * 0.08) / std::expm1(-kTwoPi * 0.5) - 1.0, kExact, unfelt(slow)},
      {Id::kSensorPosition, Place::kSensor, "static", 1,
       [=] { return ReadingOf(moved, 0.0, 1e-4)[0] - ReadingOf({}, 0.0, 1e-4)[0]; },
       0.012 * 1e-4 / (0.3996 - 0.1299), 1e-8, unfelt(moved)},  // slope of 0.1 mm between magnets
      // Linear between substeps of 25 us: (W h)^2/12.
      {Id::kSensorRunout, Place::kSensor, "+1x", 1,
       [=] { return std::abs(OrbitLine(runout, 1) - OrbitLine({}, 1)); },
       5e-6 / std::abs(std::complex<double>(1.0, 100.0 / 5000.0)), 3e-4,
       [=] {
         return std::max(0.0, std::abs(OrbitLine(runout, -1) - OrbitLine({}, -1)) / 5e-6 - 3e-4);
       }},
      {Id::kMainsPickup, Place::kSensor, "50 Hz", 1,
       [=] { return ToneOfReading(mains, 50.0, 0.5); }, 2e-6, kExact, unfelt(mains)},
      // 20 000 samples: 0.5 %, times 4.
      {Id::kSensorNoise, Place::kSensor, "random", 1, [=] { return StandingReadingRms(noise); },
       3e-6, 0.02, unfelt(noise)},
  };
}

std::vector<SignatureRow> TurningForces() {
  const auto unbalance = Entry(Id::kUnbalance, {kZ_m, 20e-6, 0.7});
  const auto bow = Entry(Id::kShaftBow, {20e-6, -0.4});
  const auto anisotropy = Entry(Id::kShaftAnisotropy, {0.05, 0.3});
  // Shallow: a deep one takes away less than in proportion to its opening, which adds orders.
  const auto crack = Entry(Id::kBreathingCrack, {kZ_m, 0.01, 0.0});
  const auto misaligned = Entry(Id::kMisalignment, {0.0, -3.0, 1.5, 0.2});
  const double w = Quiet()->frequency()[2];
  const double largest = Quiet()->parameters().modes.shapes.col(2).cwiseAbs().maxCoeff();
  const double load_rad = Quiet()->config().gravity_direction_rad;
  const auto line = [](const effect::EffectConfig& entry, int order, double phase_rad) {
    return (ForceLine(entry, order) * std::polar(1.0, -phase_rad)).real();
  };
  // Lines of the same force at all other orders up to 4.
  const auto beside = [load_rad](const effect::EffectConfig& entry, const std::set<int>& its) {
    const double direction_rad = entry.id == Id::kBreathingCrack ? load_rad : 0.0;
    return [entry, its, direction_rad] {
      double most = 0.0;
      for (int order = -4; order <= 4; ++order) {
        if (its.count(order) > 0) continue;
        most = std::max(most, std::abs(ForceLine(entry, order, direction_rad)));
      }
      return most / std::abs(ForceLine(entry, *its.begin(), direction_rad));
    };
  };
  return {
      {Id::kUnbalance, Place::kRotor, "+1x", Sign(ShapeOf(kZ_m)),
       [=] { return line(unbalance, 1, 0.7); }, ShapeOf(kZ_m) * 20e-6 * kSpeed * kSpeed, kExact,
       beside(unbalance, {1})},
      {Id::kShaftBow, Place::kRotor, "+1x", 1, [=] { return line(bow, 1, -0.4); },
       w * w * 20e-6 / largest, kExact, beside(bow, {1})},
      {Id::kShaftAnisotropy, Place::kRotor, "+2x", -1, [=] { return line(anisotropy, 2, 0.6); },
       -0.05 * w * w * kBent, kExact, beside(anisotropy, {2})},
      // Open by (1 + cos a)/2, softer by cos a towards itself, a from the load; of a shaft that is
      // bent along the load: 1, 2, 2, 2, 1 eighths at -1, 0, 1, 2, 3 times rotation, and the mean
      // one bends it further.
      {Id::kBreathingCrack, Place::kRotor, "-1x to +3x", 1,
       [=] {
         return (ForceLine(crack, 0, load_rad) * std::polar(1.0, -load_rad)).real() /
                std::abs(ForceLine(crack, 3, load_rad));
       },
       2.0, 1e-4, beside(crack, {-1, 0, 1, 2, 3})},
      {Id::kMisalignment, Place::kExternal, "-3x", Sign(ShapeOf(0.0)),
       [=] { return line(misaligned, -3, 0.2); }, ShapeOf(0.0) * 1.5, kExact,
       beside(misaligned, {-3})},
      {Id::kStaticLoad, Place::kExternal, "static", Sign(ShapeOf(kZ_m)),
       [=] {
         return line(Entry(Id::kStaticLoad, {kZ_m, 5.0, 0.0}), 0, 0.0);
       },
       5.0 * ShapeOf(kZ_m), kExact, beside(Entry(Id::kStaticLoad, {kZ_m, 5.0, 0.0}), {0})},
      {Id::kCouplingStiffness, Place::kExternal, "static", -1,
       [=] {
         return line(Entry(Id::kCouplingStiffness, {0.0, 2e4, 0.0}), 0, 0.0);
       },
       -2e4 * ShapeOf(0.0) * ShapeOf(0.0) * kBent, kExact, nullptr},
      {Id::kCrossCoupledStiffness, Place::kExternal, "static across", 1,
       [=] {
         return ForceLine(Entry(Id::kCrossCoupledStiffness, {kZ_m, 5e3}), 0).imag();
       },
       5e3 * ShapeOf(kZ_m) * ShapeOf(kZ_m) * kBent, kExact, nullptr},
      {Id::kInternalDamping, Place::kRotor, "static across", 1,
       [=] {
         return ForceLine(Entry(Id::kInternalDamping, {kZ_m, 20.0}), 0).imag();
       },
       20.0 * kSpeed * ShapeOf(kZ_m) * ShapeOf(kZ_m) * kBent, kExact, nullptr},
      {Id::kTouchdownRub, Place::kSupport, "static", -1, [=] { return RubForce(30e-6); },
       -2e5 * 10e-6, kExact, [=] { return RubForce(19e-6); }},
  };
}

std::vector<SignatureRow> Modes() {
  const double w = Quiet()->frequency()[2];
  const double zeta = Quiet()->damping_ratio()[2];
  const double to_damped = std::sqrt(1.0 - zeta * zeta);
  // Poles of the free rotor beside magnets without bias: 1e-9 A leaves 1e-13 N/m.
  return {
      {Id::kModalFrequency, Place::kRotor, "pole", 1,
       [=] {
         return FreePole(Entry(Id::kModalFrequency, {95.0}), kTwoPi * 95.0).imag() -
                FreePole({}, w).imag();
       },
       (kTwoPi * 95.0 - w) * to_damped, 1e-7, nullptr},
      {Id::kModalDamping, Place::kRotor, "pole", -1,
       [=] { return FreePole(Entry(Id::kModalDamping, {0.02}), w).real(); }, -0.02 * w, 1e-7,
       nullptr},
      {Id::kGyroscopicInertia, Place::kRotor, "forward and backward", 1,
       [] { return GyroscopicForce(kSpeed) / 0.5; },
       kSpeed * Quiet()->parameters().modes.gyroscopic(1, 1), kExact,
       [] { return GyroscopicForce(0.0); }},
      {Id::kRotorMass, Place::kRotor, "rigid-body line", -1,
       [] { return RigidLine(Entry(Id::kRotorMass, {1.2})) / RigidLine({}) - 1.0; },
       1.0 / 1.2 - 1.0, kExact, nullptr},
      {Id::kSupportMode, Place::kSupport, "pole", 1,
       [] {
         return FreePole(Entry(Id::kSupportMode, {5.0, 160.0, 0.02}), kTwoPi * 160.0).imag();
       },
       kTwoPi * 160.0 * std::sqrt(1.0 - 0.02 * 0.02), 1e-6, nullptr},
  };
}

std::vector<SignatureRow> Table() {
  std::vector<SignatureRow> rows;
  for (const auto& part : {TimingAndAmplifiers(), Magnets(), Sensors(), TurningForces(), Modes()}) {
    rows.insert(rows.end(), part.begin(), part.end());
  }
  return rows;
}

class SignatureTable : public testing::TestWithParam<SignatureRow> {};

TEST_P(SignatureTable, IsFoundInThePlant) {
  const SignatureRow& row = GetParam();
  EXPECT_EQ(effect::At(row.id).place, row.place);
  const double found = row.found();
  EXPECT_NEAR(found, row.expected, row.tolerance * std::abs(row.expected)) << row.order;
  EXPECT_EQ(Sign(found), row.sign) << row.order;
  if (row.beside) {
    EXPECT_LT(std::abs(row.beside()), row.tolerance) << "what it must leave alone";
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheCatalogue, SignatureTable, testing::ValuesIn(Table()),
                         [](const auto& test_info) {
                           return std::string(effect::At(test_info.param.id).name);
                         });

TEST(SignatureTable, HasOneRowForEveryIdOutsideTheGears) {
  std::multiset<Id> rows;
  for (const SignatureRow& row : Table()) rows.insert(row.id);
  for (const Id id : AllIds()) EXPECT_EQ(rows.count(id), 1U) << effect::At(id).name;
  EXPECT_EQ(rows.size(), AllIds().size());
}

}  // namespace
}  // namespace levitas::plant::test
