#include "dashboard/sample_store.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace levitas::dashboard {

SampleStore::SampleStore(const RigNumbers& rig, std::function<void(const Envelope&)> on_bucket)
    : frame_(rig),
      period_s_(rig.period_s()),
      bucket_cycles_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(std::llround(kBucketSeconds / rig.period_s())))),
      position_m_(rig.axes(), std::vector<float>(kCapacity)),
      current_a_(rig.axes(), std::vector<float>(kCapacity)),
      speed_rad_per_s_(kCapacity),
      angle_rad_(kCapacity),
      on_bucket_(std::move(on_bucket)) {
  OpenBucket();
}

void SampleStore::OpenBucket() {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  open_.low_m.assign(axes(), kNothing);
  open_.high_m.assign(axes(), -kNothing);
  open_.low_a.assign(axes(), kNothing);
  open_.high_a.assign(axes(), -kNothing);
  open_cycles_ = 0;
}

bool SampleStore::Add(const levitas_msg::sample_batch_t& batch) {
  const auto samples = static_cast<std::size_t>(std::max(batch.samples, 0));
  const bool fits = batch.axes == static_cast<std::int32_t>(axes()) && samples > 0 &&
                    batch.first_cycle >= 0 && batch.position_m.size() == samples * axes() &&
                    batch.control_current_a.size() == samples * axes() &&
                    batch.speed_rad_per_s.size() == samples && batch.angle_rad.size() == samples;
  if (!fits) return false;
  const auto first = static_cast<std::uint64_t>(batch.first_cycle);
  if (count_ == 0 || first != newest_cycle_ + 1) {
    contiguous_ = 0;
    OpenBucket();
  }
  for (std::size_t sample = 0; sample < samples; ++sample) Put(batch, sample);
  newest_time_ns_ = batch.last_time_ns;
  return true;
}

void SampleStore::Put(const levitas_msg::sample_batch_t& batch, std::size_t sample) {
  const auto at = static_cast<std::size_t>(count_ % kCapacity);
  session::AxisSample wired;
  for (std::size_t i = 0; i < axes(); ++i) {
    wired.position_m[i] = static_cast<double>(batch.position_m[sample * axes() + i]);
    wired.current_a[i] = static_cast<double>(batch.control_current_a[sample * axes() + i]);
  }
  const session::AxisSample shown = frame_.Bearing(wired);
  for (std::size_t i = 0; i < axes(); ++i) {
    position_m_[i][at] = static_cast<float>(shown.position_m[i]);
    current_a_[i][at] = static_cast<float>(shown.current_a[i]);
  }
  speed_rad_per_s_[at] = batch.speed_rad_per_s[sample];
  angle_rad_[at] = batch.angle_rad[sample];
  ++count_;
  contiguous_ = std::min(contiguous_ + 1, kCapacity);
  newest_cycle_ = static_cast<std::uint64_t>(batch.first_cycle) + sample;
  Widen(at);
}

void SampleStore::Widen(std::size_t at) {
  for (std::size_t i = 0; i < axes(); ++i) {
    // A reading that is no number widens nothing: comparisons with it are false.
    open_.low_m[i] = std::min(open_.low_m[i], position_m_[i][at]);
    open_.high_m[i] = std::max(open_.high_m[i], position_m_[i][at]);
    open_.low_a[i] = std::min(open_.low_a[i], current_a_[i][at]);
    open_.high_a[i] = std::max(open_.high_a[i], current_a_[i][at]);
  }
  if (++open_cycles_ < bucket_cycles_) return;
  open_.time_s = static_cast<double>(newest_cycle_) * period_s_;
  open_.speed_rad_per_s = static_cast<double>(speed_rad_per_s_[at]);
  if (on_bucket_) on_bucket_(open_);
  closed_.push_back(open_);
  if (closed_.size() > kMaxEnvelopes) closed_.pop_front();
  OpenBucket();
}

std::vector<Envelope> SampleStore::TakeEnvelopes() {
  std::vector<Envelope> taken(std::make_move_iterator(closed_.begin()),
                              std::make_move_iterator(closed_.end()));
  closed_.clear();
  return taken;
}

}  // namespace levitas::dashboard
