#pragma once
// How well a fitted model can foretell a record that was not fitted, given what the fitted records
// leave undetermined.
//
// Equation   were the rig the draw theta_j of the posterior, the model at its mean would leave
//            e = n + d_j  of the record: noise n, and d_j, the distance of the draw's prediction
//            from the mean's. Their power is
//              |n|^2 + |d_j|^2 + 2 n.d_j,  n.d_j normal of variance s^2 |d_j|^2 (white n),
//            with |n|^2 from blocks of the fitted records, drawn anew for every band of speed.
// Model      no model is exact: every draw adds (g share)^2 of the motion's power, g normal; share
//            is Judging::model_error_share.
// Level      what a true model leaves differs between records, whose observers are not the same:
//            every draw multiplies |n|^2 by one of normal logarithm, kLevelShare.
// Interval   from the 5th to the 95th percentile over draws of theta, noise and model error.
// Better     the share of draws of theta for which the model foretells the record better than the
//            rig file does: the chance that calibration pays.
// Fit        100 (1 - |e|/|y - mean|), mean over channels, as of gain.hpp; y: all of the record.
// Failure    none: no draws or no rows give no bands, and nothing is covered. A draw that is not
//            finite counts as infinitely far.
// Thread     any; pure, written seed.

#include <cstddef>
#include <vector>

namespace levitas::diagnosis {

inline constexpr double kLevelShare = 0.02;  ///< of the power

struct Interval {
  double low{}, high{};
  [[nodiscard]] bool Covers(double value) const noexcept { return low <= value && value <= high; }
};

/// Sums over the samples of the record in one band of speed; inner vectors: per axis.
struct BandSums {
  double from_rad_per_s{}, to_rad_per_s{};
  std::size_t rows{};
  std::vector<double> motion_m2;  ///< readings about their mean over the record, squared
  std::vector<double> left_m2;    ///< what the model left of them, squared
  /// Per draw: its prediction from the model's and from the rig file's, squared.
  std::vector<std::vector<double>> apart_m2, apart_from_file_m2;
};

/// Mean square of what the model leaves of one block of a fitted record, per axis.
struct NoiseBlock {
  std::size_t record{};
  std::vector<double> square_m2;
};

struct ForecastBand {
  double from_rad_per_s{}, to_rad_per_s{};
  Interval residual_m;  ///< rms over all axes
  double residual_measured_m{};
  Interval fit_percent;
  double fit_measured_percent{};
  [[nodiscard]] bool covered() const noexcept { return residual_m.Covers(residual_measured_m); }
};

struct Forecast {
  Interval fit_percent;  ///< of the whole record
  double fit_measured_percent{};
  Interval residual_m;
  double residual_measured_m{};
  double better_than_file{};  ///< chance, 0 to 1
  std::vector<ForecastBand> by_speed;
  [[nodiscard]] bool covered() const noexcept {
    return !by_speed.empty() && fit_percent.Covers(fit_measured_percent);
  }
};

/// `block_rows`: length of the blocks of `noise`.
[[nodiscard]] Forecast IntervalsOf(const std::vector<BandSums>& bands,
                                   const std::vector<NoiseBlock>& noise, std::size_t block_rows,
                                   double model_error_share);

}  // namespace levitas::diagnosis
