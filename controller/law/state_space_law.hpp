#pragma once
// A law of any order between all axes, as blocks of one or two states that stand alone.
//
// Equation   w[n+1] = A w[n] + B v[n],  i = go (C w[n] + D v[n]) + excitation,  ic = i limited to
//            +-limit, v = gi (y - reference) the sensors' signal; A is made of blocks
//            [re im; -im re] (im = 0: one state). docs/derivations.md eq. (L13)-(L16).
// Sign       none is added: a law that holds the rotor has its minus inside C, B or D.
// Sources    modal form and zero-order hold of analogue controllers: H.-L. Chiu (2022), Appl. Sci.
//            12, 8556, controllers of a turbomolecular pump.
// Anti-windup  a block whose poles lie on or outside the unit circle, or within period/kMemoryS of
//            z = 1 (it remembers for longer than kMemoryS: nearly integrating states of a robust
//            law), keeps its state in a period in which an axis it feeds is at its limit and the
//            block's change would push that axis further beyond. Any other forgets by itself and is
//            never touched.
// Units      SI; v in the unit of the input gain. Thread: loop thread; Step allocates nothing,
//            throws nothing, takes bounded time.
// Failure    the constructor throws std::invalid_argument naming what is impossible.
// Not done   poles that repeat without being separable (Jordan blocks): split them by a little.

#include <array>
#include <cstdint>
#include <vector>

#include "common/axes.hpp"
#include "controller/law/law_config.hpp"

namespace levitas::law {

/// The blocks as the loop runs them: poles in z.
[[nodiscard]] StateSpaceConfig DiscretiseBlocks(const StateSpaceConfig& config, double period_s);

/// A state that forgets more slowly winds up while a current is at its limit [s].
inline constexpr double kMemoryS = 0.1;

/// One number per axis and state, states side by side so that loops over them become vector code.
class StateSpaceCoefficients {
 public:
  StateSpaceCoefficients(const StateSpaceConfig& config, double period_s);

  [[nodiscard]] std::size_t axes() const noexcept { return axes_; }
  [[nodiscard]] std::size_t blocks() const noexcept { return real_.size(); }
  [[nodiscard]] double input_gain(std::size_t axis) const noexcept { return input_gain_[axis]; }
  [[nodiscard]] bool any_keeps() const noexcept { return any_keeps_; }

 private:
  friend struct StateSpaceStep;
  std::size_t axes_{};
  std::vector<double> real_, imaginary_;              // per block
  std::vector<double> first_input_, second_input_;    // axis by axis, blocks within
  std::size_t lanes_{};                               // axes of a block's outputs, the rest is 0
  std::vector<double> first_output_, second_output_;  // block by block, lanes within
  std::array<AxisArray, kMaxAxes> direct_{};          // [output][input]
  AxisArray input_gain_{}, output_gain_{};
  std::vector<std::uint8_t> keeps_;  // per block
  bool any_keeps_{};
};

struct StateSpaceState {
  StateSpaceState() = default;
  explicit StateSpaceState(std::size_t blocks)
      : first(blocks), second(blocks), next_first(blocks), next_second(blocks) {}
  void Reset() noexcept;
  std::vector<double> first, second;            ///< the states of each block
  std::vector<double> next_first, next_second;  ///< room for the step
};

struct LawOutput;

/// Advances one period; see axis_law.hpp for the arguments.
[[nodiscard]] LawOutput Step(const StateSpaceCoefficients& coefficients, StateSpaceState& state,
                             const AxisArray& error_m, const AxisArray& excitation_a,
                             double limit_a) noexcept;

}  // namespace levitas::law
