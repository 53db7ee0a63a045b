#pragma once
// Series of systems that are known, for the nonlinear methods. Every random number has a seed.

#include <random>

#include "identification/nonlinear/series.hpp"

namespace levitas::test {

/// White uniform inputs of +- 1 and outputs of zeros, to be filled by the caller.
inline identification::Series WhiteInput(Eigen::Index rows, Eigen::Index inputs,
                                         Eigen::Index outputs, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  identification::Series series{
      1e-3, {}, {}, Eigen::MatrixXd(rows, inputs), Eigen::MatrixXd::Zero(rows, outputs)};
  for (Eigen::Index i = 0; i < inputs; ++i) {
    series.input_names.push_back("u" + std::to_string(i + 1));
  }
  for (Eigen::Index i = 0; i < outputs; ++i) {
    series.output_names.push_back("y" + std::to_string(i + 1));
  }
  for (Eigen::Index k = 0; k < rows; ++k) {
    for (Eigen::Index i = 0; i < inputs; ++i) series.input(k, i) = uniform(random);
  }
  return series;
}

/// y_k = 1.5 y_{k-1} - 0.8 y_{k-2} + 0.1 u_{k-1} - 0.2 y_{k-1}^3 + 0.05 u_{k-1} u_{k-2}, and white
/// noise of `noise` added to what is measured.
inline identification::Series CubicSystem(Eigen::Index rows, double noise, std::uint64_t seed) {
  identification::Series s = WhiteInput(rows, 1, 1, seed);
  for (Eigen::Index k = 2; k < rows; ++k) {
    const double y1 = s.output(k - 1, 0);
    s.output(k, 0) = 1.5 * y1 - 0.8 * s.output(k - 2, 0) + 0.1 * s.input(k - 1, 0) -
                     0.2 * y1 * y1 * y1 + 0.05 * s.input(k - 1, 0) * s.input(k - 2, 0);
  }
  std::mt19937_64 random(seed + 1000);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (Eigen::Index k = 0; k < rows; ++k) s.output(k, 0) += noise * normal(random);
  return s;
}

}  // namespace levitas::test
