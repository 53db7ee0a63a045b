#pragma once
// Drives the simulated rig over the network, in lockstep or in real time.
//
// Lockstep   frame n is sent, and again every 100 ms, until current n answers it; then the plant
//            advances one period. A restarted controller picks up where the last one stopped.
// Real time  its own grid at the whole multiples of the period. Frame n leaves at t_n. The rig
//            sleeps once per period and looks for current n after that sleep, 12 us before
//            t_n+1 (a receiver that sleeps on its socket would cost the controller the wake-up:
//            16 us of a send instead of 3). A current that is not there then is not waited for: the
//            last one acts on and the period is counted as held. When none came for 0.1 s the
//            amplifiers are switched off, as a rig's own watchdog does.
// Thread     Run in one thread; Stop, heard and failed from any.

#include <atomic>
#include <cstdint>

#include "common/histogram.hpp"
#include "controller/rt/clock.hpp"
#include "plant_sim/plant/plant.hpp"
#include "transport/lcm_rig_link.hpp"

namespace levitas::plant_program {

struct PlantStatistics {
  std::uint64_t cycles{};
  std::uint64_t skipped_periods{};  ///< grid instants at which no frame was sent
  std::uint64_t held_currents{};    ///< periods that reused an old current
  std::uint64_t watchdog_trips{};   ///< amplifiers switched off for want of a controller
  std::uint64_t repeated_frames{};  ///< lockstep: sent again for want of an answer
  std::uint64_t stale_currents{};   ///< answers to another frame than the latest
  Histogram wakeup;                 ///< grid instant -> frame leaves
  Histogram advance;                ///< integration of one period, of every 16th
};

struct PlantLoopOptions {
  bool realtime{};
  std::int64_t period_ns{};
  std::uint32_t rig_session{};
  bool stay{};
};

class PlantLoop {
 public:
  /// Keeps references to all of them.
  PlantLoop(const PlantLoopOptions& options, plant::Plant& plant, transport::LcmRigLink& link,
            rt::Clock& clock) noexcept
      : options_(options), plant_(plant), link_(link), clock_(clock) {}

  /// Returns after the controller's goodbye (unless it stays), or after Stop.
  void Run() noexcept;
  void Stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }

  /// Current frames so far.
  [[nodiscard]] std::uint64_t heard() const noexcept {
    return heard_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] const PlantStatistics& statistics() const noexcept { return statistics_; }

 private:
  enum class Step : std::uint8_t { kAdvance, kEnd };

  void RunLockstep() noexcept;
  void RunRealtime() noexcept;
  [[nodiscard]] SensorFrame Sample(std::int64_t sample_time_ns) noexcept;
  [[nodiscard]] bool Ended(transport::LcmRigLink::Answer answer) const noexcept;
  /// Takes what came as the command; a goodbye switches everything off.
  void Take(const CurrentFrame& current) noexcept;
  [[nodiscard]] bool AwaitCurrent(std::uint64_t cycle, std::int64_t deadline_ns,
                                  bool& goodbye) noexcept;
  void Hold() noexcept;
  void Advance() noexcept;

  PlantLoopOptions options_;
  plant::Plant& plant_;
  transport::LcmRigLink& link_;
  rt::Clock& clock_;
  PlantStatistics statistics_;
  plant::PlantCommand command_{.amplifiers_enabled = false};
  std::uint64_t held_in_a_row_{0};
  bool answered_once_{false};
  std::uint32_t status_{0};
  std::atomic<std::uint64_t> heard_{0};
  std::atomic<bool> stopped_{false};
};

}  // namespace levitas::plant_program
