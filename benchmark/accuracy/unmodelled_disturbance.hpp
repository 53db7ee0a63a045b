#pragma once
// Things that no effect of the vocabulary describes, to see whether a diagnosis admits it.
//
// They act outside the plant: on the readings, or as a current that is not recorded.
// Units SI. Thread: one instance per run.

#include <cstdint>
#include <string>

#include "common/axes.hpp"
#include "common/random.hpp"

namespace levitas::accuracy {

enum class Unmodelled : std::uint8_t {
  kNothing,
  kToneForce,       ///< a machine next door: a force of fixed frequency
  kSubsynchronous,  ///< a whirl at a fraction of rotation: needs rotation
  kTurbulence,      ///< random force in a band
  kCrosstalk,       ///< one sensor reads a little of another bearing's
  kWanderingGain,   ///< a sensor whose scale comes and goes
};

[[nodiscard]] std::string Name(Unmodelled outside);

/// One disturbance with its numbers drawn.
class Disturbance {
 public:
  Disturbance(Unmodelled kind, double size, std::size_t axes, double period_s, Random& random);

  /// What the sensors add to the true readings at this sample.
  void Read(double time_s, AxisArray& reading_m);
  /// Unrecorded current that acts with the command of this sample. To be asked at every sample: the
  /// angle begins anew with every turn, a whirl does not.
  [[nodiscard]] AxisArray Current(double time_s, double angle_rad, double speed_rad_per_s);
  [[nodiscard]] double frequency_hz() const noexcept { return frequency_hz_; }
  [[nodiscard]] std::size_t axis() const noexcept { return axis_; }

 private:
  Unmodelled kind_;
  double size_;
  double period_s_;
  std::size_t axis_{}, other_{};
  double frequency_hz_{};
  double order_{};
  double angle_rad_{}, turned_rad_{};  ///< at the last sample; turned until then, from zero
  double resonance_{}, resonance_rate_{};
  Random noise_;
};

}  // namespace levitas::accuracy
