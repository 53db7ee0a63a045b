// The number of an answer against the rig that was hidden from it.

#include "benchmark/accuracy/true_value.hpp"

#include <gtest/gtest.h>

#include "configuration/rig_file.hpp"
#include "tests/support/effect_entry.hpp"

namespace levitas::accuracy {
namespace {

using effect::Id;
using test::Entry;

class TrueValueTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::optional<double> Of(const std::string& effect, const std::string& key,
                                         const diagnosis::Location& location,
                                         double si = 1.0) const {
    diagnosis::NamedParameter p;
    p.effect = effect;
    p.key = key;
    p.location = location;
    p.si = si;
    return TrueValue(p, ground_truth_);
  }
  [[nodiscard]] diagnosis::Location Axis(std::size_t axis) const {
    return diagnosis::AtAxis(rig_.numbers, axis);
  }
  void Hide(const effect::EffectConfig& entry) {
    ground_truth_.hidden.push_back(entry);
    ground_truth_.truth.config.effects.push_back(entry);
  }
  void OffAnyway(const effect::EffectConfig& entry) {
    ground_truth_.truth.config.effects.push_back(entry);
  }

  configuration::RigFile rig_ =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  GroundTruth ground_truth_;
};

TEST_F(TrueValueTest, OfOneChannelHasNothingOfAnother) {
  Hide(Entry(Id::kCurrentGain, {0.8}, 0b0010));
  Hide(Entry(Id::kCurrentGain, {0.9}, 0b1000));
  EXPECT_DOUBLE_EQ(Of("current_gain", "ratio", Axis(3)).value_or(0.0), 0.9);
}

TEST_F(TrueValueTest, OfOneBearingHasNothingOfAnother) {
  for (const std::size_t bearing : {0U, 1U}) {
    auto entry = Entry(Id::kSensorPosition, {1e-3 * static_cast<double>(1 + bearing)});
    entry.bearing = bearing;
    Hide(entry);
  }
  EXPECT_DOUBLE_EQ(
      Of("sensor_position", "shift_mm", diagnosis::AtBearing(rig_.numbers, 1), 1e-3).value_or(0.0),
      2.0);
}

TEST_F(TrueValueTest, CombinesWhatIsHiddenWithWhatTheRigIsOffByAnyway) {
  OffAnyway(Entry(Id::kSensorGain, {1.02}, 0b0001));
  OffAnyway(Entry(Id::kSensorOffset, {3e-6}, 0b0001));
  Hide(Entry(Id::kSensorGain, {1.10}, 0b0001));
  Hide(Entry(Id::kSensorOffset, {-1e-6}, 0b0001));
  EXPECT_DOUBLE_EQ(Of("sensor_gain", "ratio", Axis(0)).value_or(0.0), 1.02 * 1.10);
  EXPECT_NEAR(Of("sensor_offset", "offset_um", Axis(0), 1e-6).value_or(0.0), 2.0, 1e-12);
}

TEST_F(TrueValueTest, OfOnePlaneHasNothingOfAnother) {
  Hide(Entry(Id::kStaticLoad, {0.13, 7.0, 5.0}));
  OffAnyway(Entry(Id::kStaticLoad, {0.40, -1.0, 0.5}));
  EXPECT_DOUBLE_EQ(Of("static_load", "force_x_n", Axis(0)).value_or(0.0), 7.0);
}

TEST_F(TrueValueTest, OfOneOrderHasNothingOfAnother) {
  Hide(Entry(Id::kSensorRunout, {2.0, 7e-6, 0.0}, 0b0001));
  OffAnyway(Entry(Id::kSensorRunout, {1.0, 1e-6, 0.0}, 0b0001));
  const auto at = [this](int order) { return diagnosis::AtOrderOf(rig_.numbers, order, 0); };
  EXPECT_NEAR(Of("sensor_runout", "amplitude_um", at(2), 1e-6).value_or(0.0), 7.0, 1e-9);
  EXPECT_FALSE(Of("sensor_runout", "amplitude_um", at(1), 1e-6).has_value());
  // An order is compared as a number: 2 is no part of 12.
  EXPECT_FALSE(Of("sensor_runout", "amplitude_um", at(12), 1e-6).has_value());
}

TEST_F(TrueValueTest, IsNotThereAtAPlaceWithoutTheEffect) {
  Hide(Entry(Id::kSensorGain, {1.10}, 0b0001));
  OffAnyway(Entry(Id::kSensorGain, {1.02}, 0b0100));
  EXPECT_FALSE(Of("sensor_gain", "ratio", Axis(2)).has_value());
}

}  // namespace
}  // namespace levitas::accuracy
