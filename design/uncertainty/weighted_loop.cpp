#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/two_pi.hpp"
#include "controller/law/state_space_law.hpp"
#include "design/uncertainty/balance.hpp"
#include "design/uncertainty/uncertain_plant.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::uncertainty {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Complex = std::complex<double>;

void AddBlock(const law::ModalBlock& block, Complex z, MatrixXcd& sum) {
  const Complex d = z - block.pole_real;
  const double im = block.pole_imaginary;
  const Complex determinant = im == 0.0 ? d : d * d + im * im;
  for (Index j = 0; j < sum.cols(); ++j) {
    const auto from = static_cast<std::size_t>(j);
    const double b1 = block.first_input[from];
    const double b2 = block.second_input[from];
    const Complex first = im == 0.0 ? b1 / determinant : (d * b1 + im * b2) / determinant;
    const Complex second = im == 0.0 ? 0.0 : (d * b2 - im * b1) / determinant;
    for (Index i = 0; i < sum.rows(); ++i) {
      const auto to = static_cast<std::size_t>(i);
      sum(i, j) += block.first_output[to] * first + block.second_output[to] * second;
    }
  }
}

}  // namespace

LawResponse::LawResponse(const law::LawConfig& law) : law_(law) {
  if (!law.schedule.empty()) throw std::invalid_argument("LawResponse: the law of one speed");
  if (law.state_space) blocks_ = law::DiscretiseBlocks(*law.state_space, law.period_s);
  for (const auto& axis : law.axes) sections_.push_back(law::DiscreteSections(axis, law.period_s));
}

MatrixXcd LawResponse::At(double hz) const {
  const Complex z = std::polar(1.0, kTwoPi * hz * law_.period_s);
  const auto axes = static_cast<Index>(law_.axis_count());
  MatrixXcd sum = MatrixXcd::Zero(axes, axes);
  if (!law_.state_space) {
    const Complex q = 1.0 / z;
    for (Index i = 0; i < axes; ++i) {
      Complex value = -1.0;
      for (const auto& s : sections_[static_cast<std::size_t>(i)])
        value *= (s.b0 + q * (s.b1 + q * s.b2)) / (1.0 + q * (s.a1 + q * s.a2));
      sum(i, i) = value;
    }
    return sum;
  }
  for (Index i = 0; i < axes; ++i)
    for (Index j = 0; j < axes; ++j)
      sum(i, j) = blocks_.direct[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  for (const auto& block : blocks_.blocks) AddBlock(block, z, sum);
  for (Index i = 0; i < axes; ++i) {
    sum.row(i) *= blocks_.output_a_per_v[static_cast<std::size_t>(i)];
    sum.col(i) *= blocks_.input_v_per_m[static_cast<std::size_t>(i)];
  }
  return sum;
}

MatrixXcd SensitivityOf(const PlantPoint& plant, const MatrixXcd& law) {
  return (MatrixXcd::Identity(law.rows(), law.cols()) - plant.yu * law).inverse();
}

MatrixXcd LoopMatrix(const PlantPoint& plant, const MatrixXcd& law,
                     const AnalysisWeights& weights) {
  const Index p = plant.zw.rows();
  const Index m = law.rows();
  const MatrixXcd s = SensitivityOf(plant, law);
  const MatrixXcd ks = law * s;  // u of what is added to y
  // The disturbance joins u: y = S (P d + Pw w + n), u + d = d + K y - as the plant feels it.
  const MatrixXcd sp = s * plant.yu;
  const MatrixXcd sw = s * plant.yw;
  const MatrixXcd felt_w = ks * plant.yw;
  const MatrixXcd felt_d = MatrixXcd::Identity(m, m) + ks * plant.yu;
  MatrixXcd out(p + 2 * m, p + 2 * m);
  out.topLeftCorner(p, p) = plant.zw + plant.zu * felt_w;
  out.block(0, p, p, m) = plant.zu * felt_d;
  out.topRightCorner(p, m) = plant.zu * ks;
  out.block(p, 0, m, p) = felt_w;
  out.block(p, p, m, m) = ks * plant.yu;
  out.block(p, p + m, m, m) = ks;
  out.block(p + m, 0, m, p) = sw;
  out.block(p + m, p, m, m) = sp;
  out.bottomRightCorner(m, m) = s - MatrixXcd::Identity(m, m);  // the true position, without n
  const double current = 1.0 / AllowedCurrentA(weights, plant.hz);
  const double position = 1.0 / AllowedPositionM(weights, plant.hz);
  for (Index i = 0; i < m; ++i) {
    out.row(p + i) *= current;
    out.row(p + m + i) *= position;
    out.col(p + i) *= DisturbanceA(weights, static_cast<std::size_t>(i / 2), plant.hz);
    out.col(p + m + i) *= weights.noise_m;
  }
  return out;
}

Eigen::VectorXd BalancingScale(const MatrixXcd& m, Index perturbations) {
  constexpr int kSweeps = 6;
  Eigen::MatrixXd size = m.cwiseAbs2();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(m.rows());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Index i = 0; i < perturbations; ++i) {
      const double row = size.row(i).sum() - size(i, i);
      const double column = size.col(i).sum() - size(i, i);
      if (!(row > 0.0 && column > 0.0)) continue;
      const double f = std::sqrt(std::sqrt(column / row));
      size.row(i) *= f * f;
      size.col(i) /= f * f;
      scale(i) *= f;
    }
  }
  return scale;
}

namespace {

MatrixXcd Balance(const MatrixXcd& m, Index perturbations) {
  const Eigen::VectorXd scale = BalancingScale(m, perturbations);
  return scale.asDiagonal() * m * scale.cwiseInverse().asDiagonal();
}

double LargestGain(const MatrixXcd& m) {
  const MatrixXcd gram = m.adjoint() * m;
  const Eigen::SelfAdjointEigenSolver<MatrixXcd> solver(gram, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

}  // namespace

double ComplexMu(const MatrixXcd& m, Index perturbations) {
  // What balances rows against columns may raise the largest gain; without it the bound holds too.
  return std::min(LargestGain(Balance(m, perturbations)), LargestGain(m));
}

double QuickMu(const MatrixXcd& m, Index perturbations) {
  const MatrixXcd balanced = Balance(m, perturbations);
  const MatrixXcd gram = balanced.adjoint() * balanced;
  Eigen::VectorXcd x = Eigen::VectorXcd::Ones(m.rows());
  x.tail(m.rows() - perturbations).array() += 0.5;
  double value = 0.0;
  for (int step = 0; step < 12; ++step) {
    x.normalize();
    x = gram * x;
    value = x.norm();
  }
  return std::sqrt(value);
}

}  // namespace levitas::uncertainty
