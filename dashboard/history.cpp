#include "dashboard/history.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "common/rotational_speed.hpp"

namespace levitas::dashboard {
namespace {

constexpr float kMicro = 1e6F;

/// A bucket without a reading holds infinities.
float Known(float value) {
  return std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN();
}

template <class Number>
void Append(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

void History::Clear(std::size_t axes) {
  const std::lock_guard lock(mutex_);
  axes_ = axes;
  taken_ = 0;
  time_s_.assign(kRows, 0.0);
  values_.assign(kRows * (1 + 4 * axes), 0.0F);
}

void History::Add(const Envelope& bucket) {
  const std::lock_guard lock(mutex_);
  if (time_s_.empty() || bucket.low_m.size() != axes_) return;  // of no run that was announced
  const std::size_t width = 1 + 4 * axes_;
  const auto row = static_cast<std::size_t>(taken_++ % kRows);
  time_s_[row] = bucket.time_s;
  float* place = &values_[width * row];
  *place++ = static_cast<float>(RadPerSToRpm(bucket.speed_rad_per_s));
  for (std::size_t axis = 0; axis < axes_; ++axis) {
    *place++ = Known(bucket.low_m[axis] * kMicro);
    *place++ = Known(bucket.high_m[axis] * kMicro);
  }
  for (std::size_t axis = 0; axis < axes_; ++axis) {
    *place++ = Known(bucket.low_a[axis]);
    *place++ = Known(bucket.high_a[axis]);
  }
}

std::string History::Bytes() const {
  const std::lock_guard lock(mutex_);
  std::string bytes;
  const std::uint64_t rows = std::min<std::uint64_t>(taken_, kRows);
  if (rows == 0) return bytes;
  const std::size_t width = 1 + 4 * axes_;
  bytes.reserve(sizeof(double) + rows * (width + 1) * sizeof(float));
  const double first_s = time_s_[(taken_ - rows) % kRows];
  Append(bytes, first_s);
  for (std::uint64_t i = taken_ - rows; i < taken_; ++i) {
    const auto row = static_cast<std::size_t>(i % kRows);
    Append(bytes, static_cast<float>(time_s_[row] - first_s));
    bytes.append(reinterpret_cast<const char*>(&values_[width * row]), width * sizeof(float));
  }
  return bytes;
}

}  // namespace levitas::dashboard
