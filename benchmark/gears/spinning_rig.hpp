#pragma once
// The nonlinear rig and its controller's cycle in one process: lifted, at a steady speed.
//
// Units SI. Thread: any, one at a time. Failure: none; out().fault says whether it trips.

#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::gears {

class SpinningRig {
 public:
  SpinningRig(const config::RigFile& rig, const cycle::CycleConfig& config);

  /// Lifts, goes to the speed as fast as the drive can, and stays there for that time.
  void SpinAt(double speed_rad_per_s, double settle_s);
  void Step(const cycle::OperatorInput& op = {});

  [[nodiscard]] plant::Plant& plant() noexcept { return plant_; }
  [[nodiscard]] const cycle::CycleOutputs& out() const noexcept { return out_; }
  /// Rounded to whole ones.
  [[nodiscard]] long PeriodsOf(double seconds) const noexcept;

 private:
  double period_s_;
  double ramp_rad_per_s2_;
  plant::Plant plant_;
  cycle::ControlCycle control_;
  cycle::CycleInputs in_;
  cycle::CycleOutputs out_;
};

}  // namespace levitas::gears
