#include "controller/scenario/signal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace levitas::scenario {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::uint64_t WholeCycles(double time_s, double period_s) {
  return static_cast<std::uint64_t>(std::max(0LL, std::llround(time_s / period_s)));
}

}  // namespace

Signal::Signal(const Excitation& config, double period_s)
    : kind_(config.kind),
      sequence_(config.order, config.start),
      random_(config.seed),
      divisor_(std::max<std::uint32_t>(config.divisor, 1)),
      low_share_(config.low_share),
      from_hz_(config.from_hz),
      to_hz_(config.to_hz),
      linear_(config.linear),
      steps_(std::max<std::uint32_t>(config.frequencies, 1)),
      dwell_cycles_(std::max<std::uint64_t>(WholeCycles(config.dwell_s, period_s), 1)),
      repeat_cycles_(WholeCycles(config.repeat_s, period_s)),
      width_cycles_(std::max<std::uint64_t>(WholeCycles(config.width_s, period_s), 1)),
      period_s_(period_s) {
  if (kind_ == SignalKind::kSteppedSine) repeat_cycles_ = steps_ * dwell_cycles_;
  if (kind_ == SignalKind::kMultisine) FillMultisine(config, period_s);
}

// Schroeder's phases of N equal lines, phi_k = -pi k (k - 1)/N, spread them evenly over the period.
void Signal::FillMultisine(const Excitation& config, double period_s) {
  repeat_cycles_ = std::max<std::uint64_t>(repeat_cycles_, 2);
  const double line_hz = 1.0 / (static_cast<double>(repeat_cycles_) * period_s);
  const auto first =
      static_cast<std::uint64_t>(std::max(1.0, std::ceil(config.from_hz / line_hz - 1e-9)));
  const auto last = std::min<std::uint64_t>(
      static_cast<std::uint64_t>(std::max(0.0, std::floor(config.to_hz / line_hz + 1e-9))),
      (repeat_cycles_ - 1) / 2);
  table_.assign(repeat_cycles_, 0.0);
  std::vector<double> cosine(repeat_cycles_);
  std::vector<double> sine(repeat_cycles_);
  for (std::uint64_t n = 0; n < repeat_cycles_; ++n) {
    const double angle = kTwoPi * static_cast<double>(n) / static_cast<double>(repeat_cycles_);
    cosine[n] = std::cos(angle);
    sine[n] = std::sin(angle);
  }
  const double lines = static_cast<double>(last >= first ? last - first + 1 : 1);
  for (std::uint64_t line = first; line <= last; ++line) {
    const double k = static_cast<double>(line - first + 1);
    const double phase = -std::numbers::pi * k * (k - 1.0) / lines;
    const double in_phase = std::cos(phase);
    const double across = std::sin(phase);
    for (std::uint64_t n = 0; n < repeat_cycles_; ++n) {
      // A line takes its values from one turn: a thousand lines cost no cosine each.
      const std::size_t turn = line * n % repeat_cycles_;
      table_[n] += in_phase * cosine[turn] - across * sine[turn];
    }
  }
  double peak = 0.0;
  for (const double value : table_) peak = std::max(peak, std::abs(value));
  for (double& value : table_) value /= peak > 0.0 ? peak : 1.0;
}

double Signal::NextBit() noexcept {
  if (cycle_++ % divisor_ == 0) {
    present_ = sequence_.Next() ? 1.0 : -1.0;
    if (kind_ == SignalKind::kPaprbs) {
      present_ *= low_share_ + (1.0 - low_share_) * random_.Uniform();
    }
  }
  return present_;
}

double Signal::StepHz() const noexcept {
  if (steps_ < 2) return from_hz_;
  const std::uint64_t step = cycle_ / dwell_cycles_;
  const double share = static_cast<double>(step) / static_cast<double>(steps_ - 1);
  return linear_ ? from_hz_ + share * (to_hz_ - from_hz_)
                 : from_hz_ * std::pow(to_hz_ / from_hz_, share);
}

// In the middle of the coming period, so that the phase adds up as the integral does.
double Signal::SweepHz() const noexcept {
  const double share = repeat_cycles_ == 0 ? 0.0
                                           : (static_cast<double>(cycle_) + 0.5) /
                                                 static_cast<double>(repeat_cycles_);
  return linear_ ? from_hz_ + share * (to_hz_ - from_hz_)
                 : from_hz_ * std::pow(to_hz_ / from_hz_, share);
}

double Signal::NextSine() noexcept {
  const double value = std::sin(kTwoPi * phase_turns_);
  phase_turns_ += (kind_ == SignalKind::kChirp ? SweepHz() : StepHz()) * period_s_;
  phase_turns_ -= std::floor(phase_turns_);
  if (++cycle_ == repeat_cycles_) {
    cycle_ = 0;
    // The same sweep again, or a frequency response would find no period in it.
    if (kind_ == SignalKind::kChirp) phase_turns_ = 0.0;
  }
  return value;
}

double Signal::Next() noexcept {
  switch (kind_) {
    case SignalKind::kPrbs:
    case SignalKind::kPaprbs:
      return NextBit();
    case SignalKind::kSteppedSine:
    case SignalKind::kChirp:
      return NextSine();
    case SignalKind::kMultisine: {
      const double value = table_[cycle_];
      if (++cycle_ == repeat_cycles_) cycle_ = 0;
      return value;
    }
    case SignalKind::kImpulse: {
      const double value = cycle_ < width_cycles_ ? 1.0 : 0.0;
      if (++cycle_ == repeat_cycles_) cycle_ = 0;
      return value;
    }
  }
  return 0.0;
}

}  // namespace levitas::scenario
