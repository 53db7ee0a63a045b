#pragma once
// Sample point: state, currents and angle of the model in one sampling period, as terms need it.
//
// Made by    RunModel, once per sample of a record; read by every term and by the sensitivities.
// Instant    "mean": over the period, from the start (after the observer's correction) to its end;
//            of displacements by the cubic through both with their velocities. A force that is
//            evaluated there and held acts with second-order accuracy.
// Frame      bearing frame. Units SI. Modes of both planes: x plane, then y plane.
// Thread     plain data.

#include <array>
#include <cmath>
#include <cstdint>

#include "common/axes.hpp"
#include "diagnosis/model/mesh_view.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kMaxModes = 16;  ///< per plane
using AxisFloats = std::array<float, kMaxAxes>;
using ModalFloats = std::array<float, 2 * kMaxModes>;

[[nodiscard]] constexpr AxisFloats Ones() noexcept {
  AxisFloats ones{};
  for (float& one : ones) one = 1.0F;
  return ones;
}

/// What terms in force add to the model's slopes at one sample (Term::slope).
struct AddedSlopes {
  AxisFloats reading_per_m{};  ///< of a reading by its own displacement
  AxisFloats force_per_a{};
  AxisFloats force_per_m{};
};

struct SamplePoint {
  double time_s{};                          ///< of the sample, from the start of the record
  double angle_rad{};                       ///< at the sample
  double cos_angle{}, sin_angle{};          ///< at the sample
  double cos_mid_angle{}, sin_mid_angle{};  ///< in the middle of the period
  float speed_rad_per_s{};
  float acceleration_rad_per_s2{};  ///< of the shaft
  bool counts{};                    ///< settled, arrived, not validation data
  bool held{};                      ///< would count but is validation data
  bool restarted{};                 ///< the first sample after a gap
  AxisFloats innovation_m{};        ///< measured minus predicted, bearing frame
  AxisFloats measured_m{};          ///< bearing frame
  AxisFloats reading_m{};           ///< predicted, before the correction, without added readings
  ModalFloats read_q{};             ///< modal coordinates behind `reading_m`
  ModalFloats read_v{};
  ModalFloats q{}, v{};       ///< mean
  AxisFloats coil_start_a{};  ///< control current
  AxisFloats coil_end_a{};
  AxisFloats coil_mean_a{};       ///< over the period
  AxisFloats actuator_m{};        ///< mean displacement at the magnets
  AxisFloats force_n{};           ///< magnet force, mean over the period at the mean displacement
  AxisFloats force_per_a{};       ///< dF/di, mean
  AxisFloats force_per_m{};       ///< dF/dx, mean
  AxisFloats command_before_a{};  ///< acted until the sample
  AxisFloats command_now_a{};     ///< acts from the sample on (whole-sample delay)
  AxisFloats command_next_a{};    ///< acts from the next sample on
  float late_periods{};           ///< by which all of them act later; negative: earlier
  AxisFloats coil_rate{};         ///< times the bandwidth of the rig file's amplifiers
  std::array<TeethMoment, kMostMeshes> teeth{};  ///< of the nominal meshes, at the mean motion
  AddedSlopes added{};
  std::uint32_t record{};
  bool arrived{};        ///< the frame is there; else the model went on without correction
  bool settled{};        ///< levitated, and the observer has settled
  bool starting{};       ///< corrected by the gain for starts
  std::uint8_t stage{};  ///< of ObserverGains::stages, when it is not

  /// The shaft's angle, what follows from it, and its speed.
  void Turn(double angle, double speed, double period_s) noexcept {
    angle_rad = angle;
    speed_rad_per_s = static_cast<float>(speed);
    const double mid = angle + 0.5 * period_s * speed;
    cos_angle = std::cos(angle);
    sin_angle = std::sin(angle);
    cos_mid_angle = std::cos(mid);
    sin_mid_angle = std::sin(mid);
  }
};

}  // namespace levitas::diagnosis
