#include "design/pid/law_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace levitas::design {
namespace {

using Eigen::Index;

double SixDigits(double value) {
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

/// Takes the vector's values one after another.
class Taker {
 public:
  Taker(const LawShape& shape, const Eigen::VectorXd& x, Index at)
      : x_(x), at_(at), highest_hz_(kHighestCornerShare / shape.period_s) {}
  double Within(double low, double high) {
    return SixDigits(std::clamp(std::exp(x_(at_++)), low, high));
  }
  double Corner() { return Within(kLowestCornerHz, highest_hz_); }
  double Damping() { return Within(0.02, 3.0); }

  law::LeadLag AnyLeadLag() {
    const double zero_hz = Corner();
    return {zero_hz, Corner()};
  }
  law::LeadLag LeadLagAbout(double hz) {
    // Zero and pole stay where corners may be.
    const double most = std::max(1.0, std::min(highest_hz_ / hz, hz / kLowestCornerHz));
    const double half = Within(1.0 / most, most);
    return {SixDigits(hz / half), SixDigits(hz * half)};
  }
  law::Notch AnyNotch() {
    law::Notch notch;
    notch.frequency_hz = Corner();
    notch.zero_damping = Damping();
    notch.pole_damping = Damping();
    return notch;
  }
  law::Notch NotchAt(double hz) {
    law::Notch notch;
    notch.frequency_hz = SixDigits(hz);
    notch.prewarp = true;  // else it would stand lower in the sampled loop
    notch.zero_damping = Damping();
    notch.pole_damping = std::max(Damping(), notch.zero_damping);
    return notch;
  }

 private:
  const Eigen::VectorXd& x_;
  Index at_;
  double highest_hz_;
};

}  // namespace

Eigen::VectorXd StartAt(const LawShape& shape, const PlainGains& gains) {
  std::vector<double> values;
  for (std::size_t b = 0; b < shape.bearings; ++b) {
    values.push_back(gains.kp_a_per_m.at(b));
    values.push_back(gains.kd_a_s_per_m.at(b));
  }
  values.push_back(gains.integral_1_per_s);
  for (std::size_t b = 0; b < (shape.own_filters ? shape.bearings : 1); ++b) {
    values.push_back(gains.derivative_hz);
    for (std::size_t i = 0; i < shape.lead_lags; ++i) {
      if (i < shape.lead_lags_at_hz.size()) {
        values.push_back(1.0);
      } else {
        values.insert(values.end(), {gains.derivative_hz, gains.derivative_hz});
      }
    }
    for (std::size_t i = 0; i < shape.notches; ++i) {
      if (i >= shape.notches_at_hz.size()) values.push_back(gains.notch_hz.at(i));
      values.insert(values.end(), {0.7, 0.7});
    }
  }
  Eigen::VectorXd out(static_cast<Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) out(static_cast<Index>(i)) = std::log(values[i]);
  return out;
}

law::LawConfig LawAt(const LawShape& shape, const Eigen::VectorXd& x) {
  law::LawConfig out;
  out.period_s = shape.period_s;
  out.current_limit_a = shape.current_limit_a;
  Taker gains(shape, x, 0);
  std::vector<double> kp;
  std::vector<double> kd;
  for (std::size_t b = 0; b < shape.bearings; ++b) {
    kp.push_back(gains.Within(1e-3, 1e8));
    kd.push_back(gains.Within(1e-6, 1e6));
  }
  const double integral = gains.Within(4.0, 60.0);
  const auto first = static_cast<Index>(2 * shape.bearings + 1);
  for (std::size_t axis = 0; axis < shape.axes; ++axis) {
    const std::size_t b = std::min(axis / 2, shape.bearings - 1);
    Taker filters(shape, x,
                  first + static_cast<Index>(shape.own_filters ? b * shape.filters() : 0));
    law::AxisLawConfig one;
    one.kp_a_per_m = kp[b];
    one.kd_a_s_per_m = kd[b];
    one.ki_a_per_m_s = SixDigits(kp[b] * integral);
    one.derivative_hz = filters.Corner();
    for (std::size_t i = 0; i < shape.lead_lags; ++i)
      one.lead_lags.push_back(i < shape.lead_lags_at_hz.size()
                                  ? filters.LeadLagAbout(shape.lead_lags_at_hz[i])
                                  : filters.AnyLeadLag());
    for (std::size_t i = 0; i < shape.notches; ++i)
      one.notches.push_back(i < shape.notches_at_hz.size() ? filters.NotchAt(shape.notches_at_hz[i])
                                                           : filters.AnyNotch());
    out.axes.push_back(std::move(one));
  }
  return out;
}

Eigen::VectorXd Untied(const LawShape& shape, const Eigen::VectorXd& x) {
  const auto gains = static_cast<Index>(2 * shape.bearings + 1);
  const auto filters = static_cast<Index>(shape.filters());
  Eigen::VectorXd out(gains + static_cast<Index>(shape.bearings) * filters);
  out.head(gains) = x.head(gains);
  for (std::size_t b = 0; b < shape.bearings; ++b)
    out.segment(gains + static_cast<Index>(b) * filters, filters) = x.tail(filters);
  return out;
}

}  // namespace levitas::design
