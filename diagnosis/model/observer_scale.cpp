#include "diagnosis/model/observer_scale.hpp"

#include <algorithm>

#include "diagnosis/model/linear_change.hpp"

namespace levitas::diagnosis {
namespace {

/// A mode that is hardly read any more keeps an observer.
constexpr double kLeast = 0.2;

double Modal(const RigView& rig, const LinearChange& change, std::size_t plane, std::size_t mode) {
  double nominal = 0.0;
  double now = 0.0;
  for (std::size_t a = plane; a < rig.axes; a += 2) {
    const double h = rig.magnet(a).sensor_shape[mode];
    nominal += h * h;
    now += h * (h + change.axis[a].sensor_q[mode]);
  }
  return nominal > 0.0 ? std::max(kLeast, now / nominal) : 1.0;
}

std::shared_ptr<const analysis::ObserverGain> Divided(const analysis::ObserverGain& gain,
                                                      const ObserverScale& by, const RigView& rig) {
  auto out = std::make_shared<analysis::ObserverGain>(gain);
  for (std::size_t a = 0; a < rig.axes; ++a) {
    const auto column = static_cast<Eigen::Index>(a);
    out->state.col(column) /= by.readings[a];
    out->force_n_per_m.col(column) /= by.readings[a];
  }
  const plant::StateLayout& at = rig.model->layout();
  for (std::size_t i = 0; i < 2 * rig.modes; ++i) {
    for (const std::size_t row : {at.q_x + i, at.v_x + i}) {
      out->state.row(static_cast<Eigen::Index>(row)) /= by.modes[i];
      out->force_step.row(static_cast<Eigen::Index>(row)) /= by.modes[i];
    }
  }
  return out;
}

}  // namespace

ObserverScale ObserverScale::Of(const RigView& rig, const std::vector<Term>& terms,
                                const std::vector<double>& theta) {
  ObserverScale scale;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (!terms[i].scales) continue;
    scale.readings[*terms[i].scales] += theta[i];
  }
  const LinearChange change = ChangeOf(terms, theta);
  for (std::size_t plane = 0; plane < 2; ++plane) {
    for (std::size_t i = 0; i < rig.modes; ++i) {
      scale.modes[plane * rig.modes + i] = Modal(rig, change, plane, i);
    }
  }
  return scale;
}

ObserverGains Divided(const ObserverGains& gains, const ObserverScale& by, const RigView& rig) {
  ObserverGains out{Divided(*gains.start, by, rig), gains.stages};
  for (GainStage& stage : out.stages) stage.gain = Divided(*stage.gain, by, rig);
  return out;
}

}  // namespace levitas::diagnosis
