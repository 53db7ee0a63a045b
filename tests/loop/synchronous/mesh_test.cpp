// Gear mesh: the harmonics that a PD law leaves, by blocks at the teeth's orders.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/synchronous/notch_loop.hpp"

namespace levitas::test {
namespace {

using synchronous::BlockState;
using synchronous::Target;

constexpr double kTeeth = 20.0;  // of the pinion, whose shaft's angle is measured

struct GearedRig {
  explicit GearedRig(const std::string& name)
      : file(configuration::LoadRig(SourceFolder() + "/config/rigs/" + name + ".yaml")),
        controller(configuration::LoadController(
            configuration::FindConfig(file.run.controller, "controllers"), file.numbers)) {}
  configuration::RigFile file;
  configuration::ControllerFile controller;

  [[nodiscard]] cycle::CycleConfig With(const std::vector<double>& orders) const {
    cycle::CycleConfig config{file.numbers, controller.law, controller.supervisor, {}};
    for (const double order : orders) {
      auto request = Asked(Target::kVibration, 840.0, 1800.0, 0.3, order);
      request.block.largest_current_a = 1.0;
      request.block = design::WithInverse(file, controller.law, request);
      config.synchronous.blocks.push_back(request.block);
    }
    return config;
  }
};

struct Lines {
  double rms_m{};
  std::vector<double> line_m;
};

Lines Listen(const cycle::CycleConfig& config, const GearedRig& rig, double hz,
             const std::vector<double>& orders) {
  ClosedLoop loop(config, rig.file.plant);
  EXPECT_TRUE(loop.Levitate());
  loop.SpinAt(60.0 * hz);
  loop.Run(4.0);
  EXPECT_EQ(loop.out.fault, Fault::kNone);
  for (std::size_t k = 0; k < config.synchronous.blocks.size(); ++k) {
    EXPECT_EQ(loop.out.synchronous[k].state, BlockState::kActing)
        << "order " << config.synchronous.blocks[k].order << " at " << hz << " Hz";
  }
  constexpr int kSamples = 10'000;
  std::vector<AxisArray> seen;
  AxisArray mean{};
  for (int n = 0; n < kSamples; ++n) {
    seen.push_back(loop.plant.SensorOutput());
    for (std::size_t i = 0; i < 4; ++i) mean[i] += seen.back()[i] / kSamples;
    (void)loop.Step();
  }
  Lines found;
  for (const AxisArray& at : seen) {
    for (std::size_t i = 0; i < 4; ++i) {
      found.rms_m += (at[i] - mean[i]) * (at[i] - mean[i]) / (4.0 * kSamples);
    }
  }
  found.rms_m = std::sqrt(found.rms_m);
  for (const double order : orders) {
    found.line_m.push_back(Measure(loop, 100, order).position_m);
  }
  return found;
}

class Mesh : public testing::TestWithParam<const char*> {};

TEST_P(Mesh, LinesThatTheCoilsReachGoDownByTwentyDecibelsAndMore) {
  const GearedRig rig(GetParam());
  for (const double hz : {15.0, 22.0, 29.0}) {
    // The third harmonic asks for more than the coils leave above 15 Hz.
    std::vector<double> orders{kTeeth};
    if (hz < 29.0) orders.push_back(2.0 * kTeeth);
    if (hz < 16.0) orders.push_back(3.0 * kTeeth);
    const Lines plain = Listen(rig.With({}), rig, hz, orders);
    const Lines quiet = Listen(rig.With(orders), rig, hz, orders);
    for (std::size_t k = 0; k < orders.size(); ++k) {
      EXPECT_LT(quiet.line_m[k], 0.1 * plain.line_m[k])
          << "order " << orders[k] << " at " << hz << " Hz: " << 1e6 * plain.line_m[k] << " um";
    }
  }
}

TEST_P(Mesh, WithTheShaftsOwnOrdersMostOfTheVibrationIsGone) {
  const GearedRig rig(GetParam());
  const std::vector<double> orders{0.5, 1.0, kTeeth};  // the gear turns half as fast
  const Lines plain = Listen(rig.With({}), rig, 22.0, orders);
  const Lines quiet = Listen(rig.With(orders), rig, 22.0, orders);
  EXPECT_LT(quiet.rms_m, 0.2 * plain.rms_m)
      << 1e6 * plain.rms_m << " to " << 1e6 * quiet.rms_m << " um rms";
}

INSTANTIATE_TEST_SUITE_P(OfGearedRotors, Mesh,
                         testing::Values("geared_rotor_4dof", "geared_rotor_8dof",
                                         "geared_rotor_12dof"));

}  // namespace
}  // namespace levitas::test
