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
constexpr Index kPulse = 5;
constexpr Index kAnswer = 2;
constexpr double kProbeA = 0.05;  ///< of the pulse that shows the rig's answer
constexpr int kSweeps = 300;

/// Amplitude of each pulse: pulses x axes.
using Pulses = Eigen::MatrixXd;

struct Trace {
  Eigen::MatrixXd torque_n_m;  ///< periods x springs
  Eigen::MatrixXd current_a;   ///< periods x axes
  bool saturated{};
};

/// A rig that turns steadily with its law, hit again and again from the same state.
class Turning {
 public:
  Turning(const config::RigFile& rig, const config::ControllerFile& controller,
          double speed_rad_per_s)
      : rig_(rig),
        config_{rig.numbers, controller.law, controller.supervisor, {}},
        speed_rad_per_s_(speed_rad_per_s) {}

  [[nodiscard]] Index lead() const { return Periods(kLeadS); }
  [[nodiscard]] Index length() const { return Periods(kLeadS + kFollowS); }
  [[nodiscard]] Index pulses() const { return length() / kPulse; }
  [[nodiscard]] Index axes() const { return static_cast<Index>(rig_.numbers.axes()); }
  [[nodiscard]] Pulses None() const { return Pulses::Zero(pulses(), axes()); }

  [[nodiscard]] Trace Hit(const Impact& impact, const Pulses& pulses) const;

 private:
  [[nodiscard]] Index Periods(double seconds) const {
    return static_cast<Index>(std::lround(seconds / rig_.numbers.period_s()));
  }

  const config::RigFile& rig_;
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
    const Index pulse = std::min(n / kPulse, pulses.rows() - 1);
    for (Index a = 0; a < axes(); ++a)
      op.excitation_a[static_cast<std::size_t>(a)] = pulses(pulse, a);
    spinning.Step(op);
    const auto torques = loads.Torques(plant);
    for (std::size_t s = 0; s < torques.size(); ++s)
      trace.torque_n_m(n, static_cast<Index>(s)) = torques[s];
    const cycle::CycleOutputs& out = spinning.out();
    for (Index a = 0; a < axes(); ++a)
      trace.current_a(n, a) = out.current.control_current_a[static_cast<std::size_t>(a)];
    trace.saturated = trace.saturated || out.saturated_axes != 0;
  }
  if (spinning.out().fault != Fault::kNone) {
    throw BadInput(rig_.numbers.name + ": it trips at this speed under this impact");
  }
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

/// What may be added to each axis, beside what the law asks for while the impact lasts.
Eigen::VectorXd RoomOf(const Trace& hit, const RigNumbers& rig) {
  const double limit_a = std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  return (limit_a - hit.current_a.cwiseAbs().colwise().maxCoeff().transpose().array()).max(0.0);
}

/// Pulses from number `first` on that leave the least of the torque in the first spring.
Pulses BestFrom(Index first, const Turning& rig, const std::vector<Eigen::VectorXd>& of_axis,
                const Eigen::VectorXd& torque_n_m, const Eigen::VectorXd& room_a) {
  const Index count = rig.pulses() - first;
  Eigen::MatrixXd answers = Eigen::MatrixXd::Zero(rig.length(), count * rig.axes());
  Eigen::VectorXd most(count * rig.axes());
  for (Index k = 0; k < count; ++k) {
    const Index begins = (first + k) * kPulse;
    for (Index a = 0; a < rig.axes(); ++a) {
      answers.col(k * rig.axes() + a).tail(rig.length() - begins) =
          of_axis[static_cast<std::size_t>(a)].head(rig.length() - begins);
      most[k * rig.axes() + a] = room_a[a];
    }
  }
  const Eigen::VectorXd x = LeastWithin(answers, torque_n_m, most);
  Pulses best = rig.None();
  for (Index k = 0; k < count; ++k) best.row(first + k) = x.segment(k * rig.axes(), rig.axes());
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
  return passed;
}

}  // namespace

ImpactRelief Relieve(const config::RigFile& rig, const config::ControllerFile& controller,
                     double speed_rad_per_s, const Impact& impact) {
  RefuseWithoutGears(rig);
  const Turning turning(rig, controller, speed_rad_per_s);
  ImpactRelief relief;
  relief.twisted = plant::ShaftLoads(plant::PlantModel(rig.plant)).twisted();
  if (relief.twisted.empty()) {
    throw BadInput(rig.numbers.name + ": its shafts have no torsion; see geared_rotor_12dof");
  }
  const Impact none{0.0, impact.duration_s};
  const Trace quiet = turning.Hit(none, turning.None());
  const Trace hit = turning.Hit(impact, turning.None());
  std::vector<Eigen::VectorXd> of_axis;
  for (Index a = 0; a < turning.axes(); ++a) {
    Pulses probe = turning.None();
    probe(0, a) = kProbeA;
    of_axis.emplace_back((turning.Hit(none, probe).torque_n_m.col(0) - quiet.torque_n_m.col(0)) /
                         kProbeA);
  }
  const Eigen::VectorXd passed = hit.torque_n_m.col(0) - quiet.torque_n_m.col(0);
  const Eigen::VectorXd room_a = RoomOf(hit, rig.numbers);
  const Index answer = (turning.lead() + kAnswer + kPulse - 1) / kPulse;
  relief.law = PassedBy(hit, quiet);
  const auto with = [&](Index first) {
    const Pulses best = BestFrom(first, turning, of_axis, passed, room_a);
    return PassedBy(turning.Hit(impact, best), quiet);
  };
  relief.answered = with(answer);
  relief.foreseen = with(0);
  return relief;
}

}  // namespace levitas::gears
