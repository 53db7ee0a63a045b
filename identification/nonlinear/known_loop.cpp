#include "identification/nonlinear/known_loop.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace levitas::identification {
namespace {

law::LawConfig AtPeriod(law::LawConfig law, double period_s) {
  law.period_s = period_s;
  return law;
}

double Limit(const law::LawConfig& law, const RigNumbers& rig) {
  const double coils_a = std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  return law.current_limit_a > 0.0 ? std::min(coils_a, law.current_limit_a) : coils_a;
}

}  // namespace

KnownLoop::KnownLoop(const law::LawConfig& law, const RigNumbers& rig, LoopExcitation excitation)
    : coefficients_(AtPeriod(law, rig.period_s())),
      limit_a_(Limit(law, rig)),
      excitation_(std::move(excitation)) {}

Feedback KnownLoop::AtRest() const {
  return [this, state = std::make_shared<law::LawState>(coefficients_)](
             Eigen::Index row, const Eigen::VectorXd& y_m, Eigen::VectorXd& current_a) {
    AxisArray error_m{};
    AxisArray added_a{};
    for (Eigen::Index i = 0; i < y_m.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const bool displaced = excitation_.position_m.rows() > 0;
      error_m[at] = -(displaced ? y_m[i] + excitation_.position_m(row, i) : y_m[i]);
      if (excitation_.current_a.rows() > 0) added_a[at] = excitation_.current_a(row, i);
    }
    const law::LawOutput out = law::Step(coefficients_, *state, error_m, added_a, limit_a_);
    for (Eigen::Index i = 0; i < y_m.size(); ++i) {
      current_a[i] = out.control_current_a[static_cast<std::size_t>(i)];
    }
  };
}

}  // namespace levitas::identification
