#include "cli/run/progress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace levitas::cli {
namespace {

constexpr double kRpmPerRadPerS = 30.0 / 3.14159265358979323846;
constexpr std::chrono::milliseconds kRedraw{100};  // faster than this nobody reads
constexpr std::chrono::milliseconds kRateWindow{500};

}  // namespace

Progress::Progress(std::vector<std::string> bearings, double period_s, std::FILE* out,
                   bool terminal)
    : bearings_(std::move(bearings)),
      period_s_(period_s),
      out_(out),
      terminal_(terminal),
      largest_m_(bearings_.size(), 0.0) {}

void Progress::Measure(const ProgressSample& sample, Clock::time_point now) {
  for (std::size_t b = 0; b < largest_m_.size() && 2 * b + 1 < sample.position_m.size(); ++b) {
    const double radius_m = std::hypot(sample.position_m[2 * b], sample.position_m[2 * b + 1]);
    largest_m_[b] = std::max(largest_m_[b], radius_m);
  }
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

std::string Progress::Line(const ProgressSample& sample) const {
  std::string line = fmt::format("{:<11}{:>6.0f} rpm ", Name(sample.mode),
                                 std::abs(sample.speed_rad_per_s) * kRpmPerRadPerS);
  for (std::size_t b = 0; b < bearings_.size(); ++b) {
    line += fmt::format("  {} {:>5.1f} um", bearings_[b], largest_m_[b] * 1e6);
  }
  line += fmt::format("  {:>7.2f} s", static_cast<double>(sample.cycle) * period_s_);
  if (times_real_time_ > 0.0) line += fmt::format("  {:.2f} x real time", times_real_time_);
  return line;
}

void Progress::Show(const ProgressSample& sample, Clock::time_point now) {
  Measure(sample, now);
  const bool changed = !started_ || sample.mode != mode_;
  started_ = true;
  mode_ = sample.mode;
  if (!changed && (!terminal_ || now - drawn_time_ < kRedraw)) return;
  drawn_time_ = now;
  if (terminal_) {
    fmt::print(out_, "\r{:<98}", Line(sample));
    drawn_ = true;
  } else {
    fmt::print(out_, "{}\n", Line(sample));
  }
  std::fflush(out_);
  std::fill(largest_m_.begin(), largest_m_.end(), 0.0);
}

void Progress::Close() {
  if (drawn_) fmt::print(out_, "\n");
  drawn_ = false;
  std::fflush(out_);
}

}  // namespace levitas::cli
