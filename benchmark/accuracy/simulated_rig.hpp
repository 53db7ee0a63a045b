#pragma once
// A simulated rig and the control cycle of `amb run` in closed loop within one process.
//
// Order     of `amb run` in lockstep: reading, cycle, currents, one period of the plant. What Step
//           gives back is what the recorder would get; session::RecordingBuilder and
//           diagnosis::RecordOf make of it what an importer makes of a session.
// Start     off, the rotor in its touchdown bearings: the cycle knows no other way to levitation
//           than self-test and lift, about a second of the rig's time.
// Frame     readings and currents as the rig is wired; units SI.
// Thread    one instance per thread.
// Failure   a trip is latched in record().out.fault. Levitate throws std::runtime_error, Lift and
//           SpinUp say false, when the rotor is not levitated in the end.

#include "controller/cycle/control_cycle.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::accuracy {

/// The line between rig and controller. What it does is in no record, save by its consequences.
class RigLine {
 public:
  RigLine() = default;
  RigLine(const RigLine&) = delete;
  RigLine& operator=(const RigLine&) = delete;
  virtual ~RigLine() = default;
  /// A frame on its way to the controller, which gets it as it is left here. False: it is lost,
  /// and the cycle has the last one that arrived, marked as not present.
  virtual bool Deliver(SensorFrame& frame) = 0;
  /// The currents on their way to the rig, after the record was made.
  virtual void Pass(const SensorFrame& frame, plant::PlantCommand& command) = 0;
};

class SimulatedRig {
 public:
  /// `line` has to outlive it; none: all arrives as it was sent.
  SimulatedRig(const cycle::CycleConfig& config, plant::Plant plant, RigLine* line = nullptr);

  /// One period. The reference holds until the next one.
  const cycle::CycleRecord& Step(const cycle::OperatorInput& op = {});
  /// Whole periods, rounded.
  void Run(double time_s);

  /// Lifts, and goes on for `settle_s`. Ends at once when the supervisor trips.
  [[nodiscard]] bool Lift(double settle_s = 0.5);
  void Levitate(double settle_s = 0.5);
  /// At speed without the time of a run-up: the drive holds it.
  void SpinAt(double rpm);
  /// By the drive at this rate, and `settle_s` more at the speed.
  [[nodiscard]] bool SpinUp(double speed_rad_per_s, double acceleration_rad_per_s2,
                            double settle_s = 0.5);

  [[nodiscard]] const cycle::CycleRecord& record() const noexcept { return record_; }
  [[nodiscard]] const plant::Plant& plant() const noexcept { return plant_; }

 private:
  [[nodiscard]] bool Hold(double time_s, Mode mode);

  double period_s_;
  double max_acceleration_rad_per_s2_;
  plant::Plant plant_;
  cycle::ControlCycle cycle_;
  RigLine* line_;
  std::uint64_t count_{};
  cycle::CycleRecord record_;
};

}  // namespace levitas::accuracy
