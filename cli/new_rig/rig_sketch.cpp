#include "cli/new_rig/rig_sketch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

constexpr double kSteelKgPerM3 = 7850.0;
constexpr std::array<const char*, 2> kBearingNames{"front", "rear"};
constexpr double kGradeMPerS = 2.5e-3;  // G 2.5 of ISO 21940-11: e times the speed
constexpr double kSecondsToTop = 10.0;
constexpr double kStandingShare = 0.05;
constexpr double kSpinningShare = 0.3;
constexpr double kGravity = 9.81;
constexpr double kDegree = std::numbers::pi / 180.0;

/// Of each bearing plane.
double UnbalanceGMm(const RigSketch& sketch) {
  const double speed_rad_per_s = sketch.max_speed_rpm * std::numbers::pi / 30.0;
  return 0.5 * 1e6 * sketch.mass_kg * kGradeMPerS / speed_rad_per_s;
}

/// Outboard of the magnet, within the shaft.
double SensorOf(const RigSketch& sketch, double magnet_mm, bool front) {
  const double end_mm = front ? magnet_mm : sketch.length_mm - magnet_mm;
  const double away_mm = std::min(20.0, 0.5 * end_mm);
  return front ? magnet_mm - away_mm : magnet_mm + away_mm;
}

void RefuseBeyond(const RigSketch& sketch, double z_mm, const char* what) {
  if (z_mm >= 0.0 && z_mm <= sketch.length_mm) return;
  throw BadInput(fmt::format("{}: found {:g} mm, allowed 0 to {:g} mm, the length of the rotor",
                             what, z_mm, sketch.length_mm));
}

std::string DiscsText(const RigSketch& sketch) {
  std::string text;
  if (!sketch.discs.empty()) {
    text += "  discs:                     # solid discs, thin: Ip = m d^2/8, Id = m d^2/16\n";
  }
  for (const SketchDisc& disc : sketch.discs) {
    const double square_m2 = 1e-6 * disc.diameter_mm * disc.diameter_mm;
    // Ip is twice what is written of Id: rounded by itself it could exceed what any body has.
    const std::string diametral = fmt::format("{:.6g}", disc.mass_kg * square_m2 / 16.0);
    text += fmt::format(
        "    - {{z_mm: {:.6g}, mass_kg: {:.6g}, diametral_inertia_kg_m2: {}, "
        "polar_inertia_kg_m2: {:.9g}}}\n",
        disc.z_mm, disc.mass_kg, diametral, 2.0 * std::stod(diametral));
  }
  return text;
}

std::string UnbalanceText(const RigSketch& sketch, const SketchNumbers& n) {
  std::string text =
      "  unbalance:                 # grade G 2.5 of ISO 21940-11 at top speed (assumed)\n";
  const std::array<int, 2> phases{0, 90};
  for (std::size_t b = 0; b < 2; ++b) {
    text += fmt::format("    - {{z_mm: {:.6g}, moment_g_mm: {:.4g}, phase_deg: {}}}\n",
                        n.bearings_mm[b], UnbalanceGMm(sketch), phases[b]);
  }
  // Two planes in one place would share what one has.
  const double apart_mm = 0.02 * sketch.length_mm;
  std::vector<double> taken_mm(n.bearings_mm.begin(), n.bearings_mm.end());
  for (const SketchDisc& disc : sketch.discs) {
    const auto near = [&](double z_mm) { return std::abs(z_mm - disc.z_mm) < apart_mm; };
    if (std::ranges::any_of(taken_mm, near)) continue;
    text += fmt::format(
        "    - {{z_mm: {:.6g}, moment_g_mm: 0, phase_deg: 0}}  # amb balance and amb diagnose look "
        "here, too\n",
        disc.z_mm);
    taken_mm.push_back(disc.z_mm);
  }
  return text;
}

std::string RotorText(const RigSketch& sketch, const SketchNumbers& n) {
  const std::string text = fmt::format(
      "rotor:\n"
      "  material:                  # steel (assumed)\n"
      "    young_gpa: 210\n"
      "    poisson: 0.3\n"
      "    density_kg_per_m3: {:g}\n"
      "  sections:                  # one piece; the diameter follows from {:.6g} kg of shaft: "
      "list "
      "the real ones\n"
      "    - {{length_mm: {:.6g}, outer_diameter_mm: {:.6g}}}\n",
      kSteelKgPerM3, n.shaft_mass_kg, sketch.length_mm, n.diameter_mm);
  return text + DiscsText(sketch) + UnbalanceText(sketch, n) +
         fmt::format(
             "  max_element_length_mm: {:.4g}\n"
             "  modes_per_plane: 5         # two rigid, three bending\n"
             "  modal_damping_ratio: 0.003 # of the material (assumed)\n\n",
             std::max(0.1, sketch.length_mm / 40.0));
}

