#pragma once
// Frames that repeat the readings of all axes bit for bit: lost ones, where the last readings were
// held, or chance.
//
// Chance     a converter whose step is not small beside the probes' noise reads the same number
//            twice: one of 0.05 um rms behind steps of 0.05 um in 28 % of all cases where nothing
//            moves. In stretches of 50 ms the axes are taken as independent, so that all repeat
//            as often as the product of the shares of the single ones says.
// Lost       when they are kTimesChance as many as chance makes of them, and as many of its
//            deviations more. Below that single frames cannot be told apart, and all count as
//            arrived: a few lost ones do less harm than readings that do not correct the model.
// Thread     any; pure.

#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/records/innovations.hpp"
#include "common/axes.hpp"

namespace levitas::diagnosis {

struct RepeatedFrames {
  static constexpr double kTimesChance = 4.0;

  std::size_t count{};
  double by_chance{};  ///< expected

  [[nodiscard]] bool AreLost() const noexcept {
    return static_cast<double>(count) > kTimesChance * (by_chance + std::sqrt(by_chance));
  }
};

/// All axes bit for bit: of readings, or of currents.
[[nodiscard]] bool Repeats(const AxisArray& before, const AxisArray& now,
                           std::size_t axes) noexcept;

/// Of consecutive cycles that are levitated.
[[nodiscard]] RepeatedFrames CountRepeats(const std::vector<analysis::RecordedRow>& rows,
                                          std::size_t axes);

}  // namespace levitas::diagnosis
