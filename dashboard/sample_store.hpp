#pragma once
// The latest samples at full rate, as they arrive in batches, and their envelope for slow eyes.
//
// Ring      kCapacity cycles per channel. `contiguous` of the newest follow each other without a
//           gap; only those make a spectrum or an oscilloscope's picture.
// Envelope  smallest and largest value of each channel per bucket of `bucket_cycles`: a vibration
//           faster than any screen keeps its amplitude, which every n-th sample would not show.
// Frames    bearing frame, as session/log/record_frame.hpp gives it.
// Units     SI. Thread one. Failure: a batch of other axes than the rig's is refused.

#include <cstdint>
#include <deque>
#include <functional>
#include <levitas_msg/sample_batch_t.hpp>
#include <vector>

#include "common/rig_numbers.hpp"
#include "session/log/record_frame.hpp"

namespace levitas::dashboard {

struct Envelope {
  double time_s{};  ///< of the run: cycle x period, at the end of the bucket
  std::vector<float> low_m, high_m;
  std::vector<float> low_a, high_a;
  double speed_rad_per_s{};
};

class SampleStore {
 public:
  static constexpr std::size_t kCapacity = 1U << 16U;
  static constexpr double kBucketSeconds = 0.025;
  static constexpr std::size_t kMaxEnvelopes = 800;  ///< 20 s; older ones are dropped

  /// `on_bucket` is called with each bucket as it closes, from Add.
  explicit SampleStore(const RigNumbers& rig, std::function<void(const Envelope&)> on_bucket = {});

  /// False when the batch does not fit the rig.
  bool Add(const levitas_msg::sample_batch_t& batch);

  [[nodiscard]] std::size_t axes() const noexcept { return position_m_.size(); }
  /// Newest samples that follow each other without a gap.
  [[nodiscard]] std::size_t contiguous() const noexcept { return contiguous_; }
  /// Samples taken in since the start; the newest has number count() - 1.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] std::uint64_t newest_cycle() const noexcept { return newest_cycle_; }
  [[nodiscard]] std::int64_t newest_time_ns() const noexcept { return newest_time_ns_; }
  [[nodiscard]] double period_s() const noexcept { return period_s_; }

  /// `back` samples before the newest (0 = the newest); back < kCapacity.
  [[nodiscard]] float Position(std::size_t axis, std::size_t back) const noexcept {
    return position_m_[axis][At(back)];
  }
  /// Bearings of two axes each; the last one of an odd number is guided along y.
  [[nodiscard]] std::size_t bearings() const noexcept { return (axes() + 1) / 2; }
  /// x (direction 0) or y (1) of a bearing; a guided y is 0.
  [[nodiscard]] float Displacement(std::size_t bearing, std::size_t direction,
                                   std::size_t back) const noexcept {
    const std::size_t axis = 2 * bearing + direction;
    return axis < axes() ? Position(axis, back) : 0.0F;
  }
  [[nodiscard]] float Current(std::size_t axis, std::size_t back) const noexcept {
    return current_a_[axis][At(back)];
  }
  [[nodiscard]] float Speed(std::size_t back) const noexcept { return speed_rad_per_s_[At(back)]; }
  /// Of the key phasor, 0 to 2 pi.
  [[nodiscard]] float Angle(std::size_t back) const noexcept { return angle_rad_[At(back)]; }

  /// Buckets closed since the last call, oldest first.
  [[nodiscard]] std::vector<Envelope> TakeEnvelopes();

 private:
  [[nodiscard]] std::size_t At(std::size_t back) const noexcept {
    return static_cast<std::size_t>((count_ - 1 - back) % kCapacity);
  }
  void Put(const levitas_msg::sample_batch_t& batch, std::size_t sample);
  void Widen(std::size_t at);
  void OpenBucket();

  session::RecordFrame frame_;
  double period_s_;
  std::uint64_t bucket_cycles_;
  std::vector<std::vector<float>> position_m_, current_a_;
  std::vector<float> speed_rad_per_s_, angle_rad_;
  std::function<void(const Envelope&)> on_bucket_;
  std::uint64_t count_{0};
  std::size_t contiguous_{0};
  std::uint64_t newest_cycle_{0};
  std::int64_t newest_time_ns_{0};
  Envelope open_;
  std::uint64_t open_cycles_{0};
  std::deque<Envelope> closed_;
};

}  // namespace levitas::dashboard
