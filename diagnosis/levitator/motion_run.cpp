#include "diagnosis/levitator/motion_run.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::levitator {
namespace {

struct ForceLaw {
  double up_n_per_a2{}, down_n_per_a2{};  ///< at x = 0
  double per_x_1_per_m{};
  double exponent{}, knee_1_per_a2{};
  double load_n{}, damping_n_s_per_m{}, friction_n{}, spring_n_per_m{};
  double mass_kg{}, gravity_m_per_s2{};

  [[nodiscard]] double Square(double current_a) const {
    const double i = std::max(0.0, current_a);
    const double square = i * i / (1.0 + knee_1_per_a2 * i * i);
    if (exponent == 0.0 || i <= 0.0) return square;
    return square * std::pow(i, exponent);
  }
  [[nodiscard]] double Acceleration(double x_m, double v_m_per_s, double up_a2,
                                    double down_a2) const {
    const double grow = std::exp(std::clamp(x_m * per_x_1_per_m, -20.0, 20.0));
    constexpr double kSlowMPerS = 2e-3;  // below it friction is not told from damping
    const double force = up_n_per_a2 * up_a2 * grow - down_n_per_a2 * down_a2 / grow + load_n -
                         damping_n_s_per_m * v_m_per_s - spring_n_per_m * x_m -
                         friction_n * std::tanh(v_m_per_s / kSlowMPerS);
    return force / mass_kg - gravity_m_per_s2;
  }
};

ForceLaw LawOf(const NominalRig& rig, const Theta& theta) {
  ForceLaw law;
  const double strength = rig.force_n_per_a2 * (1.0 + theta[kForce]);
  law.up_n_per_a2 = strength * std::exp(-rig.gap_m / rig.force_decay_m);
  law.down_n_per_a2 =
      strength * (1.0 + theta[kForceAway]) * std::exp(-rig.far_gap_m / rig.force_decay_m);
  law.per_x_1_per_m = (1.0 + theta[kForceDecay]) / rig.force_decay_m;
  law.exponent = theta[kForceExponent];
  law.knee_1_per_a2 = theta[kForceKnee];
  law.load_n = theta[kLoad];
  law.damping_n_s_per_m = theta[kDamping];
  law.friction_n = theta[kDryFriction];
  law.spring_n_per_m = theta[kSpring];
  law.mass_kg = rig.mass_kg * (1.0 + theta[kMass]);
  law.gravity_m_per_s2 = rig.gravity_m_per_s2;
  return law;
}

/// Currents that make force, in both coils, row by row.
std::array<std::vector<double>, 2> Fluxes(const NominalRig& rig, const Series& series,
                                          const Theta& theta, const CoilRun& modelled) {
  std::array<std::vector<double>, 2> out =
      series.has_currents() ? series.measured_a : modelled.current_a;
  const double share = theta[kProbeLag] / rig.period_s;
  for (std::size_t coil = 0; coil < 2; ++coil) {
    std::vector<double>& flux = out[coil];
    if (series.has_currents()) {
      const std::vector<double>& read = series.measured_a[coil];
      for (std::size_t n = 0; n < flux.size(); ++n) {
        const bool inside = n + 1 < flux.size() && !series.restart[n + 1];
        const double late = share * (inside ? read[n + 1] - read[n] : 0.0);
        flux[n] = (read[n] + late - theta[kProbeOffset]) / (1.0 + theta[kProbeGain]);
      }
    }
    const double keep = theta[kForceLag] > 0.0 ? std::exp(-rig.period_s / theta[kForceLag]) : 0.0;
    for (std::size_t n = 1; n < flux.size(); ++n) {
      if (!series.restart[n]) flux[n] += keep * (flux[n - 1] - flux[n]);
    }
  }
  return out;
}

double Reading(const Theta& theta, double offset_m, double x_m, double v_m_per_s) {
  const double x = x_m - theta[kSensorLag] * v_m_per_s;
  return (1.0 + theta[kSensorGain]) * x + offset_m + theta[kSensorSquare] * x * x +
         theta[kSensorCube] * x * x * x;
}

struct Gains {
  double position{}, velocity_1_per_s{};
};

Gains ObserverGains(const NominalRig& rig) {
  const double pole = std::exp(-kObserverRadPerS * rig.period_s);
  // The magnets' pull grows with x at g/d, which the correction has to overcome too.
  const double unstable_1_per_s2 = rig.gravity_m_per_s2 / rig.force_decay_m;
  return {1.0 - pole * pole,
          (1.0 - pole) * (1.0 - pole) / rig.period_s + unstable_1_per_s2 * rig.period_s};
}

/// Position and velocity of the model's ball.
struct Ball {
  double x_m{}, v_m_per_s{};
};

/// The model on one record: steps from a row to the next, and is corrected.
class Walk {
 public:
  Walk(const NominalRig& rig, const Series& series, const Theta& theta, std::size_t record,
       const CoilRun& modelled)
      : series_(series),
        theta_(ComposedWith(rig.origin, theta)),
        record_(record),
        law_(LawOf(rig, theta_)),
        gains_(ObserverGains(rig)),
        flux_(Fluxes(rig, series, theta_, modelled)),
        offset_m_(theta_[kSensorOffset] + theta_[Own(record, kOwnOffset)]),
        period_s_(rig.period_s) {}

  [[nodiscard]] Ball Start(std::size_t row) const {
    return {TruePosition(series_.position_m[row], theta_, record_), 0.0};
  }
  /// To `row` from the one before.
  void Step(std::size_t row, Ball& ball) const {
    const double up = 0.5 * (law_.Square(flux_[0][row - 1]) + law_.Square(flux_[0][row]));
    const double down = 0.5 * (law_.Square(flux_[1][row - 1]) + law_.Square(flux_[1][row]));
    const double half_s = 0.5 * period_s_;
    const double a =
        law_.Acceleration(ball.x_m + half_s * ball.v_m_per_s, ball.v_m_per_s, up, down);
    ball.x_m += period_s_ * (ball.v_m_per_s + half_s * a);
    ball.v_m_per_s += period_s_ * a;
  }
  /// Measured minus what the model reads.
  [[nodiscard]] double Error(std::size_t row, const Ball& ball) const {
    return series_.position_m[row] - Reading(theta_, offset_m_, ball.x_m, ball.v_m_per_s);
  }
  void Correct(double innovation_m, Ball& ball) const {
    const double seen_m = innovation_m / (1.0 + theta_[kSensorGain]);
    ball.x_m += gains_.position * seen_m;
    ball.v_m_per_s += gains_.velocity_1_per_s * seen_m;
  }

 private:
  const Series& series_;
  Theta theta_;
  std::size_t record_;
  ForceLaw law_;
  Gains gains_;
  std::array<std::vector<double>, 2> flux_;
  double offset_m_;
  double period_s_;
};

}  // namespace

std::vector<double> Innovations(const NominalRig& rig, const Series& series, const Theta& theta,
                                std::size_t record, const CoilRun& modelled) {
  const Walk walk(rig, series, theta, record, modelled);
  std::vector<double> innovation(series.size(), 0.0);
  Ball ball;
  for (std::size_t n = 0; n < series.size(); ++n) {
    if (series.restart[n]) {
      ball = walk.Start(n);
      continue;
    }
    walk.Step(n, ball);
    innovation[n] = walk.Error(n, ball);
    walk.Correct(innovation[n], ball);
  }
  return innovation;
}

}  // namespace levitas::levitator
