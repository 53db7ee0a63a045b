#pragma once
// Parameters of a law: decentralised, axis by axis, or a state-space law between all axes; of one
// speed or over speed.
//
// Decentralised:
//   C(s) = [Kp + Ki/s + Kd s/(1 + s/wd)] . (1 + s/wz)/(1 + s/wp) . N1(s) . N2(s) ...
//   N(s) = (s^2/w^2 + 2 zz s/w + 1) / (s^2/w^2 + 2 zp s/w + 1)
//   ic   = -C(s) (y - reference)
// Source: A. Sahinkaya & J. T. Sawicki, flexible rotor on two AMBs; docs/derivations.md.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/axes.hpp"

namespace levitas::law {

struct LeadLag {
  double zero_hz{};
  double pole_hz{};
};

struct Notch {
  double frequency_hz{};
  double zero_damping{};  ///< [1] damping ratio of the numerator
  double pole_damping{};  ///< [1] damping ratio of the denominator
  bool prewarp{};         ///< stands at frequency_hz in discrete time too, see discrete_law.hpp
};

struct AxisLawConfig {
  double kp_a_per_m{};
  double ki_a_per_m_s{};
  double kd_a_s_per_m{};
  double derivative_hz{};  ///< corner of the derivative filter, wd / 2 pi
  std::vector<LeadLag> lead_lags;
  std::vector<Notch> notches;
};

/// One or two states that stand alone: [re im; -im re] w + B v, or re w + B v when im = 0.
struct ModalBlock {
  double pole_real{};         ///< [1/s], or [1] of a law given in discrete time
  double pole_imaginary{};    ///< [rad/s] or [1]; 0: one state, the second is not there
  AxisArray first_input{};    ///< row of B into the first state, per axis read
  AxisArray second_input{};   ///< row of B into the second state
  AxisArray first_output{};   ///< column of C out of the first state, per axis driven
  AxisArray second_output{};  ///< column of C out of the second state
};

/// See state_space_law.hpp.
struct StateSpaceConfig {
  static constexpr std::size_t kMaxStates = 96;

  std::size_t axes{};
  bool discrete{};  ///< the blocks are given in z; else in s, discretised by zero-order hold
  std::vector<ModalBlock> blocks;
  std::array<AxisArray, kMaxAxes> direct{};  ///< D, [axis driven][axis read]
  AxisArray input_v_per_m{};                 ///< sensor signal per displacement
  AxisArray output_a_per_v{};                ///< control current per output of the law

  [[nodiscard]] std::size_t states() const noexcept {
    std::size_t count = 0;
    for (const ModalBlock& block : blocks) count += block.pole_imaginary == 0.0 ? 1 : 2;
    return count;
  }
};

/// The law of one speed of a schedule: a state-space law, or one entry per axis of the rig.
struct LawAtSpeed {
  double speed_rad_per_s{};
  std::vector<AxisLawConfig> axes;
  std::optional<StateSpaceConfig> state_space;
  /// Below this speed the law before stays as it is; here this one, of any structure, takes over.
  bool exchange{};
};

/// A state-space law, or one entry per axis of the rig; with a schedule, that of the rotor at rest.
struct LawConfig {
  std::vector<AxisLawConfig> axes;
  double period_s{};
  double current_limit_a{};  ///< |ic| <= this: min(i0, i_max - i0) keeps both coils in range
  std::optional<StateSpaceConfig> state_space;  ///< when there, it is the law, and `axes` is empty
  /// Laws of higher speeds, rising (law_schedule.hpp); each has the filters or the blocks of the
  /// one before, save where the law is exchanged.
  std::vector<LawAtSpeed> schedule{};

  [[nodiscard]] std::size_t axis_count() const noexcept {
    return state_space ? state_space->axes : axes.size();
  }
};

}  // namespace levitas::law
