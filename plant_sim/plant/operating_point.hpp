#pragma once
// Where a levitated rotor stands under its static load: about this point the margins' model is
// linear. Found by find_operating_point.hpp.
//
// Units      SI; bearing frame, per axis. Thread: any; plain data.
// Failure    `failure` says why the magnets cannot carry the load; the point is then the centre.

#include <string>

#include "common/axes.hpp"

namespace levitas::plant {

struct OperatingPoint {
  AxisArray control_a{};       ///< ic0, commanded
  AxisArray flux_a{};          ///< of it what makes flux
  AxisArray displacement_m{};  ///< x0 at the magnet, relative to its housing
  std::string failure;         ///< empty: the magnets carry the load

  /// Exactly so: no load, or none that was sought.
  [[nodiscard]] bool centred() const noexcept {
    return flux_a == AxisArray{} && displacement_m == AxisArray{};
  }
};

}  // namespace levitas::plant
