#pragma once
// What the model did in one sampling period, as the terms of a diagnosis look at it.
//
// Made by    ModelRun, once per sample of a record; read by every term and by the sensitivities.
// Instant    "mid": mean of the start (after the observer's correction) and the end of the period;
//            a force that is evaluated there and held acts with second-order accuracy.
// Frame      bearing frame. Units SI. Modes of both planes: x plane, then y plane.
// Thread     plain data.

#include <array>
#include <cstdint>

#include "common/axes.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kMaxModes = 16;  ///< per plane
using AxisFloats = std::array<float, kMaxAxes>;
using ModalFloats = std::array<float, 2 * kMaxModes>;

struct Moment {
  double time_s{};     ///< of the sample, from the start of the record
  double angle_rad{};  ///< at the sample
  float speed_rad_per_s{};
  bool counts{};              ///< settled, arrived, not kept back
  bool held{};                ///< would count but is kept back
  bool restarted{};           ///< the first sample after a gap
  AxisFloats innovation_m{};  ///< measured minus predicted, bearing frame
  AxisFloats measured_m{};    ///< bearing frame
  AxisFloats reading_m{};     ///< predicted, before the correction, without added readings
  ModalFloats read_q{};       ///< modal coordinates behind `reading_m`
  ModalFloats read_v{};
  ModalFloats q{}, v{};       ///< mid
  AxisFloats coil_start_a{};  ///< control current
  AxisFloats coil_end_a{};
  AxisFloats actuator_m{};        ///< mid, displacement at the magnets
  AxisFloats force_n{};           ///< mid, magnet force
  AxisFloats force_per_a{};       ///< mid, dF/di
  AxisFloats force_per_m{};       ///< mid, dF/dx
  AxisFloats command_before_a{};  ///< acted until the sample
  AxisFloats command_now_a{};     ///< acts from the sample on (whole-sample delay)
  AxisFloats command_next_a{};    ///< acts from the next sample on
  std::uint32_t record{};
  bool arrived{};   ///< the frame is there; else the model went on without correction
  bool settled{};   ///< levitated, and the observer has settled
  bool starting{};  ///< corrected by the gain for starts
};

}  // namespace levitas::diagnosis
