// Every effect of the teeth on one page: the line of the pinion's motion that it adds, at which
// order, with which sign, and how much, against the complex 4-DOF model solved by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "plant_sim/effect/catalogue.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::test {
namespace {

using effect::Id;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kPinion_hz = 20.0;
constexpr double kGear_hz = 10.0;   // backwards
constexpr double kMesh_hz = 400.0;  // 20 teeth
constexpr double kPeriod_s = 1e-4;
const Complex kJ(0.0, 1.0);

/// A mean transmission error alone: it loads the teeth, nothing moves.
plant::PlantConfig Rig() {
  plant::PlantConfig rig = GearedRotor4();
  rig.gears[0].transmission_error = {{0, 10e-6, 0.3}};
  rig.gears[0].driving.runout_m = rig.gears[0].driven.runout_m = 0.0;
  return rig;
}
const Complex kMeanError_m = std::polar(10e-6, 0.3);

struct Forces {
  Complex pinion_n;
  Complex gear_n;
};

/// Pinion's answer at a signed frequency: m r'' + c r' + k r + Z (r_p - r_g) = forces, -Z on the
/// gear, Z = k_m + j w c_m; numbers of the rig.
Complex Answer(double frequency_hz, const Forces& forces, double mesh_n_per_m = 1e6,
               double mesh_n_s_per_m = 300.0) {
  const double w = kTwoPi * frequency_hz;
  const Complex z = mesh_n_per_m + kJ * w * mesh_n_s_per_m;
  const Complex p = 2.0e5 - 2.0 * w * w + kJ * w * 60.0 + z;
  const Complex g = 2.4e5 - 3.5 * w * w + kJ * w * 80.0 + z;
  return (g * forces.pinion_n + z * forces.gear_n) / (p * g - z * z);
}

/// Force pair of the teeth: towards the gear's place on the pinion, the opposite on the gear.
Forces Teeth(Complex force_n) { return {force_n, -force_n}; }

Complex MeshStiffness(double frequency_hz) { return {1e6, kTwoPi * frequency_hz * 300.0}; }

/// What the teeth carry at rest, as a relative displacement.
Complex StaticDelta() { return -kMeanError_m / (1.0 + 1e6 / 2.0e5 + 1e6 / 2.4e5); }

std::vector<Whirl> Steady(const plant::PlantConfig& rig) {
  const double speed = kTwoPi * kPinion_hz;
  plant::Plant plant(rig, 1);
  plant.SetSpeed(speed, 0.0);
  std::vector<Whirl> record;
  record.reserve(2000);               // two turns of the gear
  for (int n = 0; n < 17'000; ++n) {  // a start is gone to 1e-10 after 1.5 s
    if (n >= 15'000) record.push_back(At(plant));
    plant.Advance(Passive(speed));
  }
  return record;
}

struct Row {
  Id id{};
  bool on_driven{};
  std::array<double, effect::kMaxParameters> values{};
  const char* order{};
  double frequency_hz{};  ///< of the line that shows it; negative: backward
  Complex expected_m;     ///< of the pinion
  double tolerance{};     ///< relative
  double beside_hz{};     ///< where it adds nothing
};

std::ostream& operator<<(std::ostream& out, const Row& row) {
  return out << effect::At(row.id).name << " at " << row.order;
}

/// Line `order` of a Hann window one pitch to either side of tooth 0 of 40.
double CrackLine(int order) {
  const double pitch_rad = kTwoPi / 40.0;
  const double x = order * pitch_rad;
  const double share = x == 0.0 ? 1.0 : std::sin(x) / x;
  return share / 40.0 / (1.0 - std::pow(x / std::numbers::pi, 2));
}

// Forces taken as linear over substeps of 25 us: (w h)^2/12, 0.13 % at 800 Hz. Variation and crack
// are taken to first order: 0.1 and 1 % of the stiffness.
std::vector<Row> Table() {
  const Complex delta_m = StaticDelta();
  const Complex load_n = 1e6 * delta_m;
  const double w_p = kTwoPi * kPinion_hz;
  const double w_g = kTwoPi * kGear_hz;
  const Complex runout_p = std::polar(30e-6, 1.0);
  const Complex runout_g = std::polar(30e-6, 1.0);  // turns backwards: exp(j (-w t + 1))
  const Complex at_rest = Answer(0.0, Teeth(1e6 * kMeanError_m));
  const Complex n = std::polar(1.0, std::numbers::pi / 2.0 - 20.0 * std::numbers::pi / 180.0);
  const double normal_n = std::abs((load_n * std::conj(n)).real());
  return {
      {Id::kMeshStiffness,
       false,
       {7e5, 200.0},
       "mean",
       0.0,
       Answer(0.0, Teeth(7e5 * kMeanError_m), 7e5, 200.0) - at_rest,
       1e-6,
       kPinion_hz},
      // k a cos(2 w t): half of it at +2 x mesh.
      {Id::kMeshStiffnessVariation,
       false,
       {2.0, 1e-3, 0.0},
       "+2 and -2 x mesh",
       2.0 * kMesh_hz,
       Answer(2.0 * kMesh_hz, Teeth(-0.5e-3 * load_n)),
       0.005,
       kMesh_hz},
      {Id::kMeshStiffnessVariation,
       false,
       {2.0, 1e-3, 0.0},
       "+2 and -2 x mesh",
       -2.0 * kMesh_hz,
       Answer(-2.0 * kMesh_hz, Teeth(-0.5e-3 * load_n)),
       0.005,
       -kMesh_hz},
      // 10 um within half a gap of 20 um: the teeth carry nothing, the shaft stands straight.
      {Id::kBacklash, false, {40e-6}, "mean", 0.0, -at_rest, 1e-6, kMesh_hz},
      // A square wave: 4/pi of its first line, half of that on each side, -j of a sine.
      {Id::kMeshFriction,
       false,
       {0.01},
       "odd x mesh",
       kMesh_hz,
       Answer(kMesh_hz, Teeth(-0.01 * normal_n * kJ * n * (4.0 / std::numbers::pi) * 0.5 / kJ)),
       0.03,
       kPinion_hz},
      {Id::kTransmissionError,
       false,
       {-2.0, 5e-6, 0.4},
       "-2 x mesh",
       -2.0 * kMesh_hz,
       Answer(-2.0 * kMesh_hz, Teeth(MeshStiffness(-2.0 * kMesh_hz) * std::polar(5e-6, 0.4))),
       0.005,
       2.0 * kMesh_hz},
      {Id::kGearRunout,
       false,
       {30e-6, 1.0},
       "+1 x pinion",
       kPinion_hz,
       Answer(kPinion_hz, {(2.0 * w_p * w_p - MeshStiffness(kPinion_hz)) * runout_p,
                           MeshStiffness(kPinion_hz) * runout_p}),
       1e-4,
       -kPinion_hz},
      {Id::kGearRunout,
       true,
       {30e-6, 1.0},
       "-1 x gear",
       -kGear_hz,
       Answer(-kGear_hz, {MeshStiffness(-kGear_hz) * runout_g,
                          (3.5 * w_g * w_g - MeshStiffness(-kGear_hz)) * runout_g}),
       1e-4,
       kGear_hz},
      // The mean falls, and so does the load that it carries.
      {Id::kToothCrack,
       true,
       {0.01, 0.0},
       "mean",
       0.0,
       Answer(0.0, Teeth(0.01 * CrackLine(0) * load_n)),
       0.02,
       kGear_hz / 2.0},
      {Id::kToothCrack,
       true,
       {0.01, 0.0},
       "multiples of the gear",
       kGear_hz,
       Answer(kGear_hz, Teeth(0.01 * CrackLine(1) * load_n)),
       0.02,
       kGear_hz / 2.0},
      {Id::kToothCrack,
       true,
       {0.01, 0.0},
       "side bands of the mesh",
       kMesh_hz - 10.0 * kGear_hz,
       Answer(kMesh_hz - 10.0 * kGear_hz, Teeth(0.01 * CrackLine(30) * load_n)),
       0.02,
       kMesh_hz + kGear_hz / 2.0},
  };
}

class GearSignatureTable : public testing::TestWithParam<Row> {};

TEST_P(GearSignatureTable, IsFoundInThePlant) {
  static const std::vector<Whirl> nominal = Steady(Rig());
  const Row& row = GetParam();
  EXPECT_EQ(effect::At(row.id).place, effect::Place::kGear);
  plant::PlantConfig rig = Rig();
  effect::EffectConfig entry;
  entry.id = row.id;
  entry.values = row.values;
  entry.on_driven = row.on_driven;
  rig.effects = {entry};
  std::vector<Whirl> added = Steady(rig);
  for (std::size_t n = 0; n < added.size(); ++n) added[n].pinion -= nominal[n].pinion;
  const Complex found = Line(added, kPeriod_s, row.frequency_hz).pinion;
  // Amplitude and direction, so sign and phase, at once.
  EXPECT_LT(std::abs(found - row.expected_m), row.tolerance * std::abs(row.expected_m))
      << found << " " << row.expected_m;
  EXPECT_LT(std::abs(Line(added, kPeriod_s, row.beside_hz).pinion), 1e-3 * std::abs(found));
}

INSTANTIATE_TEST_SUITE_P(OfTheCatalogue, GearSignatureTable, testing::ValuesIn(Table()));

TEST(GearSignatureTable, HasARowForEveryIdOfTheGears) {
  std::set<Id> ids;
  for (const Row& row : Table()) ids.insert(row.id);
  for (const effect::Row& row : effect::Catalogue()) {
    EXPECT_EQ(ids.count(row.id), row.place == effect::Place::kGear ? 1U : 0U) << row.name;
  }
}

}  // namespace
}  // namespace levitas::test
