#include "numerics/fourier_transform.hpp"

#include <unsupported/Eigen/FFT>

namespace levitas::numerics {
namespace {

using Complex = std::complex<double>;
using Transform = Eigen::FFT<double>;

Transform& OfThisThread() {
  thread_local Transform transform(Transform::impl_type(), Transform::HalfSpectrum);
  return transform;
}

}  // namespace

void FourierTransform(std::vector<Complex>& values) {
  if (values.size() < 2) return;  // one value is its own line; Eigen's has no factors for it
  std::vector<Complex> lines(values.size());
  OfThisThread().fwd(lines.data(), values.data(), static_cast<Eigen::Index>(values.size()));
  values.swap(lines);
}

std::vector<Complex> HalfSpectrum(std::span<const double> signal) {
  if (signal.size() < 2) return {signal.begin(), signal.end()};
  std::vector<Complex> lines(signal.size() / 2 + 1);
  OfThisThread().fwd(lines.data(), signal.data(), static_cast<Eigen::Index>(signal.size()));
  return lines;
}

}  // namespace levitas::numerics
