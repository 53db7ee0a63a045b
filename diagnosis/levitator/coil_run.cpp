#include "diagnosis/levitator/coil_run.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::levitator {
namespace {

/// One coil's law with its values worked out.
struct CoilLaw {
  double supply{}, command_a{}, dead_band_a{}, curvature{}, offset_a{}, full_a{};
  double resistance{}, heating_1_per_s{};
  double inductance_s{}, per_gap_1_per_m{}, iron_1_per_a2{};
  double emf_1_per_m{};
  double gap_m{}, gap_sign{};

  [[nodiscard]] double Drive(double commanded_a) const {
    const double asked_a = commanded_a + command_a;
    const double u = std::max(0.0, asked_a - dead_band_a);
    return supply * (u + curvature * u * (1.0 - asked_a / full_a)) + offset_a;
  }
  [[nodiscard]] double Resistance(double time_s) const {
    return std::max(0.05, resistance * (1.0 + heating_1_per_s * time_s));
  }
  /// Inductance over the nominal resistance at a gap [s].
  [[nodiscard]] double Slowness(double gap) const {
    return inductance_s * std::exp(-std::clamp(per_gap_1_per_m * gap, -20.0, 20.0));
  }
  [[nodiscard]] double Follow(double now_a, double drive_a, double r, double slowness_s,
                              double gap_rate, double duration_s) const {
    const double supply_1_per_s = (1.0 + iron_1_per_a2 * now_a * now_a) / slowness_s;
    const double rate = r * supply_1_per_s - emf_1_per_m * gap_rate;
    const double turns = rate * duration_s;
    const double fallen = -std::expm1(-std::max(turns, -50.0));
    const double weight = std::abs(turns) < 1e-12 ? duration_s : fallen / rate;
    return std::max(0.0, now_a * (1.0 - fallen) + drive_a * supply_1_per_s * weight);
  }
};

CoilLaw LawOf(const NominalRig& rig, const Theta& theta, std::size_t record, std::size_t coil) {
  const double away = coil == 0 ? 0.0 : 1.0;
  CoilLaw law;
  law.full_a = rig.full_a;
  law.supply = rig.steady * (1.0 + theta[kSupply]) * (1.0 + away * theta[kAwaySupply]);
  law.command_a = theta[coil == 0 ? kCommandUpper : kCommandLower];
  law.dead_band_a = theta[kDeadBand];
  law.curvature = theta[kDriveCurve];
  law.offset_a = rig.offset_a;
  law.resistance = (1.0 + theta[kResistance]) * (1.0 + theta[Own(record, kOwnResistance)]);
  law.heating_1_per_s = theta[kHeating];
  law.inductance_s =
      rig.time_constant_s * (1.0 + theta[kInductance]) * (1.0 + away * theta[kAwayInductance]);
  law.per_gap_1_per_m = (1.0 - theta[kProfile]) / rig.inductance_decay_m;
  law.iron_1_per_a2 = theta[kIronInductance];
  law.emf_1_per_m = (rig.motion_emf + theta[kMotionEmf]) / rig.inductance_decay_m;
  law.gap_m = coil == 0 ? rig.gap_m : rig.far_gap_m;
  law.gap_sign = coil == 0 ? -1.0 : 1.0;
  return law;
}

/// Whole and fractional samples from a duty to its action.
struct Delay {
  std::size_t whole{};
  double fraction{};
};

Delay DelayOf(const NominalRig& rig, const Theta& theta) {
  const double samples = std::clamp(rig.delay_samples + theta[kDelay], 0.0, 50.0);
  const double whole = std::floor(samples);
  return {static_cast<std::size_t>(whole), samples - whole};
}

/// Reading, late by a lag: along the line between two samples.
void Probe(const Theta& theta, double period_s, std::vector<double>& reading_a) {
  const double gain = 1.0 + theta[kProbeGain];
  const double share = theta[kProbeLag] / period_s;
  double before = reading_a.front();
  for (double& value : reading_a) {
    const double now = value;
    value = gain * (now - share * (now - before)) + theta[kProbeOffset];
    before = now;
  }
}

void Couple(double share, CoilRun& run) {
  const std::array<std::vector<double>, 2> alone = run.reading_a;
  for (std::size_t coil = 0; coil < 2; ++coil) {
    // What a changing flux drives through a coil that is short by its free-wheeling diode decays
    // within the coil's own time; 30 ms of the law of the rig file.
    constexpr double kDecay = 0.967;
    double induced_a = 0.0;
    for (std::size_t n = 1; n < alone[coil].size(); ++n) {
      induced_a = kDecay * induced_a - share * (alone[1 - coil][n] - alone[1 - coil][n - 1]);
      run.reading_a[coil][n] = std::max(0.0, alone[coil][n] + induced_a);
      run.current_a[coil][n] += run.reading_a[coil][n] - alone[coil][n];
    }
  }
}

void RunCoil(const NominalRig& rig, const Series& series, const std::vector<double>& position_m,
             const Theta& theta, std::size_t record, std::size_t coil, CoilRun& out) {
  const CoilLaw law = LawOf(rig, theta, record, coil);
  const Delay delay = DelayOf(rig, theta);
  const std::vector<double>& asked = series.asked_a[coil];
  const double gain = 1.0 + theta[kProbeGain];
  const auto start = [&](std::size_t n) {
    if (!series.has_currents()) return std::max(0.0, law.Drive(asked[n]) / law.Resistance(0.0));
    return std::max(0.0, (series.measured_a[coil][n] - theta[kProbeOffset]) / gain);
  };
  out.current_a[coil].resize(series.size());
  out.reading_a[coil].resize(series.size());
  if (series.idle[coil]) {
    // Never asked for anything: what is there stays, whatever its inductance.
    for (std::size_t n = 0; n < series.size(); ++n) {
      const double rest_a = law.Drive(0.0) / law.Resistance(series.time_s[n]);
      out.current_a[coil][n] = out.reading_a[coil][n] = std::max(0.0, rest_a);
    }
    return;
  }
  double now = 0.0;
  std::size_t first = 0;
  for (std::size_t n = 0; n < series.size(); ++n) {
    if (series.restart[n]) {
      now = start(n);
      first = n;
    }
    out.current_a[coil][n] = now;
    const double drive = law.Drive(asked[n >= first + delay.whole ? n - delay.whole : first]);
    const double older =
        law.Drive(asked[n >= first + delay.whole + 1 ? n - delay.whole - 1 : first]);
    const double r = law.Resistance(series.time_s[n]);
    out.reading_a[coil][n] = now + theta[kEddyShare] * (std::max(0.0, older / r) - now);
    if (n + 1 >= series.size() || series.restart[n + 1]) continue;
    const double gap = law.gap_m + law.gap_sign * 0.5 * (position_m[n] + position_m[n + 1]);
    const double gap_rate = law.gap_sign * (position_m[n + 1] - position_m[n]) / rig.period_s;
    const double slowness = law.Slowness(gap);
    const double early_s = delay.fraction * rig.period_s;
    if (early_s > 0.0) now = law.Follow(now, older, r, slowness, gap_rate, early_s);
    now = law.Follow(now, drive, r, slowness, gap_rate, rig.period_s - early_s);
  }
}

}  // namespace

double TruePosition(double measured_m, const Theta& theta, std::size_t record) {
  const double straight = (measured_m - theta[kSensorOffset] - theta[Own(record, kOwnOffset)]) /
                          (1.0 + theta[kSensorGain]);
  // One step of the inverse: the curvature is a small part of the reading.
  const double curve = theta[kSensorSquare] * straight * straight +
                       theta[kSensorCube] * straight * straight * straight;
  return straight - curve / (1.0 + theta[kSensorGain]);
}

CoilRun RunCoils(const NominalRig& rig, const Series& series, const Theta& beside,
                 std::size_t record) {
  const Theta theta = ComposedWith(rig.origin, beside);
  std::vector<double> position_m;
  position_m.reserve(series.size());
  for (const double measured : series.position_m) {
    position_m.push_back(TruePosition(measured, theta, record));
  }
  CoilRun out;
  for (std::size_t coil = 0; coil < 2; ++coil) {
    RunCoil(rig, series, position_m, theta, record, coil, out);
  }
  if (theta[kMutual] != 0.0) Couple(theta[kMutual], out);
  for (auto& reading : out.reading_a) Probe(theta, rig.period_s, reading);
  return out;
}

}  // namespace levitas::levitator
