#include "hil/can_port/delay_meter.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::can_port {
namespace {

/// Jitter of the stamps: a current that is there so much after a sampling instant was in time.
constexpr double kInTimePeriods = 0.02;
/// The rig's watchdog and the supervisor have acted long before.
constexpr double kLongestPeriods = 64.0;

}  // namespace

DelayMeter::DelayMeter(const can::Layout& layout, const can::Budget& budget, bool virtual_bus)
    : from_rig_ns_(virtual_bus ? 0 : std::llround(budget.from_rig_s * 1e9)),
      added_ns_(virtual_bus ? std::llround(budget.transport_s() * 1e9) : 0),
      period_ns_(static_cast<double>(layout.period_ns)),
      held_(can::DelayOf(budget).hold_s > 0.0) {
  for (const can::Message& message : layout.messages) {
    if (message.every > 1) continue;
    codecs_.emplace_back(message, layout.format);
    // Of several of one frame the last one completes it; they are sent in the order of the layout.
    (message.sender == can::Sender::kRig ? last_positions_id_ : last_currents_id_) = message.id;
  }
}

void DelayMeter::Take(const can::WireFrame& frame) noexcept {
  if (frame.id != last_positions_id_ && frame.id != last_currents_id_) return;
  const auto codec = std::find_if(codecs_.begin(), codecs_.end(), [&](const auto& candidate) {
    return candidate.message().id == frame.id;
  });
  if (codec == codecs_.end() || frame.received_ns == 0 || !codec->Decode(frame, values_)) return;
  Pair& pair = pairs_[values_.cycle_low % kRemembered];
  if (pair.cycle != values_.cycle_low) pair = {.cycle = values_.cycle_low};
  std::int64_t& instant_ns = frame.id == last_positions_id_ ? pair.sampled_ns : pair.sent_ns;
  if (instant_ns != 0) return;  // a current that is repeated is no measurement
  instant_ns = frame.received_ns;
  if (pair.sampled_ns != 0 && pair.sent_ns != 0) {
    Add(pair.sent_ns - pair.sampled_ns + from_rig_ns_ + added_ns_);
  }
}

void DelayMeter::Add(std::int64_t delay_ns) noexcept {
  if (delay_ns < 0 || static_cast<double>(delay_ns) > kLongestPeriods * period_ns_) return;
  const std::lock_guard lock(mutex_);
  arrived_.Add(delay_ns);
  least_ns_ = std::min(least_ns_, delay_ns);
}

DelayFigures DelayMeter::Arrived() const {
  const std::lock_guard lock(mutex_);
  if (arrived_.count() == 0) return {};
  return {.count = arrived_.count(),
          .least_periods = static_cast<double>(least_ns_) / period_ns_,
          .median_periods = arrived_.Percentile(0.5) / period_ns_,
          .p99_periods = arrived_.Percentile(0.99) / period_ns_,
          .most_periods = static_cast<double>(arrived_.max_ns()) / period_ns_};
}

DelayFigures DelayMeter::Acting() const {
  DelayFigures figures = Arrived();
  if (!held_) return figures;
  for (double* periods : {&figures.least_periods, &figures.median_periods, &figures.p99_periods,
                          &figures.most_periods}) {
    *periods = std::ceil(*periods - kInTimePeriods);
  }
  return figures;
}

}  // namespace levitas::can_port
