#include "tests/support/levitator_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "common/random.hpp"
#include "diagnosis/levitator/nominal.hpp"

namespace levitas::accuracy {
namespace {

/// The true rig, in numbers of its own.
struct Truth {
  double delay_samples{0.0};
  double supply{1.0}, resistance{1.0}, inductance{1.0}, profile{1.0};
  double dead_band_a{0.0}, heating_1_per_s{0.0}, motion_emf{0.0};
  double command_a{0.0};  ///< of the upper coil
  double eddy{0.0}, mutual{0.0}, away_supply{1.0};
  double probe_gain{1.0}, probe_offset_a{0.0};
  double force{1.0}, stiffness{1.0}, knee_a{1e3}, flux_lag_s{1e-6};
  double sensor_gain{1.0}, sensor_offset_m{0.0}, square_1_per_m{0.0};
  double mass{1.0}, load_n{0.0}, damping_n_s_per_m{0.0}, friction_n{0.0}, spring_n_per_m{0.0};
};

struct Knob {
  const char* id{};
  double size{};  ///< clear
  double Truth::*value{};
  bool signed_size{true};  ///< may be the other way round
};

constexpr std::array kKnobs{Knob{"extra_delay", 0.8, &Truth::delay_samples, false},
                            Knob{"supply_voltage", 0.12, &Truth::supply},
                            Knob{"coil_resistance", 0.12, &Truth::resistance},
                            Knob{"coil_inductance", 0.35, &Truth::inductance},
                            Knob{"inductance_profile", -0.4, &Truth::profile, false},
                            Knob{"voltage_drop", 0.1, &Truth::dead_band_a, false},
                            Knob{"coil_heating", 0.008, &Truth::heating_1_per_s, false},
                            Knob{"motion_emf", 0.5, &Truth::motion_emf, false},
                            Knob{"eddy_current", 0.15, &Truth::eddy, false},
                            Knob{"mutual_inductance", 0.08, &Truth::mutual, false},
                            Knob{"drive_asymmetry", 0.15, &Truth::away_supply},
                            Knob{"current_sensor_gain", 0.06, &Truth::probe_gain},
                            Knob{"force_constant", 0.15, &Truth::force},
                            Knob{"displacement_stiffness", 0.12, &Truth::stiffness},
                            Knob{"magnetic_saturation", 1.6, &Truth::knee_a, false},
                            Knob{"sensor_gain", 0.06, &Truth::sensor_gain},
                            Knob{"sensor_offset", 0.6e-3, &Truth::sensor_offset_m},
                            Knob{"sensor_nonlinearity", 20.0, &Truth::square_1_per_m},
                            Knob{"rotor_mass", 0.12, &Truth::mass},
                            Knob{"static_load", 0.05, &Truth::load_n},
                            Knob{"viscous_damping", 0.3, &Truth::damping_n_s_per_m, false},
                            Knob{"dry_friction", 0.02, &Truth::friction_n, false},
                            Knob{"coupling_stiffness", 15.0, &Truth::spring_n_per_m, false},
                            Knob{"command_offset", 0.04, &Truth::command_a, false}};

/// A healthy rig is off by this much everywhere.
void Mismatch(Random& random, Truth& truth) {
  const auto off = [&](double& value, double deviation) {
    value += deviation * std::clamp(random.Normal(), -2.0, 2.0);
  };
  off(truth.supply, 0.01);
  off(truth.resistance, 0.01);
  off(truth.inductance, 0.04);
  off(truth.profile, 0.01);
  off(truth.away_supply, 0.015);
  off(truth.probe_gain, 0.004);
  off(truth.probe_offset_a, 0.004);
  off(truth.force, 0.015);
  off(truth.stiffness, 0.015);
  off(truth.sensor_gain, 0.004);
  off(truth.sensor_offset_m, 25e-6);
  off(truth.mass, 0.002);
}

struct State {
  std::array<double, 2> current_a{};
  double flux_a{}, x_m{}, v_m_per_s{};
};

State Moved(const State& s, const State& slope, double h) {
  State out = s;
  for (std::size_t c = 0; c < 2; ++c) out.current_a[c] += h * slope.current_a[c];
  out.flux_a += h * slope.flux_a;
  out.x_m += h * slope.x_m;
  out.v_m_per_s += h * slope.v_m_per_s;
  return out;
}

class World {
 public:
  World(const levitator::NominalRig& rig, const Truth& truth) : rig_(rig), truth_(truth) {}

