#pragma once
// Drives the simulated rig over the network, in lockstep or in real time.
//
// Lockstep   frame n is sent, and again every 100 ms, until current n answers it; then the plant
//            advances one period. A restarted controller picks up where the last one stopped.
//            With `pace_factor` above 0 the periods are held to the clock (pacer.hpp).
// Real time  its own grid at the whole multiples of the period. Frame n leaves at t_n. The rig
//            sleeps once per period and looks for current n after that sleep, 12 us before
//            t_n+1 (a receiver that sleeps on its socket would cost the controller the wake-up:
//            16 us of a send instead of 3). A current that is not there then is not waited for: the
//            last one acts on and the period is counted as held.
// Watchdog   when no new current, late or in time, came for `watchdog_periods` in a row, the
//            amplifiers are switched off and stay off until a controller has asked for just that.
//            In lockstep periods do not pass by themselves: a controller that stays silent for
//            `silence_ns` of the machine's time is taken for dead, and the rotor moves on without
//            it (0: never).
// Torsion    batches of the gauges leave before the frame of the instant that completes them.
// Gate       the rig's own lines, where it has some: they may keep the amplifiers off.
// Thread     Run in one thread; Stop, heard, energised, driven and TakeEvent from any one other.

#include <atomic>
#include <cstdint>

#include "common/histogram.hpp"
#include "common/rig_link.hpp"
#include "common/spsc_ring.hpp"
#include "plant_sim/loop/timed_events.hpp"
#include "plant_sim/plant/plant.hpp"
#include "rt/clock.hpp"

namespace levitas::plant_run {

class TorsionGauge;

struct PlantStatistics {
  std::uint64_t cycles{};
  std::uint64_t skipped_periods{};  ///< grid instants at which no frame was sent
  std::uint64_t held_currents{};    ///< periods that reused an old current
  std::uint64_t watchdog_trips{};   ///< amplifiers switched off for want of a controller
  std::uint64_t repeated_frames{};  ///< lockstep: sent again for want of an answer
  std::uint64_t stale_currents{};   ///< answers to another frame than the latest
  std::uint64_t landings{};         ///< falls onto the touchdown bearings after switching off
  Histogram wakeup;                 ///< grid instant -> frame leaves
  Histogram advance;                ///< integration of one period, of every 16th
};

struct PlantLoopOptions {
  bool realtime{};
  double pace_factor{0.0};  ///< lockstep: periods T / pace_factor of the clock apart; 0: at once
  std::int64_t period_ns{};
  std::uint32_t rig_session{};
  bool stay{};
  std::uint32_t watchdog_periods{1000};
  std::int64_t silence_ns{0};
};

/// What happened at the rig, for people.
enum class RigEventKind : std::uint8_t {
  kEnergised,    ///< amplifiers on
  kSwitchedOff,  ///< amplifiers off as commanded
  kGateShut,     ///< amplifiers off by the rig's own lines
  kWatchdog,     ///< amplifiers off for want of currents; value: periods without one
  kRearmed,      ///< a controller asked for amplifiers off: the watchdog lets it begin anew
  kLanded,       ///< on the touchdown bearings after switching off; value: [N] of the first contact
};

struct RigNotice {
  RigEventKind kind{};
  std::uint64_t cycle{};
  double value{};
};

/// The rig's own lines.
class AmplifierGate {
 public:
  struct State {
    bool open{true};             ///< amplifiers may drive current
    std::uint32_t rig_status{};  ///< RigStatus bits to report
  };
  virtual ~AmplifierGate() = default;
  /// Loop thread, once each period; never waits.
  [[nodiscard]] virtual State Sample(std::int64_t now_ns) noexcept = 0;
  /// Loop thread, once each period: where the shaft stands.
  virtual void Turn(double /*angle_rad*/) noexcept {}
};

class PlantLoop {
 public:
  /// Keeps references to all of them.
  PlantLoop(const PlantLoopOptions& options, plant::Plant& plant, port::RigLink& link,
            rt::Clock& clock, AmplifierGate* gate = nullptr, TimedEvents* timed = nullptr,
            TorsionGauge* torsion = nullptr)
      : options_(options),
        plant_(plant),
        link_(link),
        clock_(clock),
        gate_(gate),
        timed_events_(timed),
        torsion_(torsion) {}

  /// Returns after the controller's goodbye (unless it stays), or after Stop.
  void Run() noexcept;
  void Stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }

  /// Current frames so far.
  [[nodiscard]] std::uint64_t heard() const noexcept {
    return heard_.load(std::memory_order_relaxed);
  }
  /// The amplifiers drive current.
  [[nodiscard]] bool energised() const noexcept {
    return energised_.load(std::memory_order_relaxed);
  }
  /// The drive has a command: it runs the rotor, or brakes it.
  [[nodiscard]] bool driven() const noexcept { return driven_.load(std::memory_order_relaxed); }
  /// The next event, oldest first; false when there is none.
  bool TakeEvent(RigNotice& event) noexcept { return events_.Take(event); }
  [[nodiscard]] const PlantStatistics& statistics() const noexcept { return statistics_; }

 private:
  void RunLockstep() noexcept;
  void RunRealtime() noexcept;
  [[nodiscard]] SensorFrame Sample(std::int64_t sample_time_ns) noexcept;
  /// Takes what came as the command; a goodbye switches everything off.
  void Take(const CurrentFrame& current) noexcept;
  [[nodiscard]] bool AwaitCurrent(std::uint64_t cycle, std::int64_t deadline_ns,
                                  bool& goodbye) noexcept;
  void Hold() noexcept;
  /// Lockstep: the periods that a dead controller would have to answer, until the rotor lies.
  void GoOnAlone() noexcept;
  void Advance() noexcept;
  /// The command as the watchdog and the lines let it pass.
  [[nodiscard]] plant::PlantCommand Allowed() noexcept;
  void NoteEnergised(bool energised, RigEventKind why) noexcept;
  void NoteContact() noexcept;

  PlantLoopOptions options_;
  plant::Plant& plant_;
  port::RigLink& link_;
  rt::Clock& clock_;
  AmplifierGate* gate_;
  TimedEvents* timed_events_;
  TorsionGauge* torsion_;  ///< null: no coupling is measured
  SpscRing<RigNotice> events_{256};
  PlantStatistics statistics_;
  plant::PlantCommand command_{.amplifiers_enabled = false};
  std::uint64_t held_in_a_row_{0};  ///< periods since a new current came, late or in time
  std::uint64_t taken_cycle_{0};    ///< frame that the latest current taken answers
  bool late_{false};                ///< a new current came in this period, for an earlier frame
  bool answered_once_{false};
  bool latched_{false};                 ///< the watchdog keeps the amplifiers off
  std::atomic<bool> energised_{false};  ///< as the plant was driven in the latest period
  std::atomic<bool> driven_{false};     ///< by the newest command
  bool falling_{false};                 ///< switched off and not yet landed
  std::uint32_t status_{0};
  std::uint32_t gate_status_{0};
  std::atomic<std::uint64_t> heard_{0};
  std::atomic<bool> stopped_{false};
};

}  // namespace levitas::plant_run
