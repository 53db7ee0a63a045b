#pragma once
// Touchdown (retainer) bearing: what the journal feels when it uses up the clearance.
//
// Equation   delta = |r| - c;  N = max(0, k delta + d delta'), only while delta > 0;
//            T = -mu N v/sqrt(v^2 + v0^2),  v = tangential velocity + speed x journal radius.
//            docs/derivations.md (23)-(25). One-sided: it pushes, it never pulls.
// Frame      bearing frame, rotation positive from x to y.
//            T acts at the journal's surface: T journal radius is its torque on the shaft.
// Thread     any; pure functions. Not done: the bearing's own rotation and mass, wear, heat.

#include <cmath>

namespace levitas::support {

struct Touchdown {
  double clearance_m{};
  double stiffness_n_per_m{};
  double damping_n_s_per_m{};
  double friction{};
  double journal_radius_m{};
};

/// Sliding speed [m/s] below which Coulomb friction is smoothed to a viscous one.
inline constexpr double kSmoothingMPerS = 0.01;

struct Contact {
  double x_n{};
  double y_n{};
  double normal_n{};         ///< >= 0
  double tangential_n{};     ///< T, positive from x to y
  double sliding_m_per_s{};  ///< v
};

[[nodiscard]] inline bool Touches(const Touchdown& t, double x_m, double y_m) noexcept {
  return x_m * x_m + y_m * y_m > t.clearance_m * t.clearance_m;
}

/// Force on the journal at (x, y) moving with (vx, vy); to be called only when it touches.
[[nodiscard]] inline Contact Push(const Touchdown& t, double x_m, double y_m, double vx_m_per_s,
                                  double vy_m_per_s, double speed_rad_per_s) noexcept {
  const double radius_m = std::sqrt(x_m * x_m + y_m * y_m);
  const double nx = x_m / radius_m;
  const double ny = y_m / radius_m;
  const double outward_m_per_s = nx * vx_m_per_s + ny * vy_m_per_s;
  const double normal_n =
      t.stiffness_n_per_m * (radius_m - t.clearance_m) + t.damping_n_s_per_m * outward_m_per_s;
  if (!(normal_n > 0.0)) return {};
  const double sliding_m_per_s =
      nx * vy_m_per_s - ny * vx_m_per_s + speed_rad_per_s * t.journal_radius_m;
  const double tangential_n =
      -t.friction * normal_n * sliding_m_per_s /
      std::sqrt(sliding_m_per_s * sliding_m_per_s + kSmoothingMPerS * kSmoothingMPerS);
  return {-normal_n * nx - tangential_n * ny, -normal_n * ny + tangential_n * nx, normal_n,
          tangential_n, sliding_m_per_s};
}

}  // namespace levitas::support
