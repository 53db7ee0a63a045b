#pragma once
// A law that no controller file can say: soft about the centre, stiffer the further the rotor is.
//
// Equation   i = k (1 + (e / e0)^2) e + ki * integral of e + kd * filtered de/dt, axis by axis.
// Why        noise of the sensors meets the small gain, a shock the large one.
// Integral   stands still where the current it asks for is beyond the limit.
// Units      SI; errors and currents in the bearing frame.

#include <cmath>

#include "controller/law/own_law.hpp"

class ProgressiveLaw final : public levitas::law::OwnLaw {
 public:
  explicit ProgressiveLaw(double period_s) : period_s_(period_s) {}

  void Start() noexcept override { *this = ProgressiveLaw(period_s_); }

  [[nodiscard]] levitas::AxisArray Step(const levitas::law::LawInputs& in) noexcept override {
    levitas::AxisArray wanted_a{};
    for (std::size_t i = 0; i < in.axes; ++i) {
      const double e_m = in.error_m[i];
      if (!started_) last_m_[i] = e_m;
      rate_m_s_[i] += kFilter * ((e_m - last_m_[i]) / period_s_ - rate_m_s_[i]);
      last_m_[i] = e_m;
      const double out = e_m / kSoftM;
      const double without_a =
          kStiffnessAPerM * (1.0 + out * out) * e_m + kDampingAsPerM * rate_m_s_[i];
      const double next_a = integral_a_[i] + kIntegralAPerMs * period_s_ * e_m;
      if (std::abs(without_a + next_a) <= in.limit_a) integral_a_[i] = next_a;
      wanted_a[i] = without_a + integral_a_[i];
    }
    started_ = true;
    return wanted_a;
  }

 private:
  static constexpr double kStiffnessAPerM = 5000.0;  // ki k = 2.0e5 N/m: above ks = 1.05e5 N/m
  static constexpr double kIntegralAPerMs = 3.0e4;
  static constexpr double kDampingAsPerM = 6.0;
  static constexpr double kSoftM = 100e-6;  // twice the stiffness here, half way to the touchdown
  static constexpr double kFilter = 0.6;    // of the derivative: 1.5 kHz at a period of 100 us

  double period_s_;
  levitas::AxisArray last_m_{}, rate_m_s_{}, integral_a_{};
  bool started_{false};
};