  void Advance(State& s, const std::array<double, 2>& asked_a, double duration_s) {
    constexpr double kStepS = 50e-6;
    const int steps = std::max(1, static_cast<int>(std::lround(duration_s / kStepS)));
    const double h = duration_s / steps;
    for (int i = 0; i < steps; ++i) {
      const State a = Slope(s, asked_a);
      const State b = Slope(Moved(s, a, 0.5 * h), asked_a);
      const State c = Slope(Moved(s, b, 0.5 * h), asked_a);
      const State d = Slope(Moved(s, c, h), asked_a);
      s = Moved(Moved(Moved(Moved(s, a, h / 6.0), b, h / 3.0), c, h / 3.0), d, h / 6.0);
      for (double& current : s.current_a) current = std::max(0.0, current);
      time_s_ += h;
    }
  }
  /// What the current probe sees: eddy currents carry a part at once.
  [[nodiscard]] double Probe(const State& s, std::size_t coil, double asked_a) const {
    const double at_last = Drive(coil, asked_a) / Resistance();
    const double seen = s.current_a[coil] + truth_.eddy * (at_last - s.current_a[coil]);
    return truth_.probe_gain * seen + truth_.probe_offset_a;
  }
  [[nodiscard]] double Sensor(const State& s) const {
    return truth_.sensor_gain * s.x_m + truth_.sensor_offset_m +
           truth_.square_1_per_m * s.x_m * s.x_m;
  }

 private:
  [[nodiscard]] double Resistance() const {
    return truth_.resistance * (1.0 + truth_.heating_1_per_s * time_s_);
  }
  [[nodiscard]] double Drive(std::size_t coil, double asked_a) const {
    // A bridge's drop sets in softly, within a tenth of it.
    const double soft = 0.1 * truth_.dead_band_a + 1e-9;
    const double u = asked_a + (coil == 0 ? truth_.command_a : 0.0) - truth_.dead_band_a;
    const double passed = u > 20.0 * soft ? u : soft * std::log1p(std::exp(u / soft));
    const double supply = rig_.steady * truth_.supply * (coil == 0 ? 1.0 : truth_.away_supply);
    return supply * passed + rig_.offset_a;
  }
  [[nodiscard]] State Slope(const State& s, const std::array<double, 2>& asked_a) const {
    State slope;
    for (std::size_t coil = 0; coil < 2; ++coil) {
      const double sign = coil == 0 ? -1.0 : 1.0;
      const double gap = (coil == 0 ? rig_.gap_m : rig_.far_gap_m) + sign * s.x_m;
      const double tau = rig_.time_constant_s * truth_.inductance *
                         std::exp(-truth_.profile * gap / rig_.inductance_decay_m);
      const double emf =
          (rig_.motion_emf + truth_.motion_emf) * sign * s.v_m_per_s / rig_.inductance_decay_m;
      slope.current_a[coil] =
          (Drive(coil, asked_a[coil]) - Resistance() * s.current_a[coil]) / tau +
          emf * s.current_a[coil];
    }
    const double alone = slope.current_a[0];
    slope.current_a[0] -= truth_.mutual * slope.current_a[1];
    slope.current_a[1] -= truth_.mutual * alone;
    slope.flux_a = (s.current_a[0] - s.flux_a) / std::max(truth_.flux_lag_s, 100e-6);
    slope.x_m = s.v_m_per_s;
    slope.v_m_per_s = Force(s) / (rig_.mass_kg * truth_.mass) - rig_.gravity_m_per_s2;
    return slope;
  }
  [[nodiscard]] double Force(const State& s) const {
    const auto bent = [&](double i) {
      return i / std::pow(1.0 + std::pow(i / truth_.knee_a, 4), 0.25);
    };
    const double grow = std::exp(truth_.stiffness * s.x_m / rig_.force_decay_m);
    const double lagging = truth_.flux_lag_s > 100e-6 ? s.flux_a : s.current_a[0];
    const double strength = rig_.force_n_per_a2 * truth_.force;
    const double up = strength * std::exp(-rig_.gap_m / rig_.force_decay_m) * grow;
    const double down = strength * std::exp(-rig_.far_gap_m / rig_.force_decay_m) / grow;
    constexpr double kSlopeMPerS = 1e-3;
    return up * std::pow(bent(lagging), 2) - down * std::pow(bent(s.current_a[1]), 2) +
           truth_.load_n - truth_.damping_n_s_per_m * s.v_m_per_s - truth_.spring_n_per_m * s.x_m -
           truth_.friction_n * s.v_m_per_s / (std::abs(s.v_m_per_s) + kSlopeMPerS);
  }

