#include "benchmark/accuracy/simulated_rig.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/rotational_speed.hpp"
#include "plant_sim/plant/command_of.hpp"

namespace levitas::accuracy {

SimulatedRig::SimulatedRig(const cycle::CycleConfig& config, plant::Plant plant, RigLine* line)
    : period_s_(config.rig.period_s()),
      max_acceleration_rad_per_s2_(config.rig.max_acceleration_rad_per_s2),
      plant_(std::move(plant)),
      cycle_(config),
      line_(line) {
  plant_.RestInTouchdown();
}

const cycle::CycleRecord& SimulatedRig::Step(const cycle::OperatorInput& op) {
  SensorFrame sent = plant_.Sample();
  record_.in.cycle = count_++;
  record_.in.frame_present = line_ == nullptr || line_->Deliver(sent);
  if (record_.in.frame_present) record_.in.frame = sent;
  record_.in.op = op;
  record_.out = cycle_.Step(record_.in);
  plant::PlantCommand command = plant::CommandOf(record_.out.current);
  if (line_ != nullptr) line_->Pass(sent, command);
  plant_.Advance(command);
  return record_;
}

void SimulatedRig::Run(double time_s) {
  for (long n = std::lround(time_s / period_s_); n > 0; --n) Step();
}

bool SimulatedRig::Hold(double time_s, Mode mode) {
  for (long n = std::lround(time_s / period_s_); n > 0 && record_.out.mode == mode; --n) Step();
  return record_.out.mode == mode;
}

bool SimulatedRig::Lift(double settle_s) {
  constexpr double kLongestS = 5.0;
  const auto under_way = [this] {
    return record_.out.mode == Mode::kSelfTest || record_.out.mode == Mode::kLift;
  };
  Step({.command = OperatorCommand::kLift});
  for (long n = std::lround(kLongestS / period_s_); n > 0 && under_way(); --n) Step();
  return Hold(settle_s, Mode::kLevitating);
}

void SimulatedRig::Levitate(double settle_s) {
  if (!Lift(settle_s)) throw std::runtime_error("the rig does not levitate");
}

void SimulatedRig::SpinAt(double rpm) {
  constexpr double kRpmPerS = 800.0;
  plant_.SetSpeed(RpmToRadPerS(rpm), 0.0);
  Step({.command = OperatorCommand::kSpin,
        .speed_rad_per_s = RpmToRadPerS(rpm),
        .acceleration_rad_per_s2 = std::min(RpmToRadPerS(kRpmPerS), max_acceleration_rad_per_s2_)});
  Run(0.5);
}

bool SimulatedRig::SpinUp(double speed_rad_per_s, double acceleration_rad_per_s2, double settle_s) {
  Step({.command = OperatorCommand::kSpin,
        .speed_rad_per_s = speed_rad_per_s,
        .acceleration_rad_per_s2 = acceleration_rad_per_s2});
  return Hold(std::abs(speed_rad_per_s) / acceleration_rad_per_s2 + settle_s, Mode::kSpinning);
}

}  // namespace levitas::accuracy
