#include "identification/modal/line_cost.hpp"

#include <cmath>

#include "identification/modal/modal_response.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;
using Kind = LineKind;

/// Least relative noise of a log-magnitude: far from the optimum nothing is worth more.
constexpr double kLogFloor = 0.1;

}  // namespace

LineCost::LineCost(const ModalFrame& frame, const FrequencyResponse& data, std::size_t line,
                   Kind kind, double floor)
    : frame_(frame), data_(data), line_(line), kind_(kind) {
  const double speed = std::abs(data.speed_rad_per_s) < 1.0 ? 0.0 : data.speed_rad_per_s;
  speed_rad_per_s_ = speed;
  for (Index j = 0; j < data.axes(); ++j) {
    for (Index i = 0; i < data.axes(); ++i) {
      if (speed == 0.0 && (i + j) % 2 != 0) continue;
      const auto value = data.plant[line](i, j);
      const double variance = 0.5 * data.variance[line](i, j);  // of each part
      const double sigma = kind == Kind::kComplex
                               ? std::sqrt(variance + floor * floor * std::norm(value))
                               : std::sqrt(variance / std::norm(value) + kLogFloor * kLogFloor);
      entries_.push_back({i + data.axes() * j, value, 1.0 / sigma});
    }
  }
  const auto per_entry = kind == Kind::kComplex ? 2U : 1U;
  set_num_residuals(static_cast<int>(per_entry * entries_.size()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(frame.layout.size));
}

bool LineCost::Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const {
  const Eigen::Map<const Eigen::VectorXd> vector(parameters[0], frame_.layout.size);
  const bool derive = jacobians != nullptr && jacobians[0] != nullptr;
  ResponseDerivative derivative;
  const Eigen::MatrixXcd model =
      ModalResponse(frame_, ToPhysical(frame_, vector), data_.frequency_hz[line_], speed_rad_per_s_,
                    derive ? &derivative : nullptr);
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
      derive ? jacobians[0] : nullptr, derive ? num_residuals() : 0,
      derive ? frame_.layout.size : 0);
  Index row = 0;
  for (const Entry& e : entries_) {
    const auto value = model.data()[e.at];
    if (kind_ == Kind::kComplex) {
      residuals[row] = e.weight * (value - e.data).real();
      residuals[row + 1] = e.weight * (value - e.data).imag();
      if (derive) {
        jacobian.row(row) = e.weight * derivative.row(e.at).real();
        jacobian.row(row + 1) = e.weight * derivative.row(e.at).imag();
      }
      row += 2;
    } else {
      residuals[row] = e.weight * std::log(std::abs(value) / std::abs(e.data));
      if (derive) jacobian.row(row) = e.weight * (derivative.row(e.at) / value).real();
      row += 1;
    }
  }
  return std::isfinite(model.cwiseAbs2().sum());
}

PriorCost::PriorCost(const ModalStart& start) : start_(start) {
  set_num_residuals(static_cast<int>(start.vector.size()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(start.vector.size()));
}

bool PriorCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const Index n = start_.vector.size();
  const Eigen::Map<const Eigen::VectorXd> vector(parameters[0], n);
  Eigen::Map<Eigen::VectorXd>(residuals, n) = (vector - start_.vector).cwiseQuotient(start_.prior);
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    Eigen::Map<Eigen::MatrixXd>(jacobians[0], n, n) =
        start_.prior.cwiseInverse().asDiagonal().toDenseMatrix();
  }
  return true;
}

}  // namespace levitas::identification