  levitator::NominalRig rig_;
  Truth truth_;
  double time_s_{};
};

/// Keeps the ball at its reference, from readings alone: a law of the technician's own.
class Law {
 public:
  explicit Law(const levitator::NominalRig& rig) : rig_(rig) {}

  double Step(double reading_m, double reference_m) {
    constexpr double kStiffAPerM = 260.0;
    constexpr double kDampASPerM = 5.5;
    constexpr double kSumAPerMS = 400.0;
    constexpr double kFilter = 0.35;
    const double before_m = smooth_m_;
    smooth_m_ = first_ ? reading_m : smooth_m_ + kFilter * (reading_m - smooth_m_);
    const double rate = first_ ? 0.0 : (smooth_m_ - before_m) / rig_.period_s;
    sum_m_s_ += rig_.period_s * (reading_m - reference_m);
    const double wanted_a =
        1.05 - kStiffAPerM * (reading_m - reference_m) - kDampASPerM * rate - kSumAPerMS * sum_m_s_;
    // The coil's lag, 3.5 ms at this gap, is led by as much.
    const double slope = first_ ? 0.0 : (wanted_a - wanted_before_a_) / rig_.period_s;
    lead_ += 0.5 * (slope - lead_);
    wanted_before_a_ = wanted_a;
    first_ = false;
    return std::clamp(wanted_a + 3.0e-3 * lead_, 0.0, rig_.full_a);
  }

