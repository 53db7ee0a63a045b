#pragma once
// A point of convergence as the message LEVITAS_CONVERGENCE.
//
// Thread   any; allocates. Failure none. What is beyond the range of a field is its largest value.

#include <levitas_msg/convergence_t.hpp>

#include "identification/live/live_identification.hpp"

namespace levitas::identification {

/// Of the recursion's newest point; `live` has one.
[[nodiscard]] levitas_msg::convergence_t ConvergenceMessage(const LiveIdentification& live,
                                                            const ConvergencePoint& point);

/// "position ux, section 2 of uy": which parameter changed most.
[[nodiscard]] std::string ChangedName(const LiveIdentification& live,
                                      const ConvergencePoint& point);

}  // namespace levitas::identification
