#pragma once
// Power amplifiers of one axis: what is commanded, and how the coil currents follow.
//
// Command    DAC quantisation of ic, then each coil's command limited to 0 .. maximum.
// Dynamics   i' = (command - i)/tau, |i'| <= slew; solved in closed form over a step in which the
//            command is constant. docs/derivations.md (17)-(19).
// States     control current ic = (i+ - i-)/2 and bias i0 = (i+ + i-)/2 of each axis.
// Thread     any; pure functions. Not done: supply voltage, back-EMF of the moving rotor.

namespace levitas::amplifier {

/// Coil currents of one axis, as mean and half difference.
struct CoilPair {
  double control_a{};
  double bias_a{};
};

struct Limits {
  double max_coil_current_a{};
  double dac_step_a{};  ///< 0 = not quantised
};

/// Step of a converter of `bits` over +- `range`; 0 for no converter.
[[nodiscard]] double ConverterStep(double range, int bits);

/// What the two coils are asked for; switched off means both to zero.
[[nodiscard]] CoilPair LimitedCommand(const Limits& limits, bool enabled, double control_a,
                                      double bias_a) noexcept;

/// The same amplifier over one step length.
struct Step {
  double decay{};  ///< exp(-h/tau)
  double duration_s{};
  double tau_s{};
  double slew_a_per_s{};  ///< of each coil current; 0 = none
};

[[nodiscard]] Step MakeStep(double bandwidth_hz, double slew_a_per_s, double duration_s);

/// One coil current after the step, closed form.
[[nodiscard]] double FollowSlewing(const Step& step, double now_a, double command_a) noexcept;

inline void Follow(const Step& step, const CoilPair& command, double& control_a,
                   double& bias_a) noexcept {
  if (step.slew_a_per_s == 0.0) {
    control_a = command.control_a + (control_a - command.control_a) * step.decay;
    bias_a = command.bias_a + (bias_a - command.bias_a) * step.decay;
    return;
  }
  // The slew limit is the amplifier's, so it acts on each coil and couples bias with control.
  const double towards =
      FollowSlewing(step, bias_a + control_a, command.bias_a + command.control_a);
  const double away = FollowSlewing(step, bias_a - control_a, command.bias_a - command.control_a);
  control_a = 0.5 * (towards - away);
  bias_a = 0.5 * (towards + away);
}

}  // namespace levitas::amplifier
