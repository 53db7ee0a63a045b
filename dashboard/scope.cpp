#include "dashboard/scope.hpp"

#include <algorithm>

namespace levitas::dashboard {
namespace {

template <class Value>
std::vector<float> Window(std::size_t samples, std::size_t newest_back, Value value) {
  std::vector<float> window;
  window.reserve(samples);
  for (std::size_t i = 0; i < samples; ++i) window.push_back(value(newest_back + samples - 1 - i));
  return window;
}

}  // namespace

void Scope::Arm(const ScopeSettings& settings) noexcept {
  settings_ = settings;
  settings_.samples = std::clamp<std::size_t>(settings.samples, 2, kMostSamples);
  settings_.before = std::min(settings.before, settings_.samples - 1);
  looked_at_.reset();
  trip_cycle_.reset();
  state_ = ScopeState::kArmed;
}

void Scope::Tripped(std::uint64_t cycle) noexcept {
  if (state_ == ScopeState::kArmed && settings_.source == ScopeSource::kTrip) trip_cycle_ = cycle;
}

float Scope::Value(const SampleStore& store, std::size_t back) const noexcept {
  return settings_.source == ScopeSource::kCurrent ? store.Current(settings_.axis, back)
                                                   : store.Position(settings_.axis, back);
}

/// Whether the sample passes the level that the one before it had not.
bool Scope::Passes(const SampleStore& store, std::size_t back) const noexcept {
  if (settings_.source == ScopeSource::kNow) return true;
  const auto level = static_cast<float>(settings_.level);
  const float before = Value(store, back + 1);
  const float now = Value(store, back);
  const bool rises = before < level && now >= level;
  const bool falls = before > level && now <= level;
  return (rises && settings_.edge != ScopeEdge::kFalling) ||
         (falls && settings_.edge != ScopeEdge::kRising);
}

void Scope::LookForTrigger(const SampleStore& store) {
  if (settings_.source == ScopeSource::kTrip) {
    // Samples and the word of the trip come on different ways; either may be first.
    if (!trip_cycle_ || *trip_cycle_ > store.newest_cycle()) return;
    trigger_cycle_ = *trip_cycle_;
    state_ = ScopeState::kTriggered;
    return;
  }
  const auto fresh = static_cast<std::size_t>(std::min<std::uint64_t>(
      store.count() - looked_at_.value_or(store.count()), store.contiguous()));
  for (std::size_t back = fresh; back-- > 0;) {
    // One more than `before`: a pass is seen between two samples.
    const std::size_t behind = store.contiguous() - 1 - back;
    if (behind < std::max<std::size_t>(settings_.before, 1) || !Passes(store, back)) continue;
    trigger_cycle_ = store.newest_cycle() - back;
    state_ = ScopeState::kTriggered;
    return;
  }
}

void Scope::Finish(const SampleStore& store) {
  if (store.newest_cycle() < trigger_cycle_) return GiveUp(store);
  const auto after = static_cast<std::size_t>(store.newest_cycle() - trigger_cycle_);
  const std::size_t wanted_after = settings_.samples - 1 - settings_.before;
  // The run of samples without a gap must reach back to the beginning of the window.
  if (store.contiguous() < after + 1 + settings_.before) return GiveUp(store);
  if (after < wanted_after) return;
  const std::size_t newest_back = after - wanted_after;
  auto capture = std::make_shared<Capture>();
  capture->number = ++captures_;
  capture->settings = settings_;
  capture->trigger_cycle = trigger_cycle_;
  capture->period_s = store.period_s();
  for (std::size_t axis = 0; axis < store.axes(); ++axis) {
    capture->position_m.push_back(Window(settings_.samples, newest_back, [&](std::size_t back) {
      return store.Position(axis, back);
    }));
    capture->current_a.push_back(Window(settings_.samples, newest_back, [&](std::size_t back) {
      return store.Current(axis, back);
    }));
  }
  capture->speed_rad_per_s =
      Window(settings_.samples, newest_back, [&](std::size_t back) { return store.Speed(back); });
  newest_ = std::move(capture);
  state_ = ScopeState::kCaptured;
}

void Scope::GiveUp(const SampleStore& store) noexcept {
  ++given_up_;
  looked_at_ = store.count();
  trip_cycle_.reset();
  state_ = ScopeState::kArmed;
}

bool Scope::Advance(const SampleStore& store) {
  const ScopeState before = state_;
  const std::uint64_t given_up = given_up_;
  if (state_ == ScopeState::kIdle || state_ == ScopeState::kCaptured) return false;
  if (state_ == ScopeState::kArmed) LookForTrigger(store);
  if (state_ == ScopeState::kTriggered) Finish(store);
  looked_at_ = store.count();
  return state_ != before || given_up_ != given_up;
}

}  // namespace levitas::dashboard
