#pragma once
// The numbers of a decentralised law that a design moves, as one vector.
//
// Gains     Kp and Kd of each bearing, x and y alike; Ki of all as one ratio to Kp.
// Filters   corner of the derivative, `lead_lags` lead-lags, `notches` notches: those of all
//           bearings alike, or each bearing's own.
// Held      the first lead-lags may be held about a frequency (zero and pole as far on either side,
//           so that its phase is largest there: lead with the zero below, lag with it above), the
//           first notches at one (prewarped, never a peak): then only the distance of zero and
//           pole, and the notch's damping ratios move.
// Vector    logarithms, so that a step of 0.1 is a tenth of the value; beyond the bounds a value
//           stays at them: corners from 20 Hz to 0.45 of the sampling rate, damping ratios from
//           0.02 to 3, Ki/Kp from 4 to 60 1/s (a static load is carried
//           within a quarter of a second).
// Rounded   to six digits, so that the file holds what was judged.
// Thread    any; pure.

#include <Eigen/Core>
#include <vector>

#include "controller/law/law_config.hpp"

namespace levitas::design {

inline constexpr double kLowestCornerHz = 20.0;
inline constexpr double kHighestCornerShare = 0.45;  ///< of the sampling rate

struct LawShape {
  std::size_t bearings{};
  std::size_t axes{};
  std::size_t lead_lags{1};
  std::size_t notches{2};
  std::vector<double> lead_lags_at_hz, notches_at_hz;  ///< held; no more than there are
  bool own_filters{};
  double period_s{};
  double current_limit_a{};

  [[nodiscard]] std::size_t filters() const noexcept {
    return 1 + 2 * lead_lags + 3 * notches - lead_lags_at_hz.size() - notches_at_hz.size();
  }
  [[nodiscard]] std::size_t unknowns() const noexcept {
    return 2 * bearings + 1 + (own_filters ? bearings : 1) * filters();
  }
};

/// Gains alone; lead-lags and notches that do nothing, the notches at `notch_hz` where not held.
struct PlainGains {
  std::vector<double> kp_a_per_m, kd_a_s_per_m;  ///< per bearing
  double integral_1_per_s{5.0};
  double derivative_hz{1500.0};
  std::vector<double> notch_hz;
};

[[nodiscard]] Eigen::VectorXd StartAt(const LawShape& shape, const PlainGains& gains);
[[nodiscard]] law::LawConfig LawAt(const LawShape& shape, const Eigen::VectorXd& x);

/// The same law with every bearing's filters its own.
[[nodiscard]] Eigen::VectorXd Untied(const LawShape& shape, const Eigen::VectorXd& x);

}  // namespace levitas::design
