#pragma once
// Controller and simulated rig in one process and in virtual time: the real control loop and the
// real loop of the rig, each with a clock and a line of this bench.
//
// Time       nanoseconds since the bench began. It passes only while somebody waits: the
//            controller's waits let the rig run, whose loop is a fiber of its own. Nothing depends
//            on the machine.
// Line       what leaves at a time arrives `way` later unless its mailbox was told otherwise. The
//            default ways leave the currents 35 us before the rig looks for them.
// Watching   `on_sample` after each period of the rig, with the plant itself, not with what the
//            sensors say of it, before the frame leaves (and may be falsified by it); `on_wait`
//            whenever the controller waits for its next period.
// Thread     one per bench; many benches may run at once.
// Not done   the programs around the loops (threads, partners, files); lockstep.

#include <functional>
#include <memory>

#include "benchmark/lives/fiber.hpp"
#include "benchmark/lives/mailbox.hpp"
#include "common/frames.hpp"
#include "common/rig_link.hpp"
#include "common/rig_port.hpp"
#include "plant_sim/loop/plant_loop.hpp"
#include "plant_sim/plant/plant.hpp"
#include "rt/clock.hpp"

namespace levitas::lives {

/// Currents on their way, with what says that they are the last.
struct CurrentLetter {
  CurrentFrame frame;
  bool goodbye{};
};

struct BenchOptions {
  std::int64_t period_ns{100'000};
  std::uint32_t watchdog_periods{1000};
  bool keeps_order{};  ///< older messages are dropped: a sealed network, a CAN bus
  std::uint64_t seed{1};
  std::int64_t frame_way_ns{20'000};
  std::int64_t current_way_ns{15'000};
  std::int64_t compute_ns{8'000};  ///< from a frame read to its current sent
};

class VirtualBench {
 public:
  using OnSample = std::function<void(std::int64_t now_ns, const plant::Plant&, bool energised,
                                      SensorFrame& frame)>;
  using OnWait = std::function<void(std::int64_t now_ns)>;

  /// The rotor rests in its touchdown bearings; the rig runs from the first wait on.
  VirtualBench(const BenchOptions& options, std::shared_ptr<const plant::PlantModel> model);
  ~VirtualBench();

  OnSample on_sample;
  OnWait on_wait;

  [[nodiscard]] rt::Clock& clock() noexcept { return controller_clock_; }
  [[nodiscard]] port::RigPort& port() noexcept { return port_; }
  [[nodiscard]] Mailbox<SensorFrame>& frames() noexcept { return frames_; }
  [[nodiscard]] Mailbox<CurrentLetter>& currents() noexcept { return currents_; }
  [[nodiscard]] std::int64_t now_ns() const noexcept { return now_ns_; }
  [[nodiscard]] plant::Plant& plant() noexcept { return plant_; }

  /// Time without a controller.
  void Pass(std::int64_t until_ns);
  /// From here on the present controller neither hears nor sends: it has been killed. Its loop has
  /// to be told to end (Abort). `Revive` is the next one's.
  void Kill() noexcept { dead_ = true; }
  void Revive() noexcept { dead_ = false; }
  /// The controller's next wake-up comes so much later.
  void Stall(std::int64_t late_ns) noexcept { stall_ns_ += late_ns; }
  /// The rig's program ends and another one begins after `off_ns`, without currents meanwhile.
  void RestartRig(std::int64_t off_ns) noexcept;

 private:
  class ControllerClock final : public rt::Clock {
   public:
    explicit ControllerClock(VirtualBench& bench) : bench_(bench) {}
    std::int64_t NowNs() noexcept override { return bench_.now_ns_; }
    void SleepUntil(std::int64_t due_ns) noexcept override;

   private:
    VirtualBench& bench_;
  };
  class RigClock final : public rt::Clock {
   public:
    explicit RigClock(VirtualBench& bench) : bench_(bench) {}
    std::int64_t NowNs() noexcept override { return bench_.rig_ns_; }
    void SleepUntil(std::int64_t due_ns) noexcept override;

   private:
    VirtualBench& bench_;
  };
  class Port final : public port::RigPort {
   public:
    explicit Port(VirtualBench& bench) : bench_(bench) {}
    port::ReadResult Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept override;
    bool Write(const CurrentFrame& frame) noexcept override;
    [[nodiscard]] port::PortCounters counters() const noexcept override { return {}; }
    void SayGoodbye(const CurrentFrame& last) noexcept override;

   private:
    VirtualBench& bench_;
  };
  class Link final : public port::RigLink {
   public:
    explicit Link(VirtualBench& bench) : bench_(bench) {}
    bool Send(const SensorFrame& frame) noexcept override;
    ReceiveResult Receive(CurrentFrame& frame, std::int64_t deadline_ns) noexcept override;
    [[nodiscard]] Counters counters() const noexcept override { return {}; }

   private:
    VirtualBench& bench_;
  };

  void RunRig();
  void RestBetweenRigs();
  /// The rig's turns up to this instant.
  void LetRigRun(std::int64_t until_ns) noexcept;

  BenchOptions options_;
  plant::Plant plant_;
  ControllerClock controller_clock_{*this};
  RigClock rig_clock_{*this};
  Port port_{*this};
  Link link_{*this};
  Mailbox<SensorFrame> frames_;
  Mailbox<CurrentLetter> currents_;
  std::int64_t now_ns_{0};
  std::int64_t rig_ns_{0};
  std::int64_t rig_wake_ns_{0};
  std::int64_t stall_ns_{0};
  std::int64_t rig_off_ns_{0};
  std::uint32_t rig_session_{1};
  std::uint64_t currents_sent_{0};
  bool dead_{false};
  bool over_{false};
  plant_run::PlantLoop* rig_{nullptr};
  Fiber fiber_;
};

}  // namespace levitas::lives
