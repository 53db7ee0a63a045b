#include "controller/loop/excitation_pool.hpp"

#include <algorithm>
#include <utility>

namespace levitas::loop {

ExcitationPool::Slot* ExcitationPool::Put(const scenario::Step& step, double period_s) {
  const auto free = std::find_if(slots_.begin(), slots_.end(), [](const Slot& slot) {
    return !slot.taken_.load(std::memory_order_acquire);
  });
  if (free == slots_.end()) return nullptr;
  scenario::ScenarioConfig config;
  config.name = "excitation";
  config.steps.push_back(step);
  free->player_.emplace(std::move(config), period_s, 0.0);  // it waits for no standstill
  free->taken_.store(true, std::memory_order_relaxed);
  return &*free;
}

bool ExcitationPool::Slot::AddTo(cycle::OperatorInput& input, const OperatorView& view) noexcept {
  const scenario::PlayerOutput played =
      player_->Next(view.mode, view.speed_rad_per_s, view.fault, false, view.radius_m);
  reduced_ = played.gain < scenario::OrbitLimiter::kWhole;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    input.excitation_a[i] += played.excitation_a[i];
    input.excitation_m[i] += played.excitation_m[i];
  }
  return player_->outcome() == scenario::Outcome::kPlaying;
}

}  // namespace levitas::loop
