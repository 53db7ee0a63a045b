#include "tests/loop/reference/textbook_law.hpp"

#include <algorithm>

#include "common/two_pi.hpp"

namespace levitas::test {

Biquad::Biquad(std::array<double, 3> b, std::array<double, 3> a, double period_s) {
  const double k = 2.0 / period_s;
  const auto map = [k](const std::array<double, 3>& p) {  // p[0] + p[1] s + p[2] s^2
    return std::array<double, 3>{p[0] + p[1] * k + p[2] * k * k, 2.0 * (p[0] - p[2] * k * k),
                                 p[0] - p[1] * k + p[2] * k * k};
  };
  numerator = map(b);
  denominator = map(a);
  const double scale = denominator[0];
  for (auto& value : numerator) value /= scale;
  for (auto& value : denominator) value /= scale;
}

double Biquad::Step(double input) {
  const double output = numerator[0] * input + numerator[1] * inputs_[0] +
                        numerator[2] * inputs_[1] - denominator[1] * outputs_[0] -
                        denominator[2] * outputs_[1];
  inputs_ = {input, inputs_[0]};
  outputs_ = {output, outputs_[0]};
  return output;
}

TextbookAxis::TextbookAxis(double gain, double period_s) {
  const double kp = 4514.47 * gain;
  const double ki = 24128.6 * gain;
  const double kd = 13.0414 * gain;
  const double wd = 1868.85 * kTwoPi;
  // (Kp + Ki/s + Kd s/(1+s/wd)) over the common denominator s (1 + s/wd)
  sections_.emplace_back(std::array{ki, kp + ki / wd, kp / wd + kd}, std::array{0.0, 1.0, 1.0 / wd},
                         period_s);
  sections_.emplace_back(std::array{1.0, 1.0 / (916.816 * kTwoPi), 0.0},
                         std::array{1.0, 1.0 / (1801.41 * kTwoPi), 0.0}, period_s);
  const auto notch = [&](double f_hz, double zero, double pole) {
    const double w = f_hz * kTwoPi;
    sections_.emplace_back(std::array{1.0, 2.0 * zero / w, 1.0 / (w * w)},
                           std::array{1.0, 2.0 * pole / w, 1.0 / (w * w)}, period_s);
  };
  notch(449.181, 0.6458, 0.8256);
  notch(862.316, 0.2442, 0.8139);
}

double TextbookAxis::Step(double position_m) {
  double value = position_m;
  for (auto& section : sections_) value = section.Step(value);
  return std::clamp(-value, -1.0, 1.0);
}

}  // namespace levitas::test
