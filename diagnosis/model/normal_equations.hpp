#pragma once
// Whitened innovations and their sums over all records: J^T J, J^T e and e^T e (made by
// slopes.hpp).
//
// Whitening  an autoregressive filter per channel, from the innovations of the calibrated model
//            (Yule-Walker), scaled to unit variance, or below it where the model is not worth as
//            much as the probes; the same filter for every hypothesis.
// Weights    the filters' variance; one number per channel.
// Thread     any; pure.

#include <Eigen/Core>
#include <vector>

#include "diagnosis/model/sensitivity.hpp"

namespace levitas::diagnosis {

struct Whitener {
  std::size_t order{};
  std::vector<std::vector<double>> filter;  ///< per axis: 1, -a1, -a2 ... over its noise's rms
};

/// From the innovations that count. `order` 0 only scales.
[[nodiscard]] Whitener MakeWhitener(const std::vector<Trajectory>& runs, std::size_t axes,
                                    std::size_t order);

/// The same, with every channel as noisy at least as `share` of the rms of its motion: a model is
/// never exact, and a quiet probe would take its errors for causes.
[[nodiscard]] Whitener MakeWhitener(const std::vector<Trajectory>& runs, std::size_t axes,
                                    std::size_t order, double share);

struct NormalEquations {
  Eigen::MatrixXd jtj;  ///< terms x terms
  Eigen::VectorXd jte;
  double ete{};
  std::size_t values{};  ///< whitened innovations summed
};

/// e^T e alone.
[[nodiscard]] double SquaredSum(const std::vector<Trajectory>& runs, std::size_t axes,
                                const Whitener& whitener, std::size_t* values = nullptr);

}  // namespace levitas::diagnosis
