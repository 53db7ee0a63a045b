#include "analysis/speed_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::analysis {
namespace {

constexpr int kIntervals = 8;
constexpr double kPlaceShare = 0.01;

/// Orders results: an unstable loop is worse than every peak.
std::pair<bool, double> Badness(const SensitivityResult& result) {
  const double peak = result.axes.empty() ? 0.0 : result.axes[WorstAxis(result)].peak;
  return {!result.stable, result.stable ? peak : result.largest_pole_modulus};
}

class Sweep {
 public:
  Sweep(const plant::PlantConfig& plant, const law::LawConfig& law) : plant_(plant), law_(law) {}

  [[nodiscard]] SensitivityResult At(double speed_rad_per_s) const {
    return SensitivityPeaks(plant_, law_, speed_rad_per_s);
  }

  /// The worst between two speeds; `best` is the worst that is known already.
  [[nodiscard]] SensitivityResult Worst(double low, double high, double width,
                                        SensitivityResult worst) const {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    SensitivityResult left = At(high - golden * (high - low));
    SensitivityResult right = At(low + golden * (high - low));
    while (high - low > width) {
      if (Badness(left) > Badness(right)) {
        high = right.speed_rad_per_s;
        right = std::move(left);
        left = At(high - golden * (high - low));
      } else {
        low = left.speed_rad_per_s;
        left = std::move(right);
        right = At(low + golden * (high - low));
      }
    }
    for (const SensitivityResult* found : {&left, &right}) {
      if (Badness(*found) > Badness(worst)) worst = *found;
    }
    return worst;
  }

 private:
  const plant::PlantConfig& plant_;
  const law::LawConfig& law_;
};

}  // namespace

std::size_t WorstAxis(const SensitivityResult& result) noexcept {
  const auto worst = std::max_element(result.axes.begin(), result.axes.end(),
                                      [](const auto& a, const auto& b) { return a.peak < b.peak; });
  return static_cast<std::size_t>(worst - result.axes.begin());
}

SpeedSweep SensitivityOverSpeed(const plant::PlantConfig& plant, const law::LawConfig& law,
                                double top_speed_rad_per_s) {
  const Sweep sweep(plant, law);
  if (!(top_speed_rad_per_s > 0.0)) return {{sweep.At(0.0)}, 0};
  std::vector<SensitivityResult> grid;
  for (int i = 0; i <= kIntervals; ++i) {
    grid.push_back(sweep.At(top_speed_rad_per_s * i / kIntervals));
  }
  const auto at = std::max_element(grid.begin(), grid.end(), [](const auto& a, const auto& b) {
    return Badness(a) < Badness(b);
  });
  SensitivityResult worst = *at;
  if (worst.stable) {
    const auto before = at == grid.begin() ? at : at - 1;
    const auto after = at + 1 == grid.end() ? at : at + 1;
    worst = sweep.Worst(before->speed_rad_per_s, after->speed_rad_per_s,
                        kPlaceShare * top_speed_rad_per_s, std::move(worst));
  }
  SpeedSweep result{{grid.front(), grid.back()}, 0};
  if (worst.speed_rad_per_s == grid.back().speed_rad_per_s) {
    result.worst = 1;
  } else if (worst.speed_rad_per_s != 0.0) {
    result.speeds.insert(result.speeds.begin() + 1, std::move(worst));
    result.worst = 1;
  }
  return result;
}

}  // namespace levitas::analysis
