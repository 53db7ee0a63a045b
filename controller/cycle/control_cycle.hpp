#pragma once
// The control cycle: check -> supervise -> law, as one pure step. Reading before and writing and
// recording after are done by whoever owns a port (loop/control_loop.hpp in programs; replay and
// tests call Step directly).
//
// Determinism  same config, same inputs, same bits; no clock, no I/O.
// Thread       loop thread only; Step allocates nothing, locks nothing, throws nothing.
// Failure      a fault never leaves Step as an error: it is latched in the outputs, and the safe
//              state of docs/safety.md follows.
// Not done     no timing: a stage observer may take time stamps between the stages.

#include <memory>

#include "common/rig_numbers.hpp"
#include "controller/bias/bias_config.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "controller/law/law_config.hpp"
#include "controller/law/own_law.hpp"
#include "controller/supervisor/supervisor_config.hpp"
#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::supervisor {
struct Decision;
}  // namespace levitas::supervisor

namespace levitas::cycle {

struct CycleConfig {
  RigNumbers rig;
  law::LawConfig law;
  supervisor::SupervisorConfig supervisor;
  synchronous::SynchronousConfig synchronous{};
  bias::BiasConfig bias{};
};

/// The stages a cycle's time is attributed to.
enum class Stage : std::uint8_t {
  kNone = 0,
  kWait = 1,
  kRead = 2,
  kCheck = 3,
  kSupervise = 4,
  kLaw = 5,
  kWrite = 6,
  kRecord = 7
};
inline constexpr std::size_t kStageCount = 8;

/// Told when a stage of Step has ended; the default does nothing.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void Ended(Stage stage) noexcept = 0;
};

class ControlCycle {
 public:
  /// Allocates all it needs. Throws std::invalid_argument when the law's axes do not fit the rig.
  explicit ControlCycle(const CycleConfig& config);
  /// The same around a law of one's own: of config.law only current_limit_a counts. Throws as
  /// above, and without a law.
  ControlCycle(const CycleConfig& config, std::unique_ptr<law::OwnLaw> own);
  ~ControlCycle();
  ControlCycle(ControlCycle&&) noexcept;
  ControlCycle& operator=(ControlCycle&&) noexcept;

  CycleOutputs Step(const CycleInputs& in, StageObserver* observer = nullptr) noexcept;

  /// What the supervisor decided in the latest Step: finer state than Mode, cycle of the trip.
  [[nodiscard]] const supervisor::Decision& decision() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::cycle