/// The strength of a magnet as it was given: by its coil, or by ki.
std::string StrengthText(const RigSketch& sketch, const SketchNumbers& n) {
  if (sketch.turns > 0.0) {
    return fmt::format(
        "      turns: {:.6g}             # of one coil\n"
        "      pole_area_mm2: {:.6g}\n"
        "      half_pole_angle_deg: {:g}  # (assumed): ki {:.4g} N/A, ks {:.3g} N/m\n",
        sketch.turns, sketch.pole_area_mm2, kHalfPoleAngleDeg, sketch.ki_n_per_a, n.ks_n_per_m);
  }
  return fmt::format("      ki_n_per_a: {:.6g}       # ks = ki i0 / s0 = {:.3g} N/m\n",
                     sketch.ki_n_per_a, n.ks_n_per_m);
}

/// What a bearing has of the rotor by the lever: its weight, or of a shaft that stands its inertia.
std::string ShareText(const RigSketch& sketch, double mass_kg) {
  return sketch.vertical ? fmt::format("guides {:.3g} kg, carries no weight", mass_kg)
                         : fmt::format("carries {:.3g} kg", mass_kg);
}

std::string GravityText(const RigSketch& sketch) {
  return fmt::format(
      "gravity:\n  acceleration_m_per_s2: {:g}{}\n  direction_deg: 225         # {}\n\n",
      sketch.vertical ? 0.0 : kGravity,
      sketch.vertical ? "   # the shaft stands: its axial bearing, which is none of "
                        "these, carries the weight"
                      : "",
      sketch.vertical ? "of no effect without weight"
                      : "x and y stand at 45 degrees to the vertical (assumed)");
}

std::string BearingText(const RigSketch& sketch, const SketchNumbers& n, std::size_t b) {
  return fmt::format(
      "  - name: {}                # axes {}_x and {}_y; {}\n"
      "    actuator_z_mm: {:.6g}\n"
      "    sensor_z_mm: {:.6g}        # beside the magnet (assumed): where is your probe?\n"
      "    magnet:\n"
      "      gap_mm: {:.6g}\n"
      "{}"
      "    amplifier:\n"
      "      bandwidth_hz: {:.6g}     # of the current loop{}\n"
      "      dac_bits: 16           # (assumed)\n"
      "    sensor:\n"
      "      bandwidth_hz: 5000     # (assumed)\n"
      "      noise_rms_um: 0.5      # (assumed): amb run asks much of the current for it\n"
      "      adc_bits: 16           # (assumed)\n"
      "      range_um: {:.6g}        # (assumed) as far as the gap\n"
      "    touchdown:               # stiffness, damping, friction, radius: defaults "
      "(docs/configuration.md)\n"
      "      clearance_um: {:.6g}     # half the air gap (assumed)\n\n",
      kBearingNames[b], kBearingNames[b], kBearingNames[b], ShareText(sketch, n.carried_kg[b]),
      n.bearings_mm[b], SensorOf(sketch, n.bearings_mm[b], b == 0), sketch.gap_mm,
      StrengthText(sketch, n), sketch.amplifier_hz,
      sketch.amplifier_hz == RigSketch{}.amplifier_hz ? " (assumed)" : "", 1e3 * sketch.gap_mm,
      n.clearance_um);
}

std::string FiltersText(const RigSketch& sketch, const StartLaw& law) {
  std::string text;
  if (law.lead) {
    text += fmt::format("    lead_lags:\n      - {{zero_hz: {:.6g}, pole_hz: {:.6g}}}\n",
                        0.05 * sketch.rate_hz, 0.15 * sketch.rate_hz);
  }
  if (!law.notch_hz.empty()) text += "    notches:                 # about the bending modes\n";
  for (const double hz : law.notch_hz) {
    text += fmt::format(
        "      - {{frequency_hz: {:.6g}, zero_damping: 0.15, pole_damping: 0.8, prewarp: true}}\n",
        hz);
  }
  return text;
}

