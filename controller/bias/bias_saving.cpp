#include "controller/bias/bias_saving.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace levitas::bias {
namespace {

/// Of a peak that the lowering time leaves: two per cent.
constexpr double kForgotten = 4.0;

void Refuse(const BiasConfig& config, const RigNumbers& rig) {
  if (rig.magnet_gaps_m.size() * 2 < rig.axes()) {
    throw std::invalid_argument(
        "bias saving: a magnet of this rig has no gap s0 of the law "
        "F = k (i/s)^2");
  }
  if (config.lowest_current_a >= rig.bias_current_a) {
    throw std::invalid_argument("bias saving: lowest current " +
                                std::to_string(config.lowest_current_a) + " A, the rig's bias is " +
                                std::to_string(rig.bias_current_a) + " A");
  }
}

}  // namespace

Share ShareAt(double rig_bias_a, double bias_a, double gap_m) noexcept {
  return {rig_bias_a / bias_a, (rig_bias_a * rig_bias_a - bias_a * bias_a) / (bias_a * gap_m)};
}

BiasSaving::BiasSaving(const BiasConfig& config, const RigNumbers& rig)
    : config_(config),
      axes_(rig.axes()),
      rig_bias_a_(rig.bias_current_a),
      max_coil_current_a_(rig.max_coil_current_a),
      bias_a_(rig.bias_current_a) {
  if (config_.empty()) return;
  Refuse(config, rig);
  fall_a_ = rig_bias_a_ * rig.period_s() / config.lowering_time_s;
  rise_a_ = rig_bias_a_ * rig.period_s() / config.raising_time_s;
  forget_ = std::exp(-kForgotten * rig.period_s() / config.lowering_time_s);
  const double lowest_a = config.lowest_current_a;
  for (std::size_t i = 0; i < axes_; ++i) {
    gap_m_[i] = rig.magnet_gaps_m[i / 2];
    pull_a_per_m_[i] =
        ShareAt(rig_bias_a_, lowest_a, gap_m_[i]).displacement_a_per_m * (lowest_a / rig_bias_a_);
  }
  for (std::size_t b = 0; b < rig.bearings.size(); ++b) {
    orbit_m_[b] = config.largest_orbit_fraction * rig.ClearanceOf(b);
  }
}

void BiasSaving::Reset() noexcept {
  bias_a_ = rig_bias_a_;
  peak_a_ = 0.0;
  share_.fill({});
}

bool BiasSaving::Whole(const Conditions& seen) const noexcept {
  if (!seen.levitated || seen.speed_changes || seen.excited || seen.saturated_axes != 0)
    return true;
  for (std::size_t x = 0; x < axes_; x += 2) {
    const bool one_axis = x + 1 == axes_;
    const double dx_m = seen.position_m[x] - seen.reference_m[x];
    const double dy_m = one_axis ? 0.0 : seen.position_m[x + 1] - seen.reference_m[x + 1];
    const double limit_m = orbit_m_[x / 2];
    // False for what is no number: then nothing is known of the orbit.
    if (!(dx_m * dx_m + dy_m * dy_m <= limit_m * limit_m)) return true;
  }
  return false;
}

void BiasSaving::Step(const Conditions& seen, const AxisArray& law_current_a) noexcept {
  if (empty()) return;
  double asked_a = 0.0;
  for (std::size_t i = 0; i < axes_; ++i) {
    const double here_a =
        std::abs(law_current_a[i]) + pull_a_per_m_[i] * std::abs(seen.position_m[i]);
    asked_a = std::max(asked_a, here_a);
  }
  if (Whole(seen)) asked_a = config_.largest_share * rig_bias_a_;
  // std::max keeps the peak where what is asked is no number.
  peak_a_ = std::max(peak_a_ * forget_, asked_a);
  const double enough_a = std::sqrt(rig_bias_a_ * peak_a_ / config_.largest_share);
  const double wanted_a = std::clamp(enough_a, config_.lowest_current_a, rig_bias_a_);
  bias_a_ = std::clamp(wanted_a, bias_a_ - fall_a_, bias_a_ + rise_a_);
  for (std::size_t i = 0; i < axes_; ++i) share_[i] = ShareAt(rig_bias_a_, bias_a_, gap_m_[i]);
}

double BiasSaving::LimitOf(double limit_a, const AxisArray& read_m) const noexcept {
  if (empty()) return limit_a;
  // The magnet's own part of the force may not take more than nine tenths of the room: the law
  // must be able to act until the bias has been raised.
  constexpr double kLeastShare = 0.1;
  double taken_a = 0.0;
  for (std::size_t i = 0; i < axes_; ++i) {
    taken_a = std::max(taken_a, std::abs(share_[i].displacement_a_per_m * read_m[i]));
  }
  const double left_a = std::max(room_a() - taken_a, kLeastShare * room_a());
  return std::min(limit_a, left_a / share_.front().current);
}

AxisArray BiasSaving::At(const AxisArray& law_current_a, const AxisArray& read_m) const noexcept {
  if (empty()) return law_current_a;
  AxisArray out{};
  for (std::size_t i = 0; i < axes_; ++i) {
    const double asked_a =
        share_[i].current * law_current_a[i] + share_[i].displacement_a_per_m * read_m[i];
    out[i] = std::clamp(asked_a, -room_a(), room_a());
  }
  return out;
}

}  // namespace levitas::bias
