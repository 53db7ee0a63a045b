#pragma once
// Does a layout fit its buses? Worst-case frame times against the period of the loop.
//
// Load       sum over the messages of a bus of frame time / (every x period).
// Transport  from sample to current: the frames of one period, one behind the other in each
//            direction, both directions added. A frame of lower priority that has just begun adds
//            its own time (`blocking_s`): jitter, not a constant delay.
// Delay      from a sample to its current acting: what LoopDelay lists, in this order. It is the
//            delay of the loop on these buses, for margins, verdict and the simulated rig alike.
// Thread     any; not for the loop.
// Failure    MakeBudget throws std::invalid_argument as layout.hpp does; a budget that does not fit
//            is a value.

#include <cstdint>
#include <string>
#include <vector>

#include "hil/can/layout.hpp"

namespace levitas::can {

struct MessageLoad {
  std::string name;
  std::uint8_t bytes{};
  std::uint32_t every{};
  double frame_time_s{};
  double load{};  ///< share of the bus's time
};

struct BusLoad {
  BusConfig bus;
  std::vector<MessageLoad> messages{};
  double load{};
  double highest_rate_hz{};  ///< of the loop, at the bus's limit
  [[nodiscard]] bool fits() const noexcept { return load <= bus.load_limit; }
};

struct Budget {
  std::vector<BusLoad> buses;
  double rate_hz{};
  double highest_rate_hz{};  ///< that every bus carries
  double from_rig_s{};       ///< positions on the wire
  double to_rig_s{};         ///< currents on the wire
  double blocking_s{};       ///< what a slow frame may add to either
  [[nodiscard]] double transport_s() const noexcept { return from_rig_s + to_rig_s; }
  [[nodiscard]] bool fits() const noexcept;
};

/// [ns] from a whole frame on the wire to the controller's wake-up: two kernels' queues.
inline constexpr std::int64_t kArrivalNs = 30'000;
/// [ns] from the wake-up to the answer in the chip: reading, law, writing. An allowance.
inline constexpr std::int64_t kAnswerNs = 5'000;

/// What lies between a sample and the instant from which its current acts.
struct LoopDelay {
  double from_rig_s{};  ///< positions on the wire
  double arrival_s{};   ///< until the controller wakes
  double answer_s{};    ///< until it has answered
  double to_rig_s{};    ///< currents on the wire
  double hold_s{};      ///< until the rig's next sampling instant, where it waits for that
  [[nodiscard]] double arrived_s() const noexcept {
    return from_rig_s + arrival_s + answer_s + to_rig_s;
  }
  [[nodiscard]] double total_s() const noexcept { return arrived_s() + hold_s; }
};

[[nodiscard]] LoopDelay DelayOf(const Budget& budget);

[[nodiscard]] Budget MakeBudget(const Layout& layout, const std::vector<BusConfig>& buses);

/// One line for each bus that is overloaded: load, limit, the rate that fits, what else would help.
/// Empty when all fit.
[[nodiscard]] std::string RefusalText(const Budget& budget);

/// Table for people: messages with bytes, frame time, load; buses with load and highest rate.
[[nodiscard]] std::string BudgetText(const Budget& budget);

}  // namespace levitas::can