std::string LawText(const RigSketch& sketch, const SketchNumbers& n, const StartLaw& law,
                    std::size_t b) {
  constexpr double kIntegral = 5.0;  // [1/s] of Kp
  // A bearing that carries nothing by the lever still holds its share of the inertia.
  const double mass_kg = std::max(n.carried_kg[b], 0.25 * sketch.mass_kg);
  const double kp = law.stiffness * n.ks_n_per_m / sketch.ki_n_per_a;
  const double kd = 2.0 * law.damping * std::sqrt((law.stiffness - 1.0) * n.ks_n_per_m * mass_kg) /
                    sketch.ki_n_per_a;
  return fmt::format(
             "  {}:\n"
             "    kp_a_per_m: {:.6g}        # {:g} ks/ki: against the magnet {:g} ks is left over\n"
             "    ki_a_per_m_s: {:.6g}      # 5 1/s of kp: {} within a quarter second\n"
             "    kd_a_s_per_m: {:.6g}      # damping ratio {:g} of {:.3g} kg on it\n"
             "    derivative_corner_hz: {:.6g}\n",
             kBearingNames[b], kp, law.stiffness, law.stiffness - 1.0, kIntegral * kp,
             sketch.vertical ? "takes up a steady force" : "carries the weight", kd, law.damping,
             mass_kg, 0.15 * sketch.rate_hz) +
         FiltersText(sketch, law);
}

}  // namespace

double SketchAcceleration(const RigSketch& sketch) {
  return std::max(1.0, sketch.max_speed_rpm / kSecondsToTop);
}

double SketchPatience(const RigSketch& sketch) {
  return 1.5 * sketch.max_speed_rpm / SketchAcceleration(sketch) + 5.0;
}

SketchNumbers NumbersOf(const RigSketch& sketch) {
  SketchNumbers n;
  double disc_kg = 0.0;
  double moment_kg_mm = 0.0;
  for (const SketchDisc& disc : sketch.discs) {
    RefuseBeyond(sketch, disc.z_mm, "--disc");
    disc_kg += disc.mass_kg;
    moment_kg_mm += disc.mass_kg * disc.z_mm;
  }
  n.shaft_mass_kg = sketch.mass_kg - disc_kg;
  if (!(n.shaft_mass_kg > 0.0)) {
    throw BadInput(
        fmt::format("--disc: the discs have {:g} kg, the whole rotor {:g} kg; --mass-kg "
                    "is of all that turns",
                    disc_kg, sketch.mass_kg));
  }
  const double length_m = 1e-3 * sketch.length_mm;
  n.diameter_mm =
      1e3 * std::sqrt(4.0 * n.shaft_mass_kg / (std::numbers::pi * kSteelKgPerM3 * length_m));
  n.centre_mm = (moment_kg_mm + n.shaft_mass_kg * 0.5 * sketch.length_mm) / sketch.mass_kg;
  n.bearings_mm = sketch.bearings_mm;
  if (n.bearings_mm.empty()) n.bearings_mm = {0.15 * sketch.length_mm, 0.85 * sketch.length_mm};
  for (const double z_mm : n.bearings_mm) RefuseBeyond(sketch, z_mm, "--bearings-mm");
  const double span_mm = n.bearings_mm[1] - n.bearings_mm[0];
  if (!(span_mm > 0.0)) {
    throw BadInput(
        fmt::format("--bearings-mm: found {:g} and {:g}; the second must lie behind the "
                    "first",
                    n.bearings_mm[0], n.bearings_mm[1]));
  }
  const double rear_kg = sketch.mass_kg * (n.centre_mm - n.bearings_mm[0]) / span_mm;
  n.carried_kg = {sketch.mass_kg - rear_kg, rear_kg};
  // Along the axis of a horseshoe the gap is longer than at its poles (docs/derivations.md (16a)).
  const double along = sketch.turns > 0.0 ? std::cos(kHalfPoleAngleDeg * kDegree) : 1.0;
  n.ks_n_per_m = sketch.ki_n_per_a * sketch.bias_a * along / (1e-3 * sketch.gap_mm);
  n.clearance_um = 500.0 * sketch.gap_mm;
  return n;
}

