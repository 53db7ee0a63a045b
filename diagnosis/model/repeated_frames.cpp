#include "diagnosis/model/repeated_frames.hpp"

#include <algorithm>
#include <array>

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kStretch = 500;  // rows: 50 ms at 10 kHz

/// One stretch: of `frames`, those that repeat on each axis, and on all.
struct Repeating {
  std::size_t frames{}, all{};
  std::array<std::size_t, kMaxAxes> axis{};

  [[nodiscard]] double ByChance(std::size_t axes) const {
    // A lost frame repeats on every axis: what is left tells how often one does by itself.
    const auto arrived = static_cast<double>(frames - all);
    if (!(arrived > 0.0)) return 0.0;
    double chance = 1.0;
    for (std::size_t a = 0; a < axes; ++a) chance *= static_cast<double>(axis[a] - all) / arrived;
    return chance * arrived;
  }
};

}  // namespace

bool Repeats(const AxisArray& before, const AxisArray& now, std::size_t axes) noexcept {
  return std::equal(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(axes),
                    now.begin());
}

RepeatedFrames CountRepeats(const std::vector<analysis::RecordedRow>& rows, std::size_t axes) {
  RepeatedFrames repeated;
  Repeating stretch;
  const auto close = [&] {
    repeated.count += stretch.all;
    repeated.by_chance += stretch.ByChance(axes);
    stretch = {};
  };
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const analysis::RecordedRow& before = rows[n - 1];
    const analysis::RecordedRow& now = rows[n];
    if (!before.levitated || !now.levitated || now.cycle != before.cycle + 1) continue;
    ++stretch.frames;
    for (std::size_t a = 0; a < axes; ++a) {
      if (before.sample.position_m[a] == now.sample.position_m[a]) ++stretch.axis[a];
    }
    if (Repeats(before.sample.position_m, now.sample.position_m, axes)) ++stretch.all;
    if (stretch.frames == kStretch) close();
  }
  close();
  return repeated;
}

}  // namespace levitas::diagnosis
