#include "benchmark/gears/spinning_rig.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "plant_sim/plant/command_of.hpp"

namespace levitas::gears {
namespace {

constexpr double kLiftS = 5.0;

}  // namespace

long PeriodsOf(const configuration::RigFile& rig, double seconds) {
  return std::lround(seconds / rig.numbers.period_s());
}

void RefuseBeyondDrive(const configuration::RigFile& rig, double speed_rad_per_s) {
  const double most = rig.numbers.max_speed_rad_per_s;
  if (speed_rad_per_s <= most) return;
  throw BadInput(fmt::format("{}: {:g} rpm is beyond its drive, allowed {:g} rpm ({:g} Hz)",
                             rig.numbers.name, RadPerSToRpm(speed_rad_per_s), RadPerSToRpm(most),
                             most / kTwoPi));
}

SpinningRig::SpinningRig(const configuration::RigFile& rig, const cycle::CycleConfig& config)
    : rig_(rig), plant_(rig.plant, 1), control_(config) {
  plant_.RestInTouchdown();
}

void SpinningRig::SpinAt(double speed_rad_per_s, double settle_s) {
  RefuseBeyondDrive(rig_, speed_rad_per_s);
  const double ramp = rig_.plant.drive.max_acceleration_rad_per_s2;
  Step({.command = OperatorCommand::kLift});
  for (long n = PeriodsOf(rig_, kLiftS); n > 0 && out_.mode != Mode::kLevitating; --n) Step();
  if (out_.mode != Mode::kLevitating) {
    throw BadInput(
        fmt::format("{}: the rig does not levitate with this controller", rig_.numbers.name));
  }
  Step({.command = OperatorCommand::kSpin,
        .speed_rad_per_s = speed_rad_per_s,
        .acceleration_rad_per_s2 = ramp});
  for (long n = PeriodsOf(rig_, speed_rad_per_s / ramp + settle_s); n > 0; --n) Step();
}

void SpinningRig::Step(const cycle::OperatorInput& op) {
  ++in_.cycle;
  in_.frame_present = true;
  in_.frame = plant_.Sample();
  in_.op = op;
  out_ = control_.Step(in_);
  plant_.Advance(plant::CommandOf(out_.current));
}

}  // namespace levitas::gears
