#pragma once
// Axes of a rig and the fixed-capacity arrays that carry one number per axis.
//
// Order    bearing by bearing from the drive end, x before y: de_x, de_y, nde_x, nde_y.
// Capacity fixed, so that frames are plain data and the control cycle never allocates.

#include <array>
#include <cstddef>

namespace levitas {

inline constexpr std::size_t kMaxAxes = 8;

/// One value per axis; entries beyond the rig's axis count are zero.
using AxisArray = std::array<double, kMaxAxes>;

}  // namespace levitas
