#pragma once
// The law of all axes, one period at a time: the decentralised one below, or the state-space law of
// state_space_law.hpp when the configuration holds one.
//
// Equation   u = C(z) e + excitation, e = reference - y;  ic = u limited to +-limit
//            (docs/derivations.md eq. (L1)-(L10)). Order: lead-lags, notches, PID. For a linear
//            law the order is free; with the PID last its integrator is counted in amperes of
//            output, so that the limit and the integrator speak of the same quantity.
// Anti-windup  conditional integration: the integrator of an axis stands still while the axis is
//            at its limit AND integrating would push it further beyond. Unlimited, it is the plain
//            law, bit for bit.
// Layout     structure of arrays over the axes, so that the compiler works on them in vectors.
// Units      SI, named in identifiers. Frame: bearing frame, positive current pulls towards +x.
// Thread     loop thread only; Step allocates nothing, throws nothing, takes bounded time.
// Failure    Step expects finite errors (the cycle checks); the constructor of LawCoefficients
//            throws std::invalid_argument for impossible parameters, and for a schedule, whose laws
//            are made one by one (law_schedule.hpp).
// Not done   no polarity, no bias, no supervision: see controller/cycle and controller/supervisor.

#include <cstdint>
#include <vector>

#include "common/axes.hpp"
#include "controller/law/discrete_law.hpp"
#include "controller/law/law_config.hpp"
#include "controller/law/state_space_law.hpp"

namespace levitas::law {

/// One number per axis, on a cache line of its own.
struct alignas(64) Lanes {
  AxisArray at{};
};

struct FirstOrderLanes {
  Lanes b0, b1, a1;
};
struct SecondOrderLanes {
  Lanes b0, b1, b2, a1, a2;
};
struct PidLanes {
  Lanes direct;      ///< Kp + g + b: what the newest error contributes at once
  Lanes integral;    ///< 2 g
  Lanes derivative;  ///< -b (1 + a): what an error leaves in the derivative's memory
  Lanes pole;        ///< -a
};

/// Read-only after construction; may be shared.
class LawCoefficients {
 public:
  explicit LawCoefficients(const LawConfig& config);

  [[nodiscard]] std::size_t axes() const noexcept { return axes_; }
  [[nodiscard]] const PidLanes& pid() const noexcept { return pid_; }
  [[nodiscard]] const std::vector<FirstOrderLanes>& lead_lags() const noexcept {
    return lead_lags_;
  }
  [[nodiscard]] const std::vector<SecondOrderLanes>& notches() const noexcept { return notches_; }
  [[nodiscard]] const std::optional<StateSpaceCoefficients>& state_space() const noexcept {
    return state_space_;
  }

 private:
  void BuildAxes(const LawConfig& config);

  std::optional<StateSpaceCoefficients> state_space_;
  std::size_t axes_{};
  PidLanes pid_;
  std::vector<FirstOrderLanes> lead_lags_;
  std::vector<SecondOrderLanes> notches_;
};

/// Memory of the filters (transposed direct form II) and of the PID. All zero at rest.
class LawState {
 public:
  explicit LawState(const LawCoefficients& coefficients);
  void Reset() noexcept;

  struct TwoDelays {
    Lanes first, second;
  };
  std::vector<Lanes> lead_lags;
  std::vector<TwoDelays> notches;
  Lanes integral_a;    ///< [A] what the integrator contributes, before the newest error
  Lanes derivative_a;  ///< [A] memory of the derivative filter
  StateSpaceState state_space;
};

struct LawOutput {
  AxisArray control_current_a{};   ///< ic, within +-limit; zero beyond the axes in use
  std::uint16_t saturated_axes{};  ///< bit i: axis i wanted more than the limit
};

/// The law changes from one to another of the same filters: what the derivative remembers is the
/// error before, counted in amperes by the gain of then, and is counted anew by the gain of now.
void ChangeLaw(const LawCoefficients& from, const LawCoefficients& to, LawState& state) noexcept;

/// Advances one period. Pure: same arguments, same bits.
[[nodiscard]] LawOutput Step(const LawCoefficients& coefficients, LawState& state,
                             const AxisArray& error_m, const AxisArray& excitation_a,
                             double limit_a) noexcept;

}  // namespace levitas::law
