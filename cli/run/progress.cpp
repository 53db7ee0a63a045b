#include "cli/run/progress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/rotational_speed.hpp"

namespace levitas::cli {
namespace {

constexpr std::chrono::milliseconds kRedraw{100};  // faster than this nobody reads
constexpr std::chrono::milliseconds kRateWindow{500};

double Rpm(double speed_rad_per_s) { return RadPerSToRpm(std::abs(speed_rad_per_s)); }

}  // namespace

Progress::Progress(std::vector<std::string> bearings, double period_s, Out out, bool terminal)
    : bearings_(std::move(bearings)),
      period_s_(period_s),
      out_(std::move(out)),
      terminal_(terminal),
      largest_m_(bearings_.size(), 0.0) {}

void Progress::Measure(const ProgressSample& sample, Clock::time_point now) {
  for (std::size_t b = 0; b < largest_m_.size() && 2 * b + 1 < sample.position_m.size(); ++b) {
    const double radius_m = std::hypot(sample.position_m[2 * b], sample.position_m[2 * b + 1]);
    largest_m_[b] = std::max(largest_m_[b], radius_m);
  }
  top_rpm_ = std::max(top_rpm_, Rpm(sample.speed_rad_per_s));
  if (!started_ || sample.cycle < rate_cycle_) {  // first sample, or the controller restarted
    rate_cycle_ = sample.cycle;
    rate_time_ = now;
    return;
  }
  const std::chrono::duration<double> passed = now - rate_time_;
  if (passed < kRateWindow) return;
  times_real_time_ = static_cast<double>(sample.cycle - rate_cycle_) * period_s_ / passed.count();
  rate_cycle_ = sample.cycle;
  rate_time_ = now;
}

std::string Progress::Orbits() const {
  std::string text;
  for (std::size_t b = 0; b < bearings_.size(); ++b) {
    text += fmt::format("  {} {:>5.1f} um", bearings_[b], largest_m_[b] * 1e6);
  }
  return text;
}

std::string Progress::Time(const ProgressSample& sample) const {
  std::string text = fmt::format("  {:>7.2f} s", static_cast<double>(sample.cycle) * period_s_);
  if (times_real_time_ > 0.0) text += fmt::format("  {:.2f} x real time", times_real_time_);
  return text;
}

void Progress::Redraw(const ProgressSample& sample) {
  const std::string line =
      fmt::format("{:<11}{:>6.0f} rpm ", Name(sample.mode), Rpm(sample.speed_rad_per_s)) +
      Orbits() + Time(sample);
  out_(fmt::format("\r{:<98}", line));
  drawn_ = true;
}

void Progress::Tell(const ProgressSample& sample) const {
  std::string line = fmt::format("{:<11}", Name(sample.mode)) + Time(sample);
  if (started_) {
    line = fmt::format("{:<40}  {} before: up to {:.0f} rpm,{}", line, Name(mode_), top_rpm_,
                       Orbits());
  }
  out_(line + "\n");
}

void Progress::Show(const ProgressSample& sample, Clock::time_point now) {
  const bool changed = !started_ || sample.mode != mode_;
  // In a log the figures are those of the mode that has ended, so this sample is not yet one.
  if (changed && !terminal_) {
    Tell(sample);
    Forget();
  }
  Measure(sample, now);
  started_ = true;
  mode_ = sample.mode;
  if (terminal_ && (changed || now - drawn_time_ >= kRedraw)) {
    drawn_time_ = now;
    Redraw(sample);
    Forget();
  }
}

void Progress::Forget() {
  std::fill(largest_m_.begin(), largest_m_.end(), 0.0);
  top_rpm_ = 0.0;
}

void Progress::Close() {
  if (drawn_) out_("\n");
  drawn_ = false;
}

}  // namespace levitas::cli
