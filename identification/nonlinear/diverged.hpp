#pragma once
// When a free run of a nonlinear model is given up.

namespace levitas::identification {

/// A free run beyond this many standard deviations of the data has left every model's domain.
inline constexpr double kDivergedScales = 1000.0;

}  // namespace levitas::identification
