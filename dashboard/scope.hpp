#pragma once
// A scope on the run's samples: waits for a trigger, then keeps what lay before and after it at
// full rate, all axes together.
//
// Trigger   a position or current of one axis passes `level` (rising, falling or either), the
//           controller trips, or at once. A pass is looked for between two samples that follow each
//           other, and only once `before` samples without a gap lie behind it.
// Memory    the ring is the SampleStore, made with the run; a capture holds at most kMostSamples of
//           every axis, and only the newest capture is kept.
// Gaps      a run that is faster than the clock leaves stretches out (docs/dashboard.md); a capture
//           that a gap would cut is given up, counted, and the scope waits for the next trigger.
// Units     SI, bearing frame. Thread one at a time: the owner locks.
// Failure   none; what cannot be asked for is refused before it comes here.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dashboard/sample_store.hpp"

namespace levitas::dashboard {

enum class ScopeSource : std::uint8_t { kPosition, kCurrent, kTrip, kNow };
enum class ScopeEdge : std::uint8_t { kRising, kFalling, kEither };
enum class ScopeState : std::uint8_t { kIdle, kArmed, kTriggered, kCaptured };

struct ScopeSettings {
  ScopeSource source{ScopeSource::kPosition};
  std::size_t axis{};  ///< of a position or current
  double level{};      ///< [m] or [A]
  ScopeEdge edge{ScopeEdge::kRising};
  std::size_t samples{};  ///< in all, 2 .. kMostSamples
  std::size_t before{};   ///< the trigger, fewer than `samples`
};

/// `before` samples, the one that triggered, and the rest.
struct Capture {
  std::uint64_t number{};  ///< counts captures
  ScopeSettings settings;
  std::uint64_t trigger_cycle{};  ///< of the first sample beyond the level
  double period_s{};
  std::vector<std::vector<float>> position_m, current_a;  ///< per axis
  std::vector<float> speed_rad_per_s;
};

class Scope {
 public:
  static constexpr std::size_t kMostSamples = SampleStore::kCapacity / 2;

  /// Samples that come from the next Advance on can trigger.
  void Arm(const ScopeSettings& settings) noexcept;
  /// The newest capture stays.
  void Stop() noexcept { state_ = ScopeState::kIdle; }
  /// The controller has tripped in that cycle.
  void Tripped(std::uint64_t cycle) noexcept;
  /// After samples were added; true when the state has changed.
  bool Advance(const SampleStore& store);

  [[nodiscard]] ScopeState state() const noexcept { return state_; }
  [[nodiscard]] const ScopeSettings& settings() const noexcept { return settings_; }
  [[nodiscard]] std::uint64_t given_up() const noexcept { return given_up_; }
  [[nodiscard]] const std::shared_ptr<const Capture>& newest() const noexcept { return newest_; }

 private:
  [[nodiscard]] bool Passes(const SampleStore& store, std::size_t back) const noexcept;
  void LookForTrigger(const SampleStore& store);
  void Finish(const SampleStore& store);
  void GiveUp(const SampleStore& store) noexcept;
  [[nodiscard]] float Value(const SampleStore& store, std::size_t back) const noexcept;

  ScopeState state_{ScopeState::kIdle};
  ScopeSettings settings_;
  /// Samples of the store that were looked at; nothing directly after Arm.
  std::optional<std::uint64_t> looked_at_;
  std::optional<std::uint64_t> trip_cycle_;  ///< of a trip that is to trigger
  std::uint64_t trigger_cycle_{0};
  std::uint64_t given_up_{0};
  std::uint64_t captures_{0};
  std::shared_ptr<const Capture> newest_;
};

}  // namespace levitas::dashboard
