#pragma once
// Rig and law on their own, without a supervisor: nothing but the equations, period by period.
//
// Rig      taken into the bearing frame, without noise and quantisation of probes and converters.
// Law      at the rig's period; its reference is the centre. Current limit: the law's, else what
//          bias and largest coil current of the first bearing leave to both sides.
// Start    rotor at rest where PlaceAtRest puts it, memory of the filters empty.
// Units    SI; bearing frame. Thread: one instance per thread; Step allocates nothing.
// Failure  std::invalid_argument of plant and law for descriptions that are impossible.

#include "common/axes.hpp"
#include "controller/law/running_law.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::analysis {

class BareLoop {
 public:
  BareLoop(const plant::PlantConfig& rig, const law::LawConfig& law);

  void PlaceAtRest(const AxisArray& actuator_position_m) noexcept;
  /// Speed and angle at the present sample; the speed then stays, and the law of a schedule too.
  void Turn(double speed_rad_per_s, double angle_rad) noexcept;
  /// One period. Test signals: added to the law's current, and to what the law reads. Returns the
  /// positions as the sensors show them at the start of the period.
  AxisArray Step(const AxisArray& excitation_a = {}, const AxisArray& excitation_m = {}) noexcept;

  [[nodiscard]] std::size_t axes() const noexcept { return law_.axes(); }
  [[nodiscard]] bool finite() const noexcept { return plant_.finite(); }

 private:
  plant::Plant plant_;
  law::RunningLaw law_;
  plant::PlantCommand command_;
  double limit_a_{};
};

/// The rig as BareLoop takes it.
[[nodiscard]] plant::PlantConfig WithoutNoise(const plant::PlantConfig& rig);

}  // namespace levitas::analysis
