#include "diagnosis/model/divergence.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::diagnosis {
namespace {

constexpr float kShare = 0.25F;
constexpr float kTimes = 2.0F;
/// [noise rms] what a term of its usual size changes in a reading: a support on its own frequency
/// changes 80, nothing that can still be learnt from a thousand.
constexpr double kWild = 3000.0;

}  // namespace

bool ModelDiverges(const RigView& rig, const std::vector<Trajectory>& runs) {
  const auto far_m = kShare * static_cast<float>(rig.numbers.clearance_m);
  return std::any_of(runs.begin(), runs.end(), [&](const Trajectory& run) {
    float measured_m = 0.0F;
    float predicted_m = 0.0F;
    bool finite = true;
    for (const SamplePoint& m : run.moments) {
      for (std::size_t a = 0; m.settled && a < rig.axes; ++a) {
        measured_m = std::max(measured_m, std::abs(m.measured_m[a]));
        const float reading_m = m.measured_m[a] - m.innovation_m[a];
        predicted_m = std::max(predicted_m, std::abs(reading_m));
        finite = finite && std::isfinite(reading_m);
      }
    }
    return !finite || predicted_m > std::max(far_m, kTimes * measured_m);
  });
}

bool SensitivitiesDiverge(const NormalEquations& sum) {
  const double most = kWild * kWild * static_cast<double>(sum.values);
  return !(sum.jtj.diagonal().array() < most).all();
}

bool SensitivitiesAreLost(const NormalEquations& sum) {
  return !sum.jtj.allFinite() || !sum.jte.allFinite();
}

}  // namespace levitas::diagnosis
