#pragma once
// A law of one's own, in the place of the one of a controller file: what runs around it, checks,
// protections, modes, reference and limit of the currents, stays as it is.
//
// Equation   the law's own, from the errors of this period to the control currents it wants. The
//            cycle adds the test signal, limits the sum to +-limit_a and counts the axes at the
//            limit; a law that integrates watches the limit itself.
// Units      SI, named in identifiers. Frame: bearing frame, positive current pulls towards +x, so
//            a positive error asks for a positive current.
// Thread     loop thread only; Step and Start neither allocate, lock, wait nor throw, and give the
//            same for the same: that is what lets a run be repeated.
// Failure    what is no number releases the rotor in the same cycle (Fault::kLawNotFinite).
// Not done   no clock: Step is called once per period of the rig that has a fresh frame while the
//            coils are energised. `amb replay` knows the laws of controller files only.

#include <cstddef>

#include "common/axes.hpp"

namespace levitas::law {

struct LawInputs {
  AxisArray error_m{};       ///< reference - position, within the sensors' range
  std::size_t axes{};        ///< entries in use; the others are zero
  double limit_a{};          ///< what is wanted beyond +- this is cut off
  double speed_rad_per_s{};  ///< of the rotor, its size, as the supervisor believes it
};

class OwnLaw {
 public:
  virtual ~OwnLaw() = default;
  /// A lift begins: the law's memory is that of rest.
  virtual void Start() noexcept = 0;
  /// [A] wanted control current of each axis.
  [[nodiscard]] virtual AxisArray Step(const LawInputs& in) noexcept = 0;
};

}  // namespace levitas::law
