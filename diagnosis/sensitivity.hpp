#pragma once
// Derivatives of the innovations by every term, along the run of the model.
//
// Equation   dx[n+1] = A(n) (dx[n] + K de[n]) + E dd[n] + B da,  de[n] = -(C dx[n] + dr): the model
//            linearised about its own trajectory: true slopes of the magnet force at every sample,
//            gyroscopic coupling at the speed of the sample, exact modal steps. What a term adds
//            (da, dr) is its addition at theta + h minus that at theta, over h; for linear terms
//            that at 1.
// Cost       about 0.2 us per sample and term: kLanes terms side by side in single precision, which
// is
//            enough for derivatives (1e-5) and lets the compiler use vectors.
// Thread     one instance per thread.

#include <array>
#include <memory>
#include <vector>

#include "diagnosis/model_run.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kLanes = 8;

/// A block of up to kLanes terms propagated together.
class SensitivityBlock {
 public:
  SensitivityBlock(const RigView& rig, std::shared_ptr<const analysis::ObserverGain> gain,
                   const std::vector<Term>& terms, const std::vector<double>& theta,
                   std::vector<std::size_t> chosen);
  ~SensitivityBlock();
  SensitivityBlock(SensitivityBlock&&) noexcept;

  /// Advances one sample; writes de/dtheta [axis][lane] in metres per Term::scale().
  void Step(const Moment& moment, float* derivative_m) noexcept;
  [[nodiscard]] const std::vector<std::size_t>& chosen() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::diagnosis
