#include "benchmark/gears/spinning_rig.hpp"

#include <cmath>

#include "plant_sim/plant/command_of.hpp"

namespace levitas::gears {
namespace {

constexpr double kLiftS = 5.0;

}  // namespace

SpinningRig::SpinningRig(const config::RigFile& rig, const cycle::CycleConfig& config)
    : period_s_(rig.numbers.period_s()),
      ramp_rad_per_s2_(rig.plant.drive.max_acceleration_rad_per_s2),
      plant_(rig.plant, 1),
      control_(config) {
  plant_.RestInTouchdown();
}

void SpinningRig::SpinAt(double speed_rad_per_s, double settle_s) {
  Step({.command = OperatorCommand::kLift});
  for (long n = PeriodsOf(kLiftS); n > 0 && out_.mode != Mode::kLevitating; --n) Step();
  Step({.command = OperatorCommand::kSpin,
        .speed_rad_per_s = speed_rad_per_s,
        .acceleration_rad_per_s2 = ramp_rad_per_s2_});
  for (long n = PeriodsOf(speed_rad_per_s / ramp_rad_per_s2_ + settle_s); n > 0; --n) Step();
}

void SpinningRig::Step(const cycle::OperatorInput& op) {
  ++in_.cycle;
  in_.frame_present = true;
  in_.frame = plant_.Sample();
  in_.op = op;
  out_ = control_.Step(in_);
  plant_.Advance(plant::CommandOf(out_.current));
}

long SpinningRig::PeriodsOf(double seconds) const noexcept {
  return std::lround(seconds / period_s_);
}

}  // namespace levitas::gears
