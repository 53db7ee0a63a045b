#pragma once
// Parameters of synchronous control: what of the rotor's motion turns with the shaft and is to be
// kept out of the currents, or out of the positions.
//
// Units   SI. Frame: bearing frame, axes in the order of the rig.
// Source  generalised notch: R. Herzog, P. Buehler, C. Gaehler, R. Larsonneur, IEEE Transactions on
//         Control Systems Technology 4(5), 1996; docs/derivations.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/axes.hpp"
#include "controller/synchronous/block_status.hpp"

namespace levitas::synchronous {

enum class Target : std::uint8_t {
  kCurrent,    ///< what is synchronous is taken out of the error before the law reads it
  kVibration,  ///< a synchronous current is added that brings the synchronous error to zero
};

/// One complex number from every axis to every axis, [to][from].
struct ComplexMatrix {
  std::array<AxisArray, kMaxAxes> real{};
  std::array<AxisArray, kMaxAxes> imaginary{};
};

/// T at one speed: [1] of kCurrent, [A/m] of kVibration.
struct InverseAtSpeed {
  double speed_rad_per_s{};
  ComplexMatrix inverse;
};

struct BlockConfig {
  std::string name;
  double order{1.0};  ///< multiples of the shaft's angle, > 0
  Target target{Target::kCurrent};
  double time_constant_s{0.3};  ///< of the decay where T is the exact inverse
  double from_rad_per_s{};      ///< acts from this speed ...
  double to_rad_per_s{};        ///< ... to this one
  double hysteresis_rad_per_s{};
  double largest_current_a{};   ///< of kVibration: amplitude of one axis; beyond it the block ends
  bool adaptive{};              ///< T is corrected while the block runs
  double least_change_m{2e-6};  ///< what moves the error by less teaches nothing
  std::vector<InverseAtSpeed> inverse;  ///< rising; between two speeds on the straight line
};

/// What a sensor adds that turns with the rotor: amplitude as a complex number per axis,
/// added = real cos(order angle) - imaginary sin(order angle).
struct RunOut {
  double order{1.0};
  AxisArray real_m{};
  AxisArray imaginary_m{};
};

enum class AngleSource : std::uint8_t {
  kRig,    ///< the angle of the rig's frames
  kSpeed,  ///< the integral of the rig's speed: a frequency without a mark on the shaft
  kOrbit,  ///< the rig's speed, and by how much the orbit says that the rotor leaves it
};

/// See angle_follower.hpp.
struct AngleConfig {
  AngleSource source{AngleSource::kRig};
  double bandwidth_hz{10.0};
  double largest_error_rad{0.35};
  double largest_speed_share{0.1};  ///< by which followed and measured speed may differ
  double least_followed_m{2e-6};    ///< of kOrbit: forward orbit from which it is followed
};

struct SynchronousConfig {
  AngleConfig angle;
  /// A block ends when the largest radius of a turn passes this many times what it was as the block
  /// began, and at least `least_orbit_fraction` of the clearance.
  double orbit_growth{2.0};
  double least_orbit_fraction{0.35};
  double saturated_s{0.02};  ///< an axis at its limit for so long ends the blocks
  std::vector<RunOut> run_outs;
  std::vector<BlockConfig> blocks;

  [[nodiscard]] bool empty() const noexcept { return run_outs.empty() && blocks.empty(); }
};

}  // namespace levitas::synchronous
