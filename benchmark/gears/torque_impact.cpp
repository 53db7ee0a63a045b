#include "benchmark/gears/torque_impact.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "benchmark/gears/quiet_mesh.hpp"
#include "benchmark/gears/spinning_rig.hpp"
#include "common/problem.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/shaft_loads.hpp"

namespace levitas::gears {
namespace {

using Eigen::Index;

constexpr double kSteadyS = 2.0;
constexpr double kLeadS = 0.010;    ///< before the impact
constexpr double kFollowS = 0.080;  ///< and behind it
constexpr double kPulseS = 0.5e-3;
constexpr Index kAnswer = 2;      ///< periods from the impact to the first current that knows it
constexpr double kProbeA = 0.05;  ///< of the pulse that shows the rig's answer
constexpr int kSweeps = 300;      ///< of all pulses, until none moves

/// Pulses one after the other, from a period on.
struct Pulses {
  Index begins{};
  Eigen::MatrixXd amplitude_a;  ///< pulses x axes
};

struct Trace {
  Eigen::MatrixXd torque_n_m;  ///< periods x springs
  Eigen::MatrixXd current_a;   ///< periods x axes
  bool saturated{};
  bool tripped{};
};

/// A rig that turns steadily with its law, hit again and again from the same state.
class Turning {
 public:
  Turning(const configuration::RigFile& rig, const configuration::ControllerFile& controller,
          double speed_rad_per_s)
      : rig_(rig),
        config_{rig.numbers, controller.law, controller.supervisor, {}},
        speed_rad_per_s_(speed_rad_per_s) {}

  [[nodiscard]] Index lead() const { return Periods(kLeadS); }
  [[nodiscard]] Index length() const { return Periods(kLeadS + kFollowS); }
  [[nodiscard]] Index pulse() const { return std::max<Index>(1, Periods(kPulseS)); }
  [[nodiscard]] Index axes() const { return static_cast<Index>(rig_.numbers.axes()); }
  [[nodiscard]] Pulses None(Index begins = 0) const {
    return {begins, Eigen::MatrixXd::Zero((length() - begins) / pulse(), axes())};
  }

  [[nodiscard]] Trace Hit(const Impact& impact, const Pulses& pulses) const;

 private:
  [[nodiscard]] Index Periods(double seconds) const {
    return static_cast<Index>(PeriodsOf(rig_, seconds));
  }

  const configuration::RigFile& rig_;
  cycle::CycleConfig config_;
  double speed_rad_per_s_;
};

Trace Turning::Hit(const Impact& impact, const Pulses& pulses) const {
  SpinningRig spinning(rig_, config_);
  plant::Plant& plant = spinning.plant();
  plant.AllowTorques();
  spinning.SpinAt(speed_rad_per_s_, kSteadyS);
  const plant::ShaftLoads loads(plant.model());
  const std::size_t last = plant.model().train().inertias.size() - 1;
  const Index ends = lead() + std::max<Index>(1, Periods(impact.duration_s));
  Trace trace;
  trace.torque_n_m.resize(length(), static_cast<Index>(loads.twisted().size()));
  trace.current_a.resize(length(), axes());
  for (Index n = 0; n < length(); ++n) {
    plant.SetTorque(last, n >= lead() && n < ends ? impact.torque_n_m : 0.0);
    cycle::OperatorInput op;
    const Index k = n < pulses.begins ? -1 : (n - pulses.begins) / pulse();
    for (Index a = 0; a < axes() && k >= 0 && k < pulses.amplitude_a.rows(); ++a)
      op.excitation_a[static_cast<std::size_t>(a)] = pulses.amplitude_a(k, a);
    spinning.Step(op);
    const auto torques = loads.Torques(plant);
    for (std::size_t s = 0; s < torques.size(); ++s)
      trace.torque_n_m(n, static_cast<Index>(s)) = torques[s];
    const cycle::CycleOutputs& out = spinning.out();
    for (Index a = 0; a < axes(); ++a)
      trace.current_a(n, a) = out.current.control_current_a[static_cast<std::size_t>(a)];
    trace.saturated = trace.saturated || out.saturated_axes != 0;
  }
  trace.tripped = spinning.out().fault != Fault::kNone;
  return trace;
}

/// Least squares of `wanted` + `answers` x within |x| <= `most`, coordinate by coordinate.
Eigen::VectorXd LeastWithin(const Eigen::MatrixXd& answers, const Eigen::VectorXd& wanted,
                            const Eigen::VectorXd& most) {
  const Eigen::MatrixXd normal = answers.transpose() * answers;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(most.size());
  Eigen::VectorXd slope = answers.transpose() * wanted;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Index i = 0; i < x.size(); ++i) {
      if (!(normal(i, i) > 0.0)) continue;
      const double next = std::clamp(x[i] - slope[i] / normal(i, i), -most[i], most[i]);
      slope += (next - x[i]) * normal.col(i);
      x[i] = next;
    }
  }
  return x;
}

