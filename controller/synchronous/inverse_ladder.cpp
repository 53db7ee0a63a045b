#include "controller/synchronous/inverse_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace levitas::synchronous {
namespace {

ComplexMatrix Between(const ComplexMatrix& low, const ComplexMatrix& high, double share) {
  ComplexMatrix made;
  for (std::size_t to = 0; to < kMaxAxes; ++to) {
    for (std::size_t from = 0; from < kMaxAxes; ++from) {
      made.real[to][from] = low.real[to][from] + share * (high.real[to][from] - low.real[to][from]);
      made.imaginary[to][from] =
          low.imaginary[to][from] + share * (high.imaginary[to][from] - low.imaginary[to][from]);
    }
  }
  return made;
}

}  // namespace

ComplexMatrix InverseAt(const BlockConfig& block, double speed_rad_per_s) {
  const auto& table = block.inverse;
  if (table.empty()) throw std::invalid_argument("synchronous: a block without its inverse");
  if (speed_rad_per_s <= table.front().speed_rad_per_s) return table.front().inverse;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const double low = table[i - 1].speed_rad_per_s;
    const double high = table[i].speed_rad_per_s;
    if (!(high > low)) throw std::invalid_argument("synchronous: speeds of a table must rise");
    if (speed_rad_per_s > high) continue;
    return Between(table[i - 1].inverse, table[i].inverse, (speed_rad_per_s - low) / (high - low));
  }
  return table.back().inverse;
}

bool ActsAt(const BlockConfig& block, double speed_rad_per_s) noexcept {
  return speed_rad_per_s >= block.from_rad_per_s - block.hysteresis_rad_per_s &&
         speed_rad_per_s <= block.to_rad_per_s + block.hysteresis_rad_per_s;
}

bool ShareWork(const BlockConfig& one, const BlockConfig& other) noexcept {
  return one.order == other.order &&
         one.from_rad_per_s - one.hysteresis_rad_per_s <=
             other.to_rad_per_s + other.hysteresis_rad_per_s &&
         other.from_rad_per_s - other.hysteresis_rad_per_s <=
             one.to_rad_per_s + one.hysteresis_rad_per_s;
}

InverseLadder::InverseLadder(const BlockConfig& block) {
  lowest_rad_per_s_ = std::max(0.0, block.from_rad_per_s - block.hysteresis_rad_per_s);
  const double highest = block.to_rad_per_s + block.hysteresis_rad_per_s;
  const double width = (highest - lowest_rad_per_s_) / static_cast<double>(kRungs - 1);
  if (!(width > 0.0) || !std::isfinite(width)) {
    throw std::invalid_argument("synchronous: a block must end at a higher speed than it begins");
  }
  per_width_ = 1.0 / width;
  for (std::size_t rung = 0; rung < kRungs; ++rung) {
    const ComplexMatrix here =
        InverseAt(block, lowest_rad_per_s_ + width * static_cast<double>(rung));
    InverseLanes& lanes = rungs_.emplace_back();
    for (std::size_t to = 0; to < kMaxAxes; ++to) {
      for (std::size_t from = 0; from < kMaxAxes; ++from) {
        lanes.real[from][to] = here.real[to][from];
        lanes.imaginary[from][to] = here.imaginary[to][from];
      }
    }
  }
}

const InverseLanes& InverseLadder::At(double speed_rad_per_s) const noexcept {
  const double place = (speed_rad_per_s - lowest_rad_per_s_) * per_width_ + 0.5;
  if (!(place > 0.0)) return rungs_.front();
  if (place >= static_cast<double>(kRungs)) return rungs_.back();
  return rungs_[static_cast<std::size_t>(place)];
}

}  // namespace levitas::synchronous
