#include "identification/nonlinear/suspended_rotor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kDivergedM = 1e-2;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// One mode over one sample under a constant force: eta and eta' from before, and from the force.
struct ModeStep {
  double xx{}, xv{}, x1{}, vx{}, vv{}, v1{};
};

ModeStep StepOf(const RotorMode& mode, double h_s) {
  const double w = kTurn * mode.frequency_hz;
  if (!(w > 0.0)) return {1.0, h_s, 0.5 * h_s * h_s, 0.0, 1.0, h_s};
  const double decay = mode.damping_ratio * w;
  const double turn = w * std::sqrt(std::max(1e-12, 1.0 - mode.damping_ratio * mode.damping_ratio));
  const double e = std::exp(-decay * h_s);
  const double c = e * std::cos(turn * h_s);
  const double s = e * std::sin(turn * h_s) / turn;
  return {c + decay * s, s, (1.0 - c - decay * s) / (w * w), -w * w * s, c - decay * s, s};
}

struct Mode {
  ModeStep step;
  const RotorMode* of;
  double eta{}, rate{};
};

/// Coil current of one axis: its value at the sample, its mean over the next one.
struct Coil {
  double decay, mean, now{};

  explicit Coil(double bandwidth_hz, double period_s)
      : decay(std::exp(-kTurn * bandwidth_hz * period_s)),
        mean((1.0 - decay) / (kTurn * bandwidth_hz * period_s)) {}
  double Follow(double command_a) noexcept {
    const double lag = now - command_a;
    now = command_a + lag * decay;
    return command_a + lag * mean;
  }
};

class Run {
 public:
  explicit Run(const SuspendedRotor& model)
      : model_(model),
        x_(model.axes()),
        rate_(model.axes()),
        h_(model.axes()),
        pending_(Eigen::MatrixXd::Zero(model.axes(), model.delay + 1)) {
    for (const AxisForce& force : model.axis)
      coils_.emplace_back(force.amplifier_hz, model.period_s);
    for (std::size_t p = 0; p < 2; ++p) {
      for (const RotorMode& mode : model.plane[p]) {
        modes_[p].push_back({StepOf(mode, model.period_s), &mode});
      }
    }
    Place();
  }

  [[nodiscard]] const Eigen::VectorXd& x() const noexcept { return x_; }

  /// On by one sample with the command computed at the present one.
  void Advance(Index k, const Eigen::VectorXd& u) {
    pending_.col(k % pending_.cols()) = u;
    const auto command = pending_.col((k + 1) % pending_.cols());  // `delay` samples old
    for (Index a = 0; a < x_.size(); ++a) {
      const auto at = static_cast<std::size_t>(a);
      h_[a] = model_.axis[at].At(coils_[at].Follow(command[a]),
                                 x_[a] + 0.5 * model_.period_s * rate_[a]);
    }
    for (std::size_t p = 0; p < 2; ++p) {
      for (Mode& m : modes_[p]) {
        double push = 0.0;
        for (Index b = 0; b < m.of->in.size(); ++b)
          push += m.of->in[b] * h_[2 * b + static_cast<Index>(p)];
        const double eta = m.eta;
        m.eta = m.step.xx * eta + m.step.xv * m.rate + m.step.x1 * push;
        m.rate = m.step.vx * eta + m.step.vv * m.rate + m.step.v1 * push;
      }
    }
    Place();
  }

 private:
  void Place() {
    x_.setZero();
    rate_.setZero();
    for (std::size_t p = 0; p < 2; ++p) {
      for (const Mode& m : modes_[p]) {
        for (Index b = 0; b < m.of->out.size(); ++b) {
          x_[2 * b + static_cast<Index>(p)] += m.of->out[b] * m.eta;
          rate_[2 * b + static_cast<Index>(p)] += m.of->out[b] * m.rate;
        }
      }
    }
  }

  const SuspendedRotor& model_;
  std::vector<Coil> coils_;
  std::array<std::vector<Mode>, 2> modes_;
  Eigen::VectorXd x_, rate_, h_;
  Eigen::MatrixXd pending_;
};

}  // namespace

double AxisForce::At(double current_a, double x_m) const noexcept {
  const double z = current_a / bias_a;  // c - 1 of the one coil, 1 - c of the other
  double near = 0.0;
  double far = 0.0;
  for (Index n = iron.size(); n-- > 0;) {
    near = (near + iron[n]) * z;
    far = (far + iron[n]) * -z;
  }
  const double flux_near = (1.0 + z + near) / (1.0 - x_m / gap_m);
  const double flux_far = (1.0 - z + far) / (1.0 + x_m / gap_m);
  return offset_a +
         0.25 * bias_a *
             ((1.0 + imbalance) * flux_near * flux_near - (1.0 - imbalance) * flux_far * flux_far);
}

Prediction RunFree(const SuspendedRotor& model, Index rows, const Feedback& feedback) {
  Run run(model);
  Prediction result{Eigen::MatrixXd::Zero(rows, model.axes())};
  Eigen::VectorXd y(model.axes());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.axes());
  for (Index k = 0; k < rows; ++k) {
    if (!(run.x().cwiseAbs().maxCoeff() < kDivergedM)) {
      result.diverged_at = k;
      break;
    }
    for (Index a = 0; a < y.size(); ++a) {
      y[a] = model.sensor[static_cast<std::size_t>(a)].Read(run.x()[a]);
    }
    result.output.row(k) = y.transpose();
    feedback(k, y, u);
    run.Advance(k, u);
  }
  return result;
}

}  // namespace levitas::identification
