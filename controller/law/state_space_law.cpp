#include "controller/law/state_space_law.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "controller/law/axis_law.hpp"
#include "controller/law/hidden_states.hpp"

namespace levitas::law {
namespace {

void Check(const StateSpaceConfig& config, double period_s) {
  const auto refuse = [](const std::string& text) {
    throw std::invalid_argument("state-space law: " + text);
  };
  if (config.axes == 0 || config.axes > kMaxAxes) {
    refuse(std::to_string(config.axes) + " axes, allowed 1 to " + std::to_string(kMaxAxes));
  }
  if (config.states() > StateSpaceConfig::kMaxStates) {
    refuse(std::to_string(config.states()) + " states, allowed 0 to " +
           std::to_string(StateSpaceConfig::kMaxStates));
  }
  if (!(period_s > 0.0) || !std::isfinite(period_s)) refuse("the period must be positive");
  const auto finite = [&](const AxisArray& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) refuse("a coefficient is not a finite number");
    }
  };
  for (const ModalBlock& block : config.blocks) {
    finite({block.pole_real, block.pole_imaginary});
    finite(block.first_input);
    finite(block.second_input);
    finite(block.first_output);
    finite(block.second_output);
  }
  for (const AxisArray& row : config.direct) finite(row);
  finite(config.input_v_per_m);
  finite(config.output_a_per_v);
}

/// Two radial bearings: the usual rig, for which the loops below are of fixed length.
constexpr std::size_t kFewLanes = 4;

// (L14): the block over one period with its input held. G = A^-1 (exp(AT) - I), of the same form
// [a b; -b a] as A itself.
ModalBlock Hold(const ModalBlock& block, double period_s) {
  const double re = block.pole_real;
  const double im = block.pole_imaginary;
  const double decay = std::exp(re * period_s);
  ModalBlock held = block;
  held.pole_real = decay * std::cos(im * period_s);
  held.pole_imaginary = decay * std::sin(im * period_s);
  const double norm = re * re + im * im;
  const double p = held.pole_real - 1.0;
  const double q = held.pole_imaginary;
  const double a = norm > 0.0 ? (re * p + im * q) / norm : period_s;
  const double b = norm > 0.0 ? (re * q - im * p) / norm : 0.0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    held.first_input[i] = a * block.first_input[i] + b * block.second_input[i];
    held.second_input[i] = a * block.second_input[i] - b * block.first_input[i];
  }
  return held;
}

}  // namespace

StateSpaceConfig DiscretiseBlocks(const StateSpaceConfig& config, double period_s) {
  Check(config, period_s);
  StateSpaceConfig discrete = config;
  discrete.discrete = true;
  if (config.discrete) return discrete;
  for (ModalBlock& block : discrete.blocks) block = Hold(block, period_s);
  return discrete;
}

StateSpaceCoefficients::StateSpaceCoefficients(const StateSpaceConfig& config, double period_s) {
  const StateSpaceConfig law = DiscretiseBlocks(config, period_s);
  axes_ = law.axes;
  lanes_ = axes_ <= kFewLanes ? kFewLanes : kMaxAxes;
  direct_ = law.direct;
  input_gain_ = law.input_v_per_m;
  output_gain_ = law.output_a_per_v;
  const std::size_t count = law.blocks.size();
  first_input_.resize(count * axes_);
  second_input_.resize(count * axes_);
  for (std::size_t k = 0; k < count; ++k) {
    const ModalBlock& block = law.blocks[k];
    real_.push_back(block.pole_real);
    imaginary_.push_back(block.pole_imaginary);
    const bool pair = config.blocks[k].pole_imaginary != 0.0;
    for (std::size_t i = 0; i < axes_; ++i) {
      first_input_[i * count + k] = block.first_input[i];
      second_input_[i * count + k] = pair ? block.second_input[i] : 0.0;
    }
    for (std::size_t i = 0; i < lanes_; ++i) {
      first_output_.push_back(block.first_output[i]);
      second_output_.push_back(pair ? block.second_output[i] : 0.0);
    }
    const double modulus = std::hypot(block.pole_real, block.pole_imaginary);
    const bool slow = std::hypot(1.0 - block.pole_real, block.pole_imaginary) < period_s / kMemoryS;
    keeps_.push_back(modulus >= 1.0 - kOnCircle || slow ? 1 : 0);
    any_keeps_ = any_keeps_ || keeps_.back() != 0;
  }
}

void StateSpaceState::Reset() noexcept {
  std::fill(first.begin(), first.end(), 0.0);
  std::fill(second.begin(), second.end(), 0.0);
}

/// The parts of a step; a friend, so that the coefficients stay closed to everybody else.
struct StateSpaceStep {
  const StateSpaceCoefficients& c;
  StateSpaceState& state;

