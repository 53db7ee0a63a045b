#pragma once
// Transmission error of a gear pair: how far the teeth depart from conjugate motion, as one complex
// Fourier series over the tooth engagement.
//
// Equation   e(t) = sum_i e_i exp(j (i w_e t + phi_i)),  i = -n .. n,  w_e t = teeth x wheel angle
//            Forward (i > 0) and backward (i < 0) harmonics are independent: the path of e is no
//            line, and its spectrum is not symmetric. docs/derivations.md (G2).
// Frame      r = x + j y of the bearings. Units: m, rad.
// Thread     any; At and Set allocate nothing.

#include <cstddef>
#include <vector>

namespace levitas::gear {

/// A vector in the plane, x + j y.
struct Vector {
  double x{};
  double y{};
};

[[nodiscard]] constexpr Vector operator+(const Vector& a, const Vector& b) noexcept {
  return {a.x + b.x, a.y + b.y};
}
[[nodiscard]] constexpr Vector operator-(const Vector& a, const Vector& b) noexcept {
  return {a.x - b.x, a.y - b.y};
}
[[nodiscard]] constexpr Vector operator*(double factor, const Vector& a) noexcept {
  return {factor * a.x, factor * a.y};
}
/// Complex product.
[[nodiscard]] constexpr Vector Turned(const Vector& a, const Vector& by) noexcept {
  return {a.x * by.x - a.y * by.y, a.x * by.y + a.y * by.x};
}
[[nodiscard]] constexpr double Dot(const Vector& a, const Vector& b) noexcept {
  return a.x * b.x + a.y * b.y;
}

struct Harmonic {
  int order{};  ///< of the mesh frequency; negative: backward, 0: mean
  double amplitude_m{};
  double phase_rad{};
};

/// Value and rate of a prescribed displacement.
struct Prescribed {
  Vector displacement_m;
  Vector rate_m_per_s;
};

class TransmissionError {
 public:
  TransmissionError() = default;
  /// Harmonics of one order add up.
  explicit TransmissionError(const std::vector<Harmonic>& harmonics);

  /// Other amplitudes and phases; an order above the highest it was made with is left out.
  void Set(const std::vector<Harmonic>& harmonics) noexcept;

  /// `mesh` is exp(j w_e t); `mesh_rad_per_s` is w_e.
  [[nodiscard]] Prescribed At(const Vector& mesh, double mesh_rad_per_s) const noexcept;

 private:
  struct Pair {
    Vector forward;
    Vector backward;
  };
  Vector mean_;
  std::vector<Pair> pairs_;  ///< order 1, 2, ...
};

}  // namespace levitas::gear
