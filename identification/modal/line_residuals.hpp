#pragma once
// Residuals of the modal fit on one line of one response, with their analytic derivatives.
//
// Equation  (G - G_data)/sigma, real and imaginary part, with G_j = P_j S_j: what experiment j
//           recorded against what its currents make of the model (an error in P = G Q^-1 is shared
//           by a whole row of P; here every entry has its own). Or ln(|P|/|P_data|)/sigma, the
//           approach. Standing, only the entries within a plane count.
// Weights   sigma^2 = (noise + floor^2 sum_k |P_ik S_kj|^2)/2 of each part; of a log-magnitude the
//           relative variance and 10 %: far from the optimum nothing is worth more.
// Lifetime  frame, data and gains stay the caller's.
// Thread    any; a Workspace belongs to one.

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "identification/frf/frequency_response.hpp"
#include "identification/modal/modal_response.hpp"

namespace levitas::identification {

enum class LineKind { kLogMagnitude, kComplex };

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class LineResiduals {
 public:
  LineResiduals(const ModalFrame& frame, const FrequencyResponse& data, const WorkingGains& gains,
                std::size_t line, LineKind kind, double floor);

  /// kLogMagnitude, in decibels times `weights` (outputs x inputs); an entry of weight 0 is left
  /// out.
  LineResiduals(const ModalFrame& frame, const FrequencyResponse& data, const WorkingGains& gains,
                std::size_t line, const Eigen::MatrixXd& weights);

  [[nodiscard]] Eigen::Index rows() const noexcept {
    return static_cast<Eigen::Index>(entries_.size()) * (kind_ == LineKind::kComplex ? 2 : 1);
  }
  /// `residuals`: rows() of them.
  void Evaluate(const Physical& rig, std::span<double> residuals) const;
  /// `jacobian`: rows() x free.size(), derivatives by the unknowns `free`.
  void Evaluate(const Physical& rig, const std::vector<Eigen::Index>& free,
                ResponseDerivative& workspace, std::span<double> residuals,
                Eigen::Ref<RowMajor> jacobian) const;

 private:
  struct Entry {
    Eigen::Index at;
    std::complex<double> data;
    double weight;
  };
  LineResiduals(const ModalFrame& frame, const FrequencyResponse& data, const WorkingGains& gains,
                std::size_t line, LineKind kind);
  void KeepEntries(const FrequencyResponse& data, std::size_t line, double floor);
  [[nodiscard]] Eigen::MatrixXcd Model(const Physical& rig, ResponseDerivative* derivative) const;
  void Fill(const Eigen::MatrixXcd& model, std::span<double> residuals) const;

  const ModalFrame& frame_;
  const WorkingGains& gains_;
  const Eigen::MatrixXcd& currents_;
  double frequency_hz_;
  double speed_rad_per_s_;
  LineKind kind_;
  std::vector<Entry> entries_;
};

}  // namespace levitas::identification
