#include "controller/law/discrete_law.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace levitas::law {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Throws unless value is finite and greater than zero.
void NeedPositive(double value, const char* name) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string("law: ") + name + " = " + std::to_string(value) +
                                ", must be finite and greater than 0");
  }
}

void NeedFinite(double value, const char* name) {
  if (!std::isfinite(value)) {
    throw std::invalid_argument(std::string("law: ") + name + " is not finite");
  }
}

// r = (2/T)/w: how Tustin's substitution writes s/w = r (1-q)/(1+q).
double Ratio(double frequency_hz, double period_s) {
  return 2.0 / (period_s * kTwoPi * frequency_hz);
}

DiscretePid Pid(const AxisLawConfig& config, double period_s) {
  NeedFinite(config.kp_a_per_m, "kp_a_per_m");
  NeedFinite(config.ki_a_per_m_s, "ki_a_per_m_s");
  NeedFinite(config.kd_a_s_per_m, "kd_a_s_per_m");
  DiscretePid pid;
  pid.proportional_a_per_m = config.kp_a_per_m;
  pid.integral_a_per_m = 0.5 * config.ki_a_per_m_s * period_s;
  if (config.kd_a_s_per_m != 0.0) {
    NeedPositive(config.derivative_hz, "derivative_hz");
    const double r = Ratio(config.derivative_hz, period_s);
    pid.derivative_a_per_m = config.kd_a_s_per_m * (2.0 / period_s) / (1.0 + r);
    pid.derivative_pole = (1.0 - r) / (1.0 + r);
  }
  return pid;
}

Section Discretise(const LeadLag& block, double period_s) {
  NeedPositive(block.zero_hz, "lead_lag zero_hz");
  NeedPositive(block.pole_hz, "lead_lag pole_hz");
  const double zero = Ratio(block.zero_hz, period_s);
  const double pole = Ratio(block.pole_hz, period_s);
  const double a0 = 1.0 + pole;
  return {(1.0 + zero) / a0, (1.0 - zero) / a0, 0.0, (1.0 - pole) / a0, 0.0};
}

Section Discretise(const Notch& block, double period_s) {
  NeedPositive(block.frequency_hz, "notch frequency_hz");
  NeedPositive(block.pole_damping, "notch pole_damping");
  NeedFinite(block.zero_damping, "notch zero_damping");
  // With prewarp the substitution is exact at the notch: s/w = r (1-q)/(1+q) with r = 1/tan(wT/2).
  const double r = block.prewarp ? 1.0 / std::tan(0.5 * kTwoPi * block.frequency_hz * period_s)
                                 : Ratio(block.frequency_hz, period_s);
  const double zero = 2.0 * block.zero_damping * r;
  const double pole = 2.0 * block.pole_damping * r;
  const double a0 = r * r + pole + 1.0;
  const double middle = 2.0 * (1.0 - r * r) / a0;
  return {(r * r + zero + 1.0) / a0, middle, (r * r - zero + 1.0) / a0, middle,
          (r * r - pole + 1.0) / a0};
}

// Eq. (L7): the parallel PID over its common denominator.
Section PidSection(const DiscretePid& pid) {
  const double kp = pid.proportional_a_per_m;
  const double g = pid.integral_a_per_m;
  const double b = pid.derivative_a_per_m;
  const double a = pid.derivative_pole;
  if (g == 0.0) return {kp + b, kp * a - b, 0.0, a, 0.0};
  if (b == 0.0) return {kp + g, g - kp, 0.0, -1.0, 0.0};
  return {kp + g + b, kp * (a - 1.0) + g * (1.0 + a) - 2.0 * b, a * (g - kp) + b, a - 1.0, -a};
}

std::complex<double> Response(const Section& section, std::complex<double> q) {
  return (section.b0 + q * (section.b1 + q * section.b2)) /
         (1.0 + q * (section.a1 + q * section.a2));
}

}  // namespace

double StandsAt(const Notch& notch, double period_s) {
  if (notch.prewarp) return notch.frequency_hz;
  return std::atan(0.5 * kTwoPi * notch.frequency_hz * period_s) / (0.5 * kTwoPi * period_s);
}

DiscreteLaw Discretise(const AxisLawConfig& config, double period_s) {
  NeedPositive(period_s, "period_s");
  DiscreteLaw law;
  law.pid = Pid(config, period_s);
  for (const LeadLag& block : config.lead_lags) {
    law.lead_lags.push_back(Discretise(block, period_s));
  }
  for (const Notch& block : config.notches) law.notches.push_back(Discretise(block, period_s));
  return law;
}

std::vector<Section> DiscreteSections(const AxisLawConfig& config, double period_s) {
  const DiscreteLaw law = Discretise(config, period_s);
  std::vector<Section> sections{PidSection(law.pid)};
  sections.insert(sections.end(), law.lead_lags.begin(), law.lead_lags.end());
  sections.insert(sections.end(), law.notches.begin(), law.notches.end());
  return sections;
}

std::complex<double> FrequencyResponse(const DiscreteLaw& law, double frequency_hz,
                                       double period_s) {
  const std::complex<double> q = std::polar(1.0, -kTwoPi * frequency_hz * period_s);
  // (1+q)/(1-q) on the unit circle is -j cot(wT/2); written so, no digits are lost at low
  // frequency.
  const double half_angle = 0.5 * kTwoPi * frequency_hz * period_s;
  std::complex<double> response = law.pid.proportional_a_per_m;
  if (law.pid.integral_a_per_m != 0.0) {
    response += law.pid.integral_a_per_m * std::complex<double>(0.0, -1.0 / std::tan(half_angle));
  }
  response += law.pid.derivative_a_per_m * (1.0 - q) / (1.0 + law.pid.derivative_pole * q);
  for (const Section& section : law.lead_lags) response *= Response(section, q);
  for (const Section& section : law.notches) response *= Response(section, q);
  return response;
}

std::complex<double> ContinuousResponse(const AxisLawConfig& config, std::complex<double> s) {
  std::complex<double> response = config.kp_a_per_m;
  if (config.ki_a_per_m_s != 0.0) response += config.ki_a_per_m_s / s;
  if (config.kd_a_s_per_m != 0.0) {
    response += config.kd_a_s_per_m * s / (1.0 + s / (kTwoPi * config.derivative_hz));
  }
  for (const LeadLag& block : config.lead_lags) {
    response *= (1.0 + s / (kTwoPi * block.zero_hz)) / (1.0 + s / (kTwoPi * block.pole_hz));
  }
  for (const Notch& block : config.notches) {
    const std::complex<double> x = s / (kTwoPi * block.frequency_hz);
    response *=
        (x * x + 2.0 * block.zero_damping * x + 1.0) / (x * x + 2.0 * block.pole_damping * x + 1.0);
  }
  return response;
}

double TustinWarp(double frequency_hz, double period_s) {
  return 2.0 / period_s * std::tan(0.5 * kTwoPi * frequency_hz * period_s);
}

}  // namespace levitas::law
