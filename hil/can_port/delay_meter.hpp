#pragma once
// How long it takes on these buses from a sample until its current is with the rig: measured, by
// the cycle that a current sends back.
//
// Input    every data frame of both directions with the kernel's time stamp. On a real bus that of
//          a frame of ours is its end on the wire, as its driver loops it back; that of the rig's
//          is its end, too, and the sampling instant lies `from_rig_ns` before it.
// Virtual  nothing takes time on such a bus: both times on the wire are added, as they are to the
//          delay with which the rig is simulated.
// Hold     what the rig does with a current that is there cannot be seen from here; where the rig's
//          file says that it acts at the next sampling instant, the delay is rounded up to that.
// Thread   one for Take, any for figures; no allocation after construction.

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "common/histogram.hpp"
#include "hil/can/budget.hpp"
#include "hil/can/codec.hpp"

namespace levitas::can_port {

struct DelayFigures {
  std::uint64_t count{};
  double least_periods{};
  double median_periods{};
  double p99_periods{};
  double most_periods{};
};

class DelayMeter {
 public:
  DelayMeter(const can::Layout& layout, const can::Budget& budget, bool virtual_bus);

  void Take(const can::WireFrame& frame) noexcept;
  /// Until the currents are there.
  [[nodiscard]] DelayFigures Arrived() const;
  /// Until they act.
  [[nodiscard]] DelayFigures Acting() const;

 private:
  // The buses are read one after the other, each as far as it goes: a tenth of a second at 10 kHz.
  static constexpr std::size_t kRemembered = 1024;
  struct Pair {
    std::uint32_t cycle{UINT32_MAX};
    std::int64_t sampled_ns{};  ///< end of the positions; 0: not seen
    std::int64_t sent_ns{};     ///< end of the currents; 0: not seen
  };
  void Add(std::int64_t delay_ns) noexcept;

  std::vector<can::MessageCodec> codecs_;
  std::uint32_t last_positions_id_{};
  std::uint32_t last_currents_id_{};
  std::int64_t from_rig_ns_{};
  std::int64_t added_ns_{};
  double period_ns_{};
  bool held_{};
  can::Values values_;
  std::array<Pair, kRemembered> pairs_{};
  mutable std::mutex mutex_;
  Histogram arrived_;
  std::int64_t least_ns_{INT64_MAX};
};

}  // namespace levitas::can_port
