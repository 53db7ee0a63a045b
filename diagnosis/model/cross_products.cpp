#include "diagnosis/model/cross_products.hpp"

#include "diagnosis/model/four.hpp"

namespace levitas::diagnosis {
namespace {

LEVITAS_INLINE double Total(const Four& value) noexcept {
  return (value[0] + value[1]) + (value[2] + value[3]);
}

/// Four columns from `a` on with two from `b` on: eight sums fit the registers.
LEVITAS_INLINE void Block(const double* a, const double* b, double* out,
                          Eigen::Index stride) noexcept {
  Four s00{};
  Four s10{};
  Four s20{};
  Four s30{};
  Four s01{};
  Four s11{};
  Four s21{};
  Four s31{};
  Four a0;
  Four a1;
  Four a2;
  Four a3;
  Four b0;
  Four b1;
  for (std::size_t n = 0; n < kProductRows; n += 4) {
    Load(b + n, b0);
    Load(b + kProductRows + n, b1);
    Load(a + n, a0);
    Load(a + kProductRows + n, a1);
    Load(a + 2 * kProductRows + n, a2);
    Load(a + 3 * kProductRows + n, a3);
    s00 += a0 * b0;
    s10 += a1 * b0;
    s20 += a2 * b0;
    s30 += a3 * b0;
    s01 += a0 * b1;
    s11 += a1 * b1;
    s21 += a2 * b1;
    s31 += a3 * b1;
  }
  out[0] += Total(s00);
  out[1] += Total(s10);
  out[2] += Total(s20);
  out[3] += Total(s30);
  out[stride] += Total(s01);
  out[stride + 1] += Total(s11);
  out[stride + 2] += Total(s21);
  out[stride + 3] += Total(s31);
}

LEVITAS_INLINE void Body(const Eigen::MatrixXd& columns, Eigen::MatrixXd& out) noexcept {
  constexpr auto kRows = static_cast<Eigen::Index>(kProductRows);
  const Eigen::Index stride = out.outerStride();
  for (Eigen::Index k = 0; k < columns.cols(); k += 2) {
    for (Eigen::Index i = k / 4 * 4; i < columns.cols(); i += 4) {
      Block(columns.data() + i * kRows, columns.data() + k * kRows, out.data() + k * stride + i,
            stride);
    }
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void BodyAvx2(const Eigen::MatrixXd& columns,
                                      Eigen::MatrixXd& out) noexcept {
  Body(columns, out);
}
#endif

}  // namespace

void AddCrossProducts(const Eigen::MatrixXd& columns, Eigen::MatrixXd& out) noexcept {
#if defined(__x86_64__)
  static const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
  if (kHasAvx2) return BodyAvx2(columns, out);
#endif
  Body(columns, out);
}

}  // namespace levitas::diagnosis
