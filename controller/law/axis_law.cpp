#include "controller/law/axis_law.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace levitas::law {
namespace {

std::size_t LongestChain(const std::vector<DiscreteLaw>& laws,
                         std::vector<Section> DiscreteLaw::*chain) {
  std::size_t longest = 0;
  for (const DiscreteLaw& law : laws) longest = std::max(longest, (law.*chain).size());
  return longest;
}

// The i-th section of a chain; a shorter chain is filled up with sections that pass everything.
Section At(const std::vector<Section>& chain, std::size_t i) {
  return i < chain.size() ? chain[i] : Section{};
}

// The arguments never overlap; __restrict tells the compiler, which then needs no check of it.
template <std::size_t kWidth>
void Filter(const FirstOrderLanes& __restrict c, Lanes& __restrict memory,
            Lanes& __restrict signal) noexcept {
  for (std::size_t i = 0; i < kWidth; ++i) {
    const double in = signal.at[i];
    const double out = c.b0.at[i] * in + memory.at[i];
    memory.at[i] = c.b1.at[i] * in - c.a1.at[i] * out;
    signal.at[i] = out;
  }
}

template <std::size_t kWidth>
void Filter(const SecondOrderLanes& __restrict c, LawState::TwoDelays& __restrict memory,
            Lanes& __restrict signal) noexcept {
  for (std::size_t i = 0; i < kWidth; ++i) {
    const double in = signal.at[i];
    const double out = c.b0.at[i] * in + memory.first.at[i];
    memory.first.at[i] = c.b1.at[i] * in - c.a1.at[i] * out + memory.second.at[i];
    memory.second.at[i] = c.b2.at[i] * in - c.a2.at[i] * out;
    signal.at[i] = out;
  }
}

// Every line works on all axes alike and without branches, so that it becomes vector code.
template <std::size_t kWidth>
void PidAndLimit(const PidLanes& __restrict c, LawState& __restrict state,
                 const Lanes& __restrict error_m, const AxisArray& __restrict excitation_a,
                 double limit_a, LawOutput& __restrict out) noexcept {
  std::array<double, kWidth> excess_a{};
  for (std::size_t i = 0; i < kWidth; ++i) {
    const double e = error_m.at[i];
    const double integral = state.integral_a.at[i];
    const double memory = state.derivative_a.at[i];
    const double wanted = c.direct.at[i] * e + integral + memory + excitation_a[i];
    const double given = std::min(std::max(wanted, -limit_a), limit_a);
    const double increment = c.integral.at[i] * e;
    const double excess = wanted - given;  // zero, or of the sign of what is cut off
    state.derivative_a.at[i] = c.derivative.at[i] * e + c.pole.at[i] * memory;
    state.integral_a.at[i] = integral + (excess * increment > 0.0 ? 0.0 : increment);
    out.control_current_a[i] = given;
    excess_a[i] = excess;
  }
  for (std::size_t i = 0; i < kWidth; ++i) {
    out.saturated_axes =
        static_cast<std::uint16_t>(out.saturated_axes | (excess_a[i] != 0.0 ? 1U << i : 0U));
  }
}

template <std::size_t kWidth>
LawOutput StepWidth(const LawCoefficients& coefficients, LawState& state, const AxisArray& error_m,
                    const AxisArray& excitation_a, double limit_a) noexcept {
  LawOutput out;
  Lanes signal;
  for (std::size_t i = 0; i < kWidth; ++i) signal.at[i] = error_m[i];
  for (std::size_t k = 0; k < state.lead_lags.size(); ++k) {
    Filter<kWidth>(coefficients.lead_lags()[k], state.lead_lags[k], signal);
  }
  for (std::size_t k = 0; k < state.notches.size(); ++k) {
    Filter<kWidth>(coefficients.notches()[k], state.notches[k], signal);
  }
  PidAndLimit<kWidth>(coefficients.pid(), state, signal, excitation_a, limit_a, out);
  return out;
}

}  // namespace

LawCoefficients::LawCoefficients(const LawConfig& config) : axes_(config.axis_count()) {
  if (axes_ == 0 || axes_ > kMaxAxes) {
    throw std::invalid_argument("law: " + std::to_string(axes_) + " axes, allowed 1 to " +
                                std::to_string(kMaxAxes));
  }
  if (!config.schedule.empty()) {
    throw std::invalid_argument("law: a schedule is many laws; the one of a speed is meant");
  }
  if (config.state_space) {
    state_space_.emplace(*config.state_space, config.period_s);
  } else {
    BuildAxes(config);
  }
}

void LawCoefficients::BuildAxes(const LawConfig& config) {
  std::vector<DiscreteLaw> laws;
  for (const AxisLawConfig& axis : config.axes) laws.push_back(Discretise(axis, config.period_s));
  lead_lags_.resize(LongestChain(laws, &DiscreteLaw::lead_lags));
  notches_.resize(LongestChain(laws, &DiscreteLaw::notches));
  for (std::size_t i = 0; i < axes_; ++i) {
    const DiscretePid& pid = laws[i].pid;
    pid_.direct.at[i] = pid.proportional_a_per_m + pid.integral_a_per_m + pid.derivative_a_per_m;
    pid_.integral.at[i] = 2.0 * pid.integral_a_per_m;
    pid_.derivative.at[i] = -pid.derivative_a_per_m * (1.0 + pid.derivative_pole);
    pid_.pole.at[i] = -pid.derivative_pole;
    for (std::size_t k = 0; k < lead_lags_.size(); ++k) {
      const Section section = At(laws[i].lead_lags, k);
      lead_lags_[k].b0.at[i] = section.b0;
      lead_lags_[k].b1.at[i] = section.b1;
      lead_lags_[k].a1.at[i] = section.a1;
    }
    for (std::size_t k = 0; k < notches_.size(); ++k) {
      const Section section = At(laws[i].notches, k);
      notches_[k].b0.at[i] = section.b0;
      notches_[k].b1.at[i] = section.b1;
      notches_[k].b2.at[i] = section.b2;
      notches_[k].a1.at[i] = section.a1;
      notches_[k].a2.at[i] = section.a2;
    }
  }
}

LawState::LawState(const LawCoefficients& coefficients)
    : lead_lags(coefficients.lead_lags().size()), notches(coefficients.notches().size()) {
  if (coefficients.state_space()) {
    state_space = StateSpaceState(coefficients.state_space()->blocks());
  }
}

void LawState::Reset() noexcept {
  std::fill(lead_lags.begin(), lead_lags.end(), Lanes{});
  std::fill(notches.begin(), notches.end(), TwoDelays{});
  integral_a = Lanes{};
  derivative_a = Lanes{};
  state_space.Reset();
}

void ChangeLaw(const LawCoefficients& from, const LawCoefficients& to, LawState& state) noexcept {
  for (std::size_t i = 0; i < from.axes(); ++i) {
    const double before = from.pid().derivative.at[i];
    if (before != 0.0) state.derivative_a.at[i] *= to.pid().derivative.at[i] / before;
  }
}

LawOutput Step(const LawCoefficients& coefficients, LawState& state, const AxisArray& error_m,
               const AxisArray& excitation_a, double limit_a) noexcept {
  if (coefficients.state_space()) {
    return Step(*coefficients.state_space(), state.state_space, error_m, excitation_a, limit_a);
  }
  return coefficients.axes() <= 4
             ? StepWidth<4>(coefficients, state, error_m, excitation_a, limit_a)
             : StepWidth<8>(coefficients, state, error_m, excitation_a, limit_a);
}

}  // namespace levitas::law
