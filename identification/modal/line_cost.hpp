#pragma once
// Residuals of the modal fit with their analytic derivatives, as Ceres takes them.
//
// Line      one line of one response against the model, weighted by what the data allow: real and
//           imaginary parts, or log-magnitudes. Standing, only the entries within a plane count.
// Prior     (vector - start)/prior, all unknowns.
// Lifetime  frame, data and start stay the caller's and outlive the problem.
// Thread    any; no shared state.

#include <ceres/cost_function.h>

#include <complex>
#include <vector>

#include "identification/frf/frequency_response.hpp"
#include "identification/modal/modal_parameters.hpp"

namespace levitas::identification {

enum class LineKind { kLogMagnitude, kComplex };

class LineCost : public ceres::CostFunction {
 public:
  LineCost(const ModalFrame& frame, const FrequencyResponse& data, std::size_t line, LineKind kind,
           double floor);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  struct Entry {
    Eigen::Index at;
    std::complex<double> data;
    double weight;
  };
  const ModalFrame& frame_;
  const FrequencyResponse& data_;
  std::size_t line_;
  LineKind kind_;
  double speed_rad_per_s_{};
  std::vector<Entry> entries_;
};

class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(const ModalStart& start);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const ModalStart& start_;
};

}  // namespace levitas::identification
