#pragma once
// Parameters of bias saving: how far the bias current falls while the rotor asks for little force.
//
// Units   SI.
// Not here  what the magnets are: bias and gaps come with the rig's numbers.

namespace levitas::bias {

struct BiasConfig {
  double lowest_current_a{};  ///< the bias falls no further; 0: it stays at the rig's
  /// Of the bias that a control current may take: what is left is for a shock, until the bias has
  /// been raised.
  double largest_share{0.5};
  double largest_orbit_fraction{0.2};  ///< of the clearance; beyond it the whole bias
  double lowering_time_s{2.0};         ///< from the rig's bias to nothing; how long peaks count
  double raising_time_s{0.005};        ///< from nothing to the rig's bias

  [[nodiscard]] bool empty() const noexcept { return !(lowest_current_a > 0.0); }
};

}  // namespace levitas::bias