 private:
  levitator::NominalRig rig_;
  double smooth_m_{}, sum_m_s_{}, wanted_before_a_{}, lead_{};
  bool first_{true};
};

double Reference(std::size_t record, double time_s) {
  if (record % 2 == 0) {
    constexpr std::array kStairsM{0.0, 1e-3, 2e-3, 0.5e-3, -1e-3, -2e-3, -0.5e-3};
    return kStairsM[static_cast<std::size_t>(time_s / 0.9) % kStairsM.size()];
  }
  return 1.6e-3 * std::sin(2.0 * std::numbers::pi * 0.7 * time_s) +
         0.4e-3 * std::sin(2.0 * std::numbers::pi * 3.1 * time_s);
}

double Stepped(double value, double step) { return step * std::round(value / step); }

levitator::Series Record(const levitator::NominalRig& rig, const Truth& truth, std::size_t record,
                         Random& random, bool& stable) {
  constexpr std::size_t kRows = 6000;
  World world(rig, truth);
  Law law(rig);
  levitator::Series out;
  out.name = "record " + std::to_string(record + 1);
  State state;
  state.current_a = {1.05, 0.0};
  state.flux_a = 1.05;
  std::array<double, 2> acting{1.05, 0.0};
  std::array<double, 2> before = acting;
  double random_a = 0.0;
  double lower_a = 0.0;
  for (std::size_t n = 0; n < kRows; ++n) {
    const double time_s = static_cast<double>(n) * rig.period_s;
    if (n % 8 == 0) random_a = random.Uniform() < 0.5 ? -0.12 : 0.12;
    if (record % 2 == 1 && n % 60 == 0) lower_a = 1.5 * random.Uniform();
    const double reading = Stepped(world.Sensor(state) + 16e-6 * random.Normal(), 1.352e-6);
    const std::array<double, 2> probes{
        Stepped(world.Probe(state, 0, before[0]) + 6.2e-3 * random.Normal(), 2.531e-3),
        Stepped(world.Probe(state, 1, before[1]) + 6.2e-3 * random.Normal(), 2.531e-3)};
    const std::array<double, 2> asked{
        std::clamp(law.Step(reading, Reference(record, time_s)) + random_a, 0.0, rig.full_a),
        lower_a};
    out.time_s.push_back(time_s);
    out.position_m.push_back(reading);
    out.restart.push_back(n == 0);
    out.counts.push_back(n >= 800);
    for (std::size_t c = 0; c < 2; ++c) {
      out.asked_a[c].push_back(asked[c]);
      out.measured_a[c].push_back(probes[c]);
    }
    const double late_s = std::clamp(truth.delay_samples, 0.0, 1.0) * rig.period_s;
    if (late_s > 1e-9) world.Advance(state, acting, late_s);
    if (rig.period_s - late_s > 1e-9) world.Advance(state, asked, rig.period_s - late_s);
    before = late_s > 0.5 * rig.period_s ? acting : asked;
    acting = asked;
    if (!(std::abs(state.x_m) < 5.5e-3)) {
      stable = false;
      break;
    }
  }
  out.idle = {false, record % 2 == 0};
  return out;
}

}  // namespace

const std::vector<LevitatorEffect>& LevitatorEffects() {
  static const std::vector<LevitatorEffect> kEffects = [] {
    std::vector<LevitatorEffect> effects;
    effects.reserve(kKnobs.size());
    for (const Knob& knob : kKnobs) effects.push_back({knob.id, knob.size});
    return effects;
  }();
  return kEffects;
}

LevitatorTrial MakeLevitatorTrial(const configuration::RigFile& rig, std::uint64_t seed,
                                  const std::string& hidden) {
  const levitator::NominalRig nominal = levitator::NominalOf(rig);
  LevitatorTrial trial;
  for (std::uint64_t attempt = 0; attempt < 8; ++attempt) {
    Random random(seed * 1009 + attempt);
    Truth truth;
    Mismatch(random, truth);
    const Knob& drawn = kKnobs[random.Bits() % kKnobs.size()];
    const auto given = std::find_if(kKnobs.begin(), kKnobs.end(),
                                    [&](const Knob& knob) { return hidden == knob.id; });
    const Knob& knob = given != kKnobs.end() ? *given : drawn;
    trial = {};
    trial.hidden = hidden == "none" ? hidden : knob.id;
    if (trial.hidden != "none") {
      const bool turned = knob.signed_size && random.Uniform() < 0.5;
      trial.size = (turned ? -1.0 : 1.0) * knob.size * (1.0 + 0.3 * random.Uniform());
      if (knob.value == &Truth::knee_a) {
        truth.knee_a = trial.size;
      } else {
        truth.*knob.value += trial.size;
      }
      if (knob.value == &Truth::eddy) truth.flux_lag_s = 1.2e-3;
    }
    for (std::size_t record = 0; record < 2 && trial.stable; ++record) {
      trial.records.push_back(Record(nominal, truth, record, random, trial.stable));
    }
    if (trial.stable) break;
  }
  return trial;
}

}  // namespace levitas::accuracy