std::string SketchRig(const RigSketch& sketch, const std::string& controller_file,
                      const std::string& scenario_file) {
  const SketchNumbers n = NumbersOf(sketch);
  std::string text = fmt::format(
      "kind: rig\n"
      "name: {}\n\n"
      "# Made by amb new rig from a few numbers; what says (assumed) is a guess. Replace it as you "
      "learn more:\n"
      "# amb modes shows what the rotor is, amb identify modal measures it, docs/configuration.md "
      "has every key.\n"
      "# z runs along the shaft from the front end; x and y are the control axes.\n\n"
      "sampling:\n"
      "  period_us: {:.9g}\n"
      "  delay_samples: {:.6g}         # from a reading to the current it commands\n\n"
      "coils:\n"
      "  bias_current_a: {:.6g}\n"
      "  max_current_a: {:.6g}         # twice the bias: the control current may use all of it\n\n",
      sketch.name, 1e-3 * std::round(1e9 / sketch.rate_hz), sketch.delay_samples, sketch.bias_a,
      2.0 * sketch.bias_a);
  text += RotorText(sketch, n) + "bearings:\n";
  for (std::size_t b = 0; b < 2; ++b) text += BearingText(sketch, n, b);
  text += GravityText(sketch) +
          fmt::format(
              "drive:\n"
              "  max_speed_rpm: {:.6g}\n"
              "  max_acceleration_rpm_per_s: {:.6g}  # top speed in {:g} s (assumed)\n"
              "  coast_down_1_per_s: 0.02   # windage: a time constant of 50 s (assumed)\n"
              "  friction_rpm_per_s: 20     # of the motor (assumed)\n\n",
              sketch.max_speed_rpm, SketchAcceleration(sketch), kSecondsToTop);
  return text +
         fmt::format(
             "objectives:                  # radius; ISO 14839-2 has zone A up to 0.3 of the "
             "clearance\n"
             "  standing_orbit_um: {:.4g}\n"
             "  spinning_orbit_um: {:.4g}\n\n"
             "run:                         # what every command uses with this rig\n"
             "  controller: ./{}\n"
             "  scenario: ./{}\n",
             kStandingShare * n.clearance_um, kSpinningShare * n.clearance_um, controller_file,
             scenario_file);
}

std::string SketchController(const RigSketch& sketch, const StartLaw& law) {
  const SketchNumbers n = NumbersOf(sketch);
  std::string text = fmt::format(
      "kind: controller\n"
      "name: {}\n\n"
      "# A start, made by amb new rig: a mass on a spring in each bearing; of a few stable forms "
      "the one with the\n"
      "# smallest peak of |S|. amb margins shows how good it is; amb design makes laws that know "
      "noise, "
      "orbit and uncertainty.\n\n"
      "laws:\n",
      sketch.name);
  for (std::size_t b = 0; b < 2; ++b) text += LawText(sketch, n, law, b);
  return text + fmt::format(
                    "\nsequence:                    # keys left out have their defaults\n"
                    "  settle_radius_um: {:.4g}      # \"near the centre\": 0.15 of the clearance\n"
                    "  trip_deceleration_rpm_per_s: {:.6g}\n\n"
                    "protection:\n"
                    "  orbit_fraction: 0.5        # trips at half the clearance\n",
                    0.15 * n.clearance_um, SketchAcceleration(sketch));
}

std::string SketchScenario(const RigSketch& sketch) {
  const double acceleration = SketchAcceleration(sketch);
  const double patience_s = SketchPatience(sketch);
  const auto spin = [&](double rpm, const char* until, double hold_s) {
    return fmt::format(
        "  - {{do: spin, speed_rpm: {:.6g}, acceleration_rpm_per_s: {:.6g}, until: {}, timeout_s: "
        "{:.4g}, hold_s: {:g}}}\n",
        rpm, acceleration, until, patience_s, hold_s);
  };
  return fmt::format(
             "kind: scenario\n"
             "name: {}\n\n"
             "# Lift, top speed, stop, land. A step gives its command, waits for what `until` "
             "names "
             "and stays for hold_s.\n"
             "steps:\n"
             "  - {{do: lift, until: levitating, timeout_s: 5, hold_s: 1}}\n",
             sketch.name) +
         spin(sketch.max_speed_rpm, "speed_reached", 1.0) + spin(0.0, "standstill", 0.5) +
         "  - {do: land, until: off, timeout_s: 5, hold_s: 0.2}\n";
}

}  // namespace levitas::cli
