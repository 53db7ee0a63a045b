#pragma once
// The nonlinear rig and its controller's cycle in one process: lifted, at a steady speed.
//
// Units SI. Thread: any, one at a time. Failure: out().fault says whether it trips; BadInput where
// it does not come to the speed.

#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::gears {

/// Rounded to whole ones.
[[nodiscard]] long PeriodsOf(const configuration::RigFile& rig, double seconds);

/// Throws BadInput for a speed that the drive does not reach.
void RefuseBeyondDrive(const configuration::RigFile& rig, double speed_rad_per_s);

/// The rig has to outlive it.
class SpinningRig {
 public:
  SpinningRig(const configuration::RigFile& rig, const cycle::CycleConfig& config);

  /// Lifts, goes to the speed as fast as the drive can, and stays there for that time. Throws
  /// BadInput for a speed beyond the drive's, and where it does not levitate; a trip on the way or
  /// at the speed is left to out().
  void SpinAt(double speed_rad_per_s, double settle_s);
  void Step(const cycle::OperatorInput& op = {});

  [[nodiscard]] plant::Plant& plant() noexcept { return plant_; }
  [[nodiscard]] const cycle::CycleOutputs& out() const noexcept { return out_; }

 private:
  const configuration::RigFile& rig_;
  plant::Plant plant_;
  cycle::ControlCycle control_;
  cycle::CycleInputs in_;
  cycle::CycleOutputs out_;
};

}  // namespace levitas::gears
