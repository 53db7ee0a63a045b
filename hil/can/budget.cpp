#include "hil/can/budget.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace levitas::can {
namespace {

std::string RatesText(const BitRates& rates) {
  if (rates.data_bit_per_s <= 0.0) {
    return fmt::format("classical, {:.4g} Mbit/s", rates.arbitration_bit_per_s * 1e-6);
  }
  return fmt::format("FD, {:.4g} / {:.4g} Mbit/s", rates.arbitration_bit_per_s * 1e-6,
                     rates.data_bit_per_s * 1e-6);
}

/// Rounded down: the printed rate is one that fits.
double WholeHertz(double rate_hz) { return std::floor(rate_hz); }

}  // namespace

bool Budget::fits() const noexcept {
  return std::all_of(buses.begin(), buses.end(), [](const BusLoad& bus) { return bus.fits(); });
}

Budget MakeBudget(const Layout& layout, const std::vector<BusConfig>& buses) {
  Budget budget;
  const double period_s = static_cast<double>(layout.period_ns) * 1e-9;
  budget.rate_hz = 1.0 / period_s;
  budget.highest_rate_hz = std::numeric_limits<double>::infinity();
  budget.buses.reserve(buses.size());
  for (const BusConfig& bus : buses) budget.buses.push_back({.bus = bus});
  for (const Message& message : layout.messages) {
    BusLoad& bus = budget.buses[BusOf(message, buses)];
    const double time_s = WorstFrameSeconds(message.bytes, bus.bus.rates);
    const double load = time_s / (message.every * period_s);
    bus.messages.push_back({message.name, message.bytes, message.every, time_s, load});
    bus.load += load;
    if (message.every > 1) {
      budget.blocking_s = std::max(budget.blocking_s, time_s);
    } else {
      (message.sender == Sender::kRig ? budget.from_rig_s : budget.to_rig_s) += time_s;
    }
  }
  for (BusLoad& bus : budget.buses) {
    bus.highest_rate_hz = bus.load > 0.0 ? budget.rate_hz * bus.bus.load_limit / bus.load
                                         : std::numeric_limits<double>::infinity();
    budget.highest_rate_hz = std::min(budget.highest_rate_hz, bus.highest_rate_hz);
  }
  return budget;
}

LoopDelay DelayOf(const Budget& budget) {
  LoopDelay delay{.from_rig_s = budget.from_rig_s,
                  .arrival_s = kArrivalNs * 1e-9,
                  .answer_s = kAnswerNs * 1e-9,
                  .to_rig_s = budget.to_rig_s};
  const bool held = std::any_of(budget.buses.begin(), budget.buses.end(), [](const BusLoad& bus) {
    return bus.bus.carries != Carries::kFromRig && bus.bus.current_acts == Acts::kAtNextSample;
  });
  const double periods = delay.arrived_s() * budget.rate_hz;
  if (held) delay.hold_s = (std::ceil(periods) - periods) / budget.rate_hz;
  return delay;
}

std::string RefusalText(const Budget& budget) {
  std::string text;
  for (const BusLoad& bus : budget.buses) {
    if (bus.fits()) continue;
    text += fmt::format(
        "CAN bus {} ({}): the loop at {:.0f} Hz would load it to {:.1f} %, allowed {:.0f} %; at "
        "most "
        "{:.0f} Hz fits (sampling period_us {:.1f} or more); else a higher data rate, or one bus "
        "for "
        "each direction (carries: from_rig, carries: to_rig)\n",
        bus.bus.name, RatesText(bus.bus.rates), budget.rate_hz, bus.load * 100.0,
        bus.bus.load_limit * 100.0, WholeHertz(bus.highest_rate_hz),
        std::ceil(1e7 / bus.highest_rate_hz) / 10.0);
  }
  return text;
}

std::string BudgetText(const Budget& budget) {
  std::string text;
  for (const BusLoad& bus : budget.buses) {
    text +=
        fmt::format("bus {} ({}: {})\n", bus.bus.name, bus.bus.interface, RatesText(bus.bus.rates));
    text += "  message                 bytes  every   worst frame     load\n";
    for (const MessageLoad& message : bus.messages) {
      text +=
          fmt::format("  {:<22} {:>6} {:>6} {:>10.1f} us {:>7.1f} %\n", message.name, message.bytes,
                      message.every, message.frame_time_s * 1e6, message.load * 100.0);
    }
    text += fmt::format("  together at {:.0f} Hz {:>36.1f} % of {:.0f} %: {}; at most {:.0f} Hz\n",
                        budget.rate_hz, bus.load * 100.0, bus.bus.load_limit * 100.0,
                        bus.fits() ? "fits" : "DOES NOT FIT", WholeHertz(bus.highest_rate_hz));
  }
  text += fmt::format(
      "on the wire: positions {:.1f} us, currents {:.1f} us, together {:.1f} us ({:.2f} periods); "
      "a "
      "slow frame may add {:.1f} us\n",
      budget.from_rig_s * 1e6, budget.to_rig_s * 1e6, budget.transport_s() * 1e6,
      budget.transport_s() * budget.rate_hz, budget.blocking_s * 1e6);
  const LoopDelay delay = DelayOf(budget);
  text += fmt::format(
      "from sample to current: {:.1f} us on the wire, {:.1f} us until the controller wakes, {:.1f} "
      "us "
      "until it has answered, {:.1f} us until the rig's next sample: {:.2f} periods\n",
      budget.transport_s() * 1e6, delay.arrival_s * 1e6, delay.answer_s * 1e6, delay.hold_s * 1e6,
      delay.total_s() * budget.rate_hz);
  return text;
}

}  // namespace levitas::can