  // C w, block by block; axes beyond `kLanes` stay 0.
  template <std::size_t kLanes>
  [[nodiscard]] AxisArray Outputs() const noexcept {
    // Lanes side by side in registers; written as loops, GCC 12 puts blocks there and shuffles.
    using Side = Eigen::Array<double, static_cast<int>(kLanes), 1>;
    Side sum = Side::Zero();
    const double* c1 = c.first_output_.data();
    const double* c2 = c.second_output_.data();
    for (std::size_t k = 0; k < c.blocks(); ++k, c1 += kLanes, c2 += kLanes) {
      sum += Eigen::Map<const Side>(c1) * state.first[k] +
             Eigen::Map<const Side>(c2) * state.second[k];
    }
    AxisArray all{};
    std::copy_n(sum.data(), kLanes, all.begin());
    return all;
  }

  // i = go (C w + D v) + excitation, cut off at the limit; returns what is cut off. kAxes 0: any.
  template <std::size_t kAxes>
  [[nodiscard]] AxisArray Drive(const AxisArray& signal, const AxisArray& excitation_a,
                                double limit_a, LawOutput& out) const noexcept {
    const std::size_t axes = kAxes == 0 ? c.axes_ : kAxes;
    AxisArray sum = c.lanes_ == kFewLanes ? Outputs<kFewLanes>() : Outputs<kMaxAxes>();
    AxisArray excess_a{};
    for (std::size_t i = 0; i < axes; ++i) {
      for (std::size_t j = 0; j < axes; ++j) sum[i] += c.direct_[i][j] * signal[j];
      const double wanted_a = c.output_gain_[i] * sum[i] + excitation_a[i];
      const double given_a = std::min(std::max(wanted_a, -limit_a), limit_a);
      out.control_current_a[i] = given_a;
      excess_a[i] = wanted_a - given_a;
      if (excess_a[i] != 0.0) {
        out.saturated_axes = static_cast<std::uint16_t>(out.saturated_axes | (1U << i));
      }
    }
    return excess_a;
  }

  // w <- A w + B v. With a fixed number of axes it is one pass over the states.
  void Advance(const AxisArray& signal) noexcept {
    if (c.axes_ == kFewLanes) {
      AdvanceOf<kFewLanes>(signal);
      return;
    }
    AdvanceOf<0>(signal);
    const std::size_t count = c.blocks();
    double* __restrict next1 = state.next_first.data();
    double* __restrict next2 = state.next_second.data();
    for (std::size_t j = 0; j < c.axes_; ++j) {
      const double* __restrict b1 = c.first_input_.data() + j * count;
      const double* __restrict b2 = c.second_input_.data() + j * count;
      for (std::size_t k = 0; k < count; ++k) {
        next1[k] += b1[k] * signal[j];
        next2[k] += b2[k] * signal[j];
      }
    }
  }

  // The first kAxes columns of B.
  template <std::size_t kAxes>
  void AdvanceOf(const AxisArray& signal) noexcept {
    const std::size_t count = c.blocks();
    double* __restrict next1 = state.next_first.data();
    double* __restrict next2 = state.next_second.data();
    const double* __restrict first = state.first.data();
    const double* __restrict second = state.second.data();
    const double* __restrict re = c.real_.data();
    const double* __restrict im = c.imaginary_.data();
    const double* __restrict b1 = c.first_input_.data();
    const double* __restrict b2 = c.second_input_.data();
    for (std::size_t k = 0; k < count; ++k) {
      double one = re[k] * first[k] + im[k] * second[k];
      double other = re[k] * second[k] - im[k] * first[k];
      for (std::size_t j = 0; j < kAxes; ++j) {
        one += b1[j * count + k] * signal[j];
        other += b2[j * count + k] * signal[j];
      }
      next1[k] = one;
      next2[k] = other;
    }
  }

  // (L16): a block that remembers stays where it is while it would push a limited axis further.
  void HoldMemory(const AxisArray& excess_a) noexcept {
    for (std::size_t k = 0; k < c.blocks(); ++k) {
      if (c.keeps_[k] == 0) continue;
      const double change1 = state.next_first[k] - state.first[k];
      const double change2 = state.next_second[k] - state.second[k];
      bool further = false;
      for (std::size_t i = 0; i < c.axes_; ++i) {
        const double push = c.output_gain_[i] * (c.first_output_[k * c.lanes_ + i] * change1 +
                                                 c.second_output_[k * c.lanes_ + i] * change2);
        further = further || push * excess_a[i] > 0.0;
      }
      if (!further) continue;
      state.next_first[k] = state.first[k];
      state.next_second[k] = state.second[k];
    }
  }
};

LawOutput Step(const StateSpaceCoefficients& coefficients, StateSpaceState& state,
               const AxisArray& error_m, const AxisArray& excitation_a, double limit_a) noexcept {
  StateSpaceStep step{coefficients, state};
  LawOutput out;
  AxisArray signal{};
  for (std::size_t i = 0; i < coefficients.axes(); ++i) {
    signal[i] = -coefficients.input_gain(i) * error_m[i];
  }
  const AxisArray excess_a = coefficients.axes() == kFewLanes
                                 ? step.Drive<kFewLanes>(signal, excitation_a, limit_a, out)
                                 : step.Drive<0>(signal, excitation_a, limit_a, out);
  step.Advance(signal);
  if (out.saturated_axes != 0 && coefficients.any_keeps()) step.HoldMemory(excess_a);
  std::swap(state.first, state.next_first);
  std::swap(state.second, state.next_second);
  return out;
}

}  // namespace levitas::law
