// Table of a bearing's magnet and of what drives its coils.
#include <fmt/format.h>

#include <array>
#include <limits>

#include "configuration/schema/schema.hpp"
#include "plant_sim/magnet/magnet.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

struct HorseshoeConfig {
  double turns{};
  double pole_area_m2{};
  double half_angle_rad{};
};

void DescribeHorseshoe(Visitor& v, HorseshoeConfig& shoe) {
  v.Number({"turns", kOne, 1, 10000, kRequired,
            "turns of one coil (both poles of the horseshoe together)"},
           shoe.turns);
  v.Number({"pole_area", kSquareMillimetre, 0.1, 1e6, kRequired, "face of one pole"},
           shoe.pole_area_m2);
  v.Number({"half_pole_angle", kDegree, 0, 80, kRequired,
            "between a pole and the axis of its magnet; the gap is then that at the pole"},
           shoe.half_angle_rad);
}

// The force constant k of F = k [((i0+ic)/(s0-x))^2 - ((i0-ic)/(s0+x))^2] is given in one of three
// ways: directly; by ki = 4 k i0 / s0^2; or by the coil and its poles (docs/derivations.md (16a)),
// whose gap is that at the pole: along the axis it is longer. Written directly, hence exactly.
void DescribeStrength(Visitor& v, plant::MagnetConfig& magnet) {
  double constant = magnet.force_constant_n_m2_per_a2;
  double ki_n_per_a{};
  HorseshoeConfig shoe;
  const std::array<Form, 3> forms{
      Form{"force_constant_n_m2_per_a2",
           [&] {
             v.Number({"force_constant", kForceConstant, 1e-9, 1e-2, kRequired,
                       "k of F = k [((i0+ic)/(s0-x))^2 - ((i0-ic)/(s0+x))^2]"},
                      constant);
           }},
      Form{"ki_n_per_a",
           [&] {
             v.Number({"ki", kForcePerAmpere, 0.01, 1e5, kRequired,
                       "force per control current with the rotor centred, at the bias current"},
                      ki_n_per_a);
           }},
      Form{"turns, pole_area_mm2 and half_pole_angle_deg", [&] { DescribeHorseshoe(v, shoe); }}};
  std::size_t chosen = 0;
  v.OneOf("the strength of the magnet", forms, chosen);
  if (chosen == 1) {
    constant = ki_n_per_a * magnet.gap_m * magnet.gap_m / (4.0 * magnet.bias_current_a);
  } else if (chosen == 2) {
    const magnet::AxisLaw law =
        magnet::LawOfPoles(shoe.turns, shoe.pole_area_m2, shoe.half_angle_rad, magnet.gap_m);
    constant = law.force_constant_n_m2_per_a2;
    magnet.gap_m = law.gap_m;
  } else if (chosen >= forms.size()) {
    constant = std::numeric_limits<double>::quiet_NaN();  // none or several: said by the reader
  }
  v.RefuseIf(
      constant < 1e-9 || constant > 1e-2, "",
      fmt::format("gives a force constant of {:.4g} N m^2/A^2, allowed 1e-09 to 0.01", constant));
  magnet.force_constant_n_m2_per_a2 = constant;
}

void DescribeExponential(Visitor& v, plant::ExponentialForce& law) {
  v.Number({"force", kForcePerSquareAmpere, 1e-9, 1e6, kRequired,
            "f0 of F = f0 i^2 e^(-gap/decay): what a gap of 0 would have"},
           law.force_n_per_a2);
  v.Number({"decay", kMillimetre, 0.01, 1000, kRequired, "gap over which the force falls to 1/e"},
           law.decay_m);
  v.Number({"far_gap", kMillimetre, 0.02, 1000, kRequired,
            "of the coil away from +x, the rotor centred; gap is that of the coil towards it"},
           law.far_gap_m);
}

void DescribeVoltage(Visitor& v, plant::VoltageDrive& coil) {
  v.Number({"steady", kOne, 0.01, 100, 1, "current at last per current commanded"}, coil.steady);
  v.Number({"offset", kMilliampere, -1000, 1000, 0, "current at last without any command"},
           coil.offset_a);
  v.Number({"time_constant", kMillisecond, 1e-3, 1e4, kRequired,
            "inductance over resistance, extrapolated to a gap of 0"},
           coil.time_constant_s);
  v.Number({"decay", kMillimetre, 0.01, 1e6, kRequired, "gap over which it falls to 1/e"},
           coil.decay_m);
  v.Number(
      {"motion_emf", kOne, -1e6, 1e6, 0,
       "share of the voltage that a moving rotor induces by d(L i)/dt; 0: left out, 1: in full; "
       "of a decay that is long it is a small voltage"},
      coil.motion_emf);
  v.Number({"dead_band", kMilliampere, 0, 1e5, 0,
            "what the bridge takes from all that is commanded, down to nothing"},
           coil.dead_band_a);
  v.Number({"curvature", kOne, -1, 1, 0,
            "q of the drive, u + q u (1 - command/max_current); u is what the dead band leaves"},
           coil.curvature);
  v.Number({"iron", kPerSquareAmpere, 0, 1000, 0,
            "inductance lost as the iron fills, time_constant/(1 + iron i^2)"},
           coil.iron_1_per_a2);
  v.Number({"warming", kPerSecond, -1, 1, 0,
            "resistance gained per second, from the start of a run and over the nominal one"},
           coil.warming_1_per_s);
  v.Number({"away_steady_ratio", kOne, 0.01, 100, 1,
            "steady of the coil away from +x over that of the other"},
           coil.away_steady_ratio);
  v.Number({"away_time_constant_ratio", kOne, 0.01, 100, 1,
            "time_constant of the coil away from +x over that of the other"},
           coil.away_time_constant_ratio);
}

/// A part that is there or not.
template <class Part, class Body>
void DescribeOptional(Visitor& v, std::string_view key, std::string_view meaning,
                      std::optional<Part>& part, Body body) {
  bool present = part.has_value();
  Part value = part.value_or(Part{});
  v.OptionalGroup(key, meaning, present, [&] { body(value); });
  part = present ? std::optional<Part>(value) : std::nullopt;
}

}  // namespace

void Describe(Visitor& v, plant::MagnetConfig& magnet) {
  v.Number({"gap", kMillimetre, 0.02, 10, kRequired, "radial air gap s0 with the rotor centred"},
           magnet.gap_m);
  DescribeOptional(v, "exponential", "force law of a long stroke, instead of the gap squared",
                   magnet.exponential,
                   [&](plant::ExponentialForce& law) { DescribeExponential(v, law); });
  v.When(!magnet.exponential, "without exponential", [&] { DescribeStrength(v, magnet); });
}

void Describe(Visitor& v, plant::AmplifierConfig& amplifier) {
  DescribeOptional(v, "voltage",
                   "coils on a voltage instead of a current loop: max_current is that of full duty",
                   amplifier.voltage, [&](plant::VoltageDrive& coil) { DescribeVoltage(v, coil); });
  v.When(!amplifier.voltage, "without voltage", [&] {
    v.Number({"bandwidth", kHertz, 10, 100000, kRequired, "-3 dB of the first-order current loop"},
             amplifier.bandwidth_hz);
    v.Number({"slew", kAmperePerSecond, 0, 1e8, 0, "limit of d ic/dt by the supply, 0 for none"},
             amplifier.slew_a_per_s);
  });
  v.Integer({"dac_bits", 0, 24, 0,
             "steps of the control current over plus or minus the coil limit; 0 for none"},
            amplifier.dac_bits);
}

}  // namespace levitas::configuration
