#include "identification/live/sample_feed.hpp"

#include <utility>

#include "common/levitated_modes.hpp"

namespace levitas::identification {

SampleFeed::SampleFeed(const RigNumbers& rig, OnlineRecursion& recursion)
    : frame_(rig),
      axes_(rig.axes()),
      recursion_(recursion),
      u_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(axes_))),
      y_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(axes_))) {}

bool SampleFeed::Take(levitas_msg::sample_batch_t batch) {
  const auto axes = static_cast<std::size_t>(batch.axes);
  if (axes != axes_ || batch.first_cycle < 0 || batch.values != batch.axes * batch.samples) {
    return false;
  }
  waiting_.push_back(std::move(batch));
  Release();
  if (waiting_.size() > kMostWaiting) {
    waiting_.pop_front();
    next_sample_ = 0;
  }
  return true;
}

void SampleFeed::Take(std::uint64_t cycle, Mode mode) {
  if (any_state_ && cycle <= known_to_) return;
  any_state_ = true;
  known_to_ = cycle;
  if (!IsLevitated(mode)) {
    levitated_from_.reset();
  } else if (!levitated_from_) {
    levitated_from_ = cycle;
  }
  Release();
}

void SampleFeed::Release() {
  while (any_state_ && !waiting_.empty()) {
    const levitas_msg::sample_batch_t& batch = waiting_.front();
    const auto first = static_cast<std::uint64_t>(batch.first_cycle);
    while (next_sample_ < batch.samples) {
      const std::uint64_t cycle = first + static_cast<std::uint64_t>(next_sample_);
      if (cycle > known_to_) return;
      if (levitated_from_ && cycle >= *levitated_from_) {
        Pass(batch, next_sample_);
      } else {
        recursion_.Pause();
      }
      ++next_sample_;
    }
    waiting_.pop_front();
    next_sample_ = 0;
  }
}

void SampleFeed::Pass(const levitas_msg::sample_batch_t& batch, std::int32_t sample) {
  session::AxisSample wired;
  const std::size_t at = static_cast<std::size_t>(sample) * axes_;
  for (std::size_t i = 0; i < axes_; ++i) {
    wired.position_m[i] = static_cast<double>(batch.position_m[at + i]);
    wired.current_a[i] = static_cast<double>(batch.control_current_a[at + i]);
  }
  const session::AxisSample bearing = frame_.Bearing(wired);
  for (std::size_t i = 0; i < axes_; ++i) {
    u_[static_cast<Eigen::Index>(i)] = bearing.current_a[i];
    y_[static_cast<Eigen::Index>(i)] = bearing.position_m[i];
  }
  recursion_.Take(static_cast<std::uint64_t>(batch.first_cycle + sample), u_, y_);
}

}  // namespace levitas::identification
