#pragma once
// Whitened residuals of records for a set of parameters, and their Jacobian.
//
// Channels   upper coil, lower coil, position: measured minus free-running current, and the
//            innovation of the motion. Without current probes the position alone.
// Whitening  an autoregressive filter per channel, of the past 12 samples, estimated from a given
//            fit, so that a slowly varying residual is not counted as independent samples.
// Slopes     forward differences of the models themselves.
// Cost       about a millisecond per second of record and parameter. Thread: blocks the caller, two
//            threads inside.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "diagnosis/levitator/motion_run.hpp"

namespace levitas::levitator {

inline constexpr std::size_t kChannels = 3;
inline constexpr std::size_t kMemory = 12;

using Filters = std::array<std::vector<double>, kChannels>;
using Raw = std::array<std::vector<double>, kChannels>;

struct Sums {
  Eigen::MatrixXd jtj;
  Eigen::VectorXd jte;
  double ete{};
  double values{};
};

class Misfit {
 public:
  Misfit(NominalRig rig, std::vector<Series> series)
      : rig_(std::move(rig)), series_(std::move(series)) {}

  /// By what the model leaves at theta; `memory` 0 only scales.
  [[nodiscard]] Filters Whiten(const Theta& theta, std::size_t memory) const;
  [[nodiscard]] double SquaredSum(const Theta& theta, const Filters& filters) const;
  /// The same over blocks of half a second of what counts, all channels of a block together.
  [[nodiscard]] std::vector<double> BlockSums(const Theta& theta, const Filters& filters) const;
  /// Sums over all records, for the parameters in `active`.
  [[nodiscard]] Sums Linearise(const Theta& theta, const Filters& filters,
                               const std::vector<std::size_t>& active) const;

  [[nodiscard]] const NominalRig& rig() const { return rig_; }
  [[nodiscard]] const std::vector<Series>& series() const { return series_; }

 private:
  [[nodiscard]] Raw RawOf(const Theta& theta, std::size_t record) const;
  /// What counts, channel by channel.
  [[nodiscard]] Eigen::VectorXd Whitened(const Raw& raw, std::size_t record,
                                         const Filters& filters) const;
  [[nodiscard]] Sums LineariseOne(const Theta& theta, const Filters& filters,
                                  const std::vector<std::size_t>& active, std::size_t record) const;

  NominalRig rig_;
  std::vector<Series> series_;
};

/// Wide and narrow standard deviations, as of parameters.hpp, of any index of a Theta.
[[nodiscard]] double ToleranceOf(std::size_t index);
[[nodiscard]] double WideOf(std::size_t index);
/// Composed with an origin.
[[nodiscard]] double LeastOf(std::size_t index, const Theta& origin);

}  // namespace levitas::levitator
