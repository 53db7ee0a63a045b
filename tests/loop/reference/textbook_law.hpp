#pragma once
// The axis law of the reference responses, written from the textbook only for these tests, so that
// an error of the product's own law cannot hide one of the plant, nor the other way round.
//
//   C(s) = [Kp + Ki/s + Kd s/(1 + s/wd)] (1 + s/wz)/(1 + s/wp) N1(s) N2(s),  s = (2/T)(z-1)/(z+1)

#include <array>
#include <vector>

namespace levitas::test {

/// (b2 s^2 + b1 s + b0) / (a2 s^2 + a1 s + a0) by Tustin's rule, direct form I.
class Biquad {
 public:
  Biquad(std::array<double, 3> b, std::array<double, 3> a, double period_s);
  double Step(double input);
  /// Coefficients in z^-1, for a state-space of the same filter.
  std::array<double, 3> numerator{}, denominator{};

 private:
  std::array<double, 2> inputs_{}, outputs_{};
};

class TextbookAxis {
 public:
  /// `gain` multiplies Kp, Ki, Kd of the drive-end axis.
  TextbookAxis(double gain, double period_s);
  /// ic = -C y, limited to +-1 A.
  double Step(double position_m);
  [[nodiscard]] const std::vector<Biquad>& sections() const { return sections_; }

 private:
  std::vector<Biquad> sections_;
};

}  // namespace levitas::test
