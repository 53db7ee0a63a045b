#pragma once
// Orbit and current that unbalance, and a force at three times the speed, leave with a law.
//
// Speeds    from a tenth of the rated speed to all of it, a twentieth apart.
// Forces    unbalance of the rig file at once the speed; `third_n` against rotation at the shaft's
//           drive end at three times the speed. Each leaves an ellipse; largest radii are summed.
// Left out  geared shafts (their forces are the teeth's): no speeds then.
// Shares    the plant's response without control with design/uncertainty.
// Units     SI. Thread: any; pure after construction.

#include <vector>

#include "design/pid/loop_survey.hpp"

namespace levitas::design {

struct UnbalanceFigures {
  double orbit_m{}, orbit_rad_per_s{};      ///< largest over bearings and speeds, at the sensors
  double current_a{}, current_rad_per_s{};  ///< amplitude, the harmonics' summed
};

class UnbalanceResponse {
 public:
  UnbalanceResponse(const configuration::RigFile& rig, double third_n,
                    Coordinates coordinates = {});
  [[nodiscard]] bool empty() const noexcept { return harmonics_.empty(); }
  /// Laws of the axes, or of the channels of the coordinates.
  [[nodiscard]] UnbalanceFigures Of(const std::vector<law::DiscreteLaw>& laws) const;

 private:
  struct Harmonic {
    double speed_rad_per_s{};
    SampledPoint point;
    Eigen::VectorXcd position_m;  ///< without control, per axis
  };
  Coordinates coordinates_;
  std::size_t per_speed_{1};
  std::vector<Harmonic> harmonics_;  ///< a speed's stand side by side
};

}  // namespace levitas::design
