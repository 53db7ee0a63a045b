#include "identification/modal/line_residuals.hpp"

#include <cmath>
#include <numbers>

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// Least relative noise of a log-magnitude.
constexpr double kLogFloor = 0.1;

}  // namespace

LineResiduals::LineResiduals(const ModalFrame& frame, const FrequencyResponse& data,
                             const WorkingGains& gains, std::size_t line, LineKind kind)
    : frame_(frame),
      gains_(gains),
      currents_(data.currents[line]),
      frequency_hz_(data.frequency_hz[line]),
      speed_rad_per_s_(std::abs(data.speed_rad_per_s) < 1.0 ? 0.0 : data.speed_rad_per_s),
      kind_(kind) {
  entries_.reserve(static_cast<std::size_t>(data.axes() * data.axes()));
}

LineResiduals::LineResiduals(const ModalFrame& frame, const FrequencyResponse& data,
                             const WorkingGains& gains, std::size_t line, LineKind kind,
                             double floor)
    : LineResiduals(frame, data, gains, line, kind) {
  KeepEntries(data, line, floor);
}

LineResiduals::LineResiduals(const ModalFrame& frame, const FrequencyResponse& data,
                             const WorkingGains& gains, std::size_t line,
                             const Eigen::MatrixXd& weights)
    : LineResiduals(frame, data, gains, line, LineKind::kLogMagnitude) {
  constexpr double kDecibelsPerNeper = 20.0 / std::numbers::ln10;
  for (Index at = 0; at < weights.size(); ++at) {
    if (weights.data()[at] == 0.0) continue;
    entries_.push_back({at, data.plant[line].data()[at], kDecibelsPerNeper * weights.data()[at]});
  }
}

void LineResiduals::KeepEntries(const FrequencyResponse& data, std::size_t line, double floor) {
  const bool complex = kind_ == LineKind::kComplex;
  const Eigen::MatrixXcd value =
      complex ? data.plant[line] * data.currents[line] : data.plant[line];
  const Eigen::MatrixXd size = data.plant[line].cwiseAbs2() * data.currents[line].cwiseAbs2();
  for (Index j = 0; j < data.axes(); ++j) {
    for (Index i = 0; i < data.axes(); ++i) {
      if (speed_rad_per_s_ == 0.0 && (i + j) % 2 != 0) continue;
      const double sigma =
          complex ? std::sqrt(0.5 * (data.noise[line](i, j) + floor * floor * size(i, j)))
                  : std::sqrt(0.5 * data.variance[line](i, j) / std::norm(value(i, j)) +
                              kLogFloor * kLogFloor);
      entries_.push_back({i + data.axes() * j, value(i, j), 1.0 / sigma});
    }
  }
}

Eigen::MatrixXcd LineResiduals::Model(const Physical& rig, ResponseDerivative* derivative) const {
  if (kind_ == LineKind::kLogMagnitude) {
    return ModalResponse(frame_, rig, frequency_hz_, speed_rad_per_s_, derivative);
  }
  return ExperimentResponse(frame_, rig, frequency_hz_, speed_rad_per_s_, gains_, currents_,
                            derivative);
}

void LineResiduals::Fill(const Eigen::MatrixXcd& model, std::span<double> residuals) const {
  std::size_t row = 0;
  for (const Entry& e : entries_) {
    const auto value = model.data()[e.at];
    if (kind_ == LineKind::kComplex) {
      residuals[row++] = e.weight * (value - e.data).real();
      residuals[row++] = e.weight * (value - e.data).imag();
    } else {
      residuals[row++] = 0.5 * e.weight * std::log(std::norm(value) / std::norm(e.data));
    }
  }
}

void LineResiduals::Evaluate(const Physical& rig, std::span<double> residuals) const {
  Fill(Model(rig, nullptr), residuals);
}

void LineResiduals::Evaluate(const Physical& rig, const std::vector<Index>& free,
                             ResponseDerivative& workspace, std::span<double> residuals,
                             Eigen::Ref<RowMajor> jacobian) const {
  const Eigen::MatrixXcd model = Model(rig, &workspace);
  Fill(model, residuals);
  const auto count = static_cast<Index>(free.size());
  for (Index k = 0; k < count; ++k) {
    const std::complex<double>* column = workspace.col(free[static_cast<std::size_t>(k)]).data();
    Index row = 0;
    for (const Entry& e : entries_) {
      const std::complex<double> slope = column[e.at];
      if (kind_ == LineKind::kComplex) {
        jacobian(row++, k) = e.weight * slope.real();
        jacobian(row++, k) = e.weight * slope.imag();
      } else {
        // d ln|P| = Re(dP conj P)/|P|^2.
        const auto value = model.data()[e.at];
        jacobian(row++, k) = e.weight *
                             (slope.real() * value.real() + slope.imag() * value.imag()) /
                             std::norm(value);
      }
    }
  }
}

}  // namespace levitas::identification
