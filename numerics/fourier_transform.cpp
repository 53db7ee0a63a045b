#include "numerics/fourier_transform.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace levitas::numerics {
namespace {

using Complex = std::complex<double>;
using Transform = Eigen::FFT<double>;

Transform& OfThisThread() {
  thread_local Transform transform(Transform::impl_type(), Transform::HalfSpectrum);
  return transform;
}

/// A step of a prime p costs p for each value; from about here on three transforms of a power of
/// two cost less.
constexpr std::size_t kLongPrime = 128;

bool HasLongPrime(std::size_t length) {
  for (std::size_t factor = 2; factor < kLongPrime && length > 1;) {
    if (length % factor == 0) {
      length /= factor;
    } else {
      ++factor;
    }
  }
  return length > 1;
}

std::vector<Complex> ByFactors(std::vector<Complex>& values) {
  std::vector<Complex> lines(values.size());
  OfThisThread().fwd(lines.data(), values.data(), static_cast<Eigen::Index>(values.size()));
  return lines;
}

/// With n k = (n^2 + k^2 - (k - n)^2) / 2 a transform is a convolution with a chirp, and that is
/// three transforms of a power of two.
std::vector<Complex> ByChirp(const std::vector<Complex>& values) {
  const std::size_t count = values.size();
  const std::size_t padded = std::bit_ceil(2 * count);
  std::vector<Complex> chirp(count);
  for (std::size_t n = 0; n < count; ++n) {
    // exp(-j pi n^2 / N) repeats with n^2 modulo 2 N: no large angle loses digits.
    const std::size_t square = n * n % (2 * count);
    chirp[n] = std::polar(
        1.0, -std::numbers::pi * static_cast<double>(square) / static_cast<double>(count));
  }
  std::vector<Complex> signal(padded);
  std::vector<Complex> kernel(padded);
  for (std::size_t n = 0; n < count; ++n) {
    signal[n] = values[n] * chirp[n];
    kernel[n] = std::conj(chirp[n]);
    kernel[(padded - n) % padded] = kernel[n];
  }
  std::vector<Complex> product = ByFactors(signal);
  const std::vector<Complex> other = ByFactors(kernel);
  // The inverse: the conjugate of the transform of the conjugates.
  for (std::size_t k = 0; k < padded; ++k) product[k] = std::conj(product[k] * other[k]);
  product = ByFactors(product);
  std::vector<Complex> lines(count);
  for (std::size_t k = 0; k < count; ++k) {
    lines[k] = std::conj(product[k]) * chirp[k] / static_cast<double>(padded);
  }
  return lines;
}

}  // namespace

void FourierTransform(std::vector<Complex>& values) {
  if (values.size() < 2) return;  // one value is its own line; Eigen's has no factors for it
  values = HasLongPrime(values.size()) ? ByChirp(values) : ByFactors(values);
}

std::vector<Complex> HalfSpectrum(std::span<const double> signal) {
  if (signal.size() < 2) return {signal.begin(), signal.end()};
  if (HasLongPrime(signal.size())) {
    std::vector<Complex> all(signal.begin(), signal.end());
    all = ByChirp(all);
    all.resize(signal.size() / 2 + 1);
    return all;
  }
  std::vector<Complex> lines(signal.size() / 2 + 1);
  OfThisThread().fwd(lines.data(), signal.data(), static_cast<Eigen::Index>(signal.size()));
  return lines;
}

}  // namespace levitas::numerics
