#include "transport/sample_batcher.hpp"

#include <algorithm>
#include <utility>

namespace levitas::transport {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

}  // namespace

SampleBatcher::SampleBatcher(std::size_t axes, std::function<void(std::vector<std::uint8_t>)> send)
    : axes_(std::min(axes, kMaxAxes)), send_(std::move(send)) {
  batch_.axes = static_cast<std::int32_t>(axes_);
  batch_.position_m.reserve(kBatch * axes_);
  batch_.control_current_a.reserve(kBatch * axes_);
  batch_.speed_rad_per_s.reserve(kBatch);
  batch_.angle_rad.reserve(kBatch);
}

bool SampleBatcher::StretchAllowed(std::int64_t now_ns) noexcept {
  if (!started_) earned_until_ns_ = now_ns;
  started_ = true;
  // Bounded before the multiplication: a pause of any length earns a full bucket and no more.
  const std::int64_t waited_ns =
      std::clamp<std::int64_t>(now_ns - earned_until_ns_, 0, kNsPerSecond);
  const std::int64_t earned = waited_ns * kCyclesPerSecond / kNsPerSecond;
  tokens_ = std::min(kBucketCycles, tokens_ + earned);
  // Time that did not earn a whole cycle yet is kept, however often this is asked.
  if (earned > 0) earned_until_ns_ = now_ns;
  if (tokens_ < kStretch) return false;
  tokens_ -= kStretch;
  return true;
}

void SampleBatcher::Add(const cycle::CycleRecord& record, std::int64_t now_ns) {
  const auto cycle = static_cast<std::int64_t>(record.in.cycle);
  if (batch_.samples > 0 && cycle != batch_.first_cycle + batch_.samples) Flush();
  if (left_in_stretch_ == 0) {
    if (!StretchAllowed(now_ns)) return;
    left_in_stretch_ = kStretch;
  }
  --left_in_stretch_;
  if (batch_.samples == 0) batch_.first_cycle = cycle;
  batch_.last_time_ns = record.in.frame.sample_time_ns;
  for (std::size_t i = 0; i < axes_; ++i) {
    batch_.position_m.push_back(static_cast<float>(record.in.frame.position_m[i]));
    batch_.control_current_a.push_back(static_cast<float>(record.out.current.control_current_a[i]));
  }
  batch_.speed_rad_per_s.push_back(static_cast<float>(record.in.frame.speed_rad_per_s));
  batch_.angle_rad.push_back(static_cast<float>(record.in.frame.angle_rad));
  ++batch_.samples;
  if (batch_.samples == static_cast<std::int32_t>(kBatch) || left_in_stretch_ == 0) Flush();
}

void SampleBatcher::Flush() {
  batch_.values = static_cast<std::int32_t>(batch_.position_m.size());
  std::vector<std::uint8_t> encoded(static_cast<std::size_t>(batch_.getEncodedSize()));
  batch_.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
  send_(std::move(encoded));
  batch_.samples = 0;
  batch_.position_m.clear();
  batch_.control_current_a.clear();
  batch_.speed_rad_per_s.clear();
  batch_.angle_rad.clear();
}

}  // namespace levitas::transport