/// Pulses from period `begins` on that leave the least of the torque in the first spring, each
/// beside what the law asks of its coil while `hit` lasts.
Pulses BestFrom(Index begins, const Turning& rig, const RigNumbers& numbers,
                const std::vector<Eigen::VectorXd>& of_axis, const Eigen::VectorXd& torque_n_m,
                const Trace& hit) {
  const double limit_a =
      std::min(numbers.bias_current_a, numbers.max_coil_current_a - numbers.bias_current_a);
  Pulses best = rig.None(begins);
  const Index count = best.amplitude_a.rows();
  Eigen::MatrixXd answers = Eigen::MatrixXd::Zero(rig.length(), count * rig.axes());
  Eigen::VectorXd most(count * rig.axes());
  for (Index k = 0; k < count; ++k) {
    const Index first = begins + k * rig.pulse();
    for (Index a = 0; a < rig.axes(); ++a) {
      const Index at = k * rig.axes() + a;
      answers.col(at).tail(rig.length() - first) =
          of_axis[static_cast<std::size_t>(a)].head(rig.length() - first);
      const double law_a = hit.current_a.col(a).segment(first, rig.pulse()).cwiseAbs().maxCoeff();
      most[at] = std::max(0.0, limit_a - law_a);
    }
  }
  const Eigen::VectorXd x = LeastWithin(answers, torque_n_m, most);
  for (Index k = 0; k < count; ++k) best.amplitude_a.row(k) = x.segment(k * rig.axes(), rig.axes());
  return best;
}

Passed PassedBy(const Trace& trace, const Trace& quiet) {
  Passed passed;
  const Eigen::MatrixXd moved = trace.torque_n_m - quiet.torque_n_m;
  for (Index s = 0; s < moved.cols(); ++s) {
    passed.torque_n_m.push_back(moved.col(s).cwiseAbs().maxCoeff());
  }
  passed.current_a = trace.current_a.cwiseAbs().maxCoeff();
  passed.saturated = trace.saturated;
  passed.tripped = trace.tripped;
  return passed;
}

}  // namespace

ImpactRelief Relieve(const configuration::RigFile& rig,
                     const configuration::ControllerFile& controller, double speed_rad_per_s,
                     const Impact& impact) {
  RefuseWithoutGears(rig);
  const Turning turning(rig, controller, speed_rad_per_s);
  ImpactRelief relief;
  relief.twisted = plant::ShaftLoads(plant::PlantModel(rig.plant)).twisted();
  const rotor::Torsion& torsion = rig.plant.shafts.front().torsion;
  if (torsion.kind != rotor::TorsionKind::kInertias || torsion.inertias.size() < 2) {
    throw BadInput(rig.numbers.name +
                   ": its first shaft has no torsion between inertias; see geared_rotor_12dof");
  }
  const Impact none{0.0, impact.duration_s};
  const Trace quiet = turning.Hit(none, turning.None());
  const Trace hit = turning.Hit(impact, turning.None());
  if (hit.tripped) {
    throw BadInput(rig.numbers.name + ": it trips at this speed under this impact");
  }
  std::vector<Eigen::VectorXd> of_axis;
  for (Index a = 0; a < turning.axes(); ++a) {
    Pulses probe = turning.None();
    probe.amplitude_a(0, a) = kProbeA;
    of_axis.emplace_back((turning.Hit(none, probe).torque_n_m.col(0) - quiet.torque_n_m.col(0)) /
                         kProbeA);
  }
  const Eigen::VectorXd passed = hit.torque_n_m.col(0) - quiet.torque_n_m.col(0);
  relief.law = PassedBy(hit, quiet);
  const auto with = [&](Index begins) {
    const Pulses best = BestFrom(begins, turning, rig.numbers, of_axis, passed, hit);
    return PassedBy(turning.Hit(impact, best), quiet);
  };
  relief.answered = with(turning.lead() + kAnswer);
  relief.foreseen = with(0);
  return relief;
}

}  // namespace levitas::gears
