#pragma once
// Test signals of an excitation, one value per control cycle, between -1 and +1.
//
// Kinds      prbs          pseudo-random binary sequence, `divisor` cycles a bit
//            paprbs        the same, each bit multiplied by an amplitude of its own between
//                          low_share and 1 (H.-L. Chiu 2022, Appl. Sci. 12, 8556)
//            stepped_sine  `frequencies` sines from from_hz to to_hz, dwell_s each, phase unbroken,
//                          then again
//            chirp         sine whose frequency goes from from_hz to to_hz within repeat_s,
//                          exponentially (or linearly), then again
//            multisine     every multiple of 1/repeat_s from from_hz to to_hz with equal amplitude
//                          and Schroeder's phases (1970, IEEE Trans. Inf. Theory 16(1) 85), scaled
//                          to a peak of 1
//            impulse       1 for width_s, 0 for the rest of repeat_s
// Thread     one; Next allocates nothing, throws nothing. Construction allocates and costs time.
// Failure    impossible numbers are taken as the nearest possible ones; files are checked before.
// Not done   no amplitude, no limit of the orbit: that is the player's.

#include <cstdint>
#include <vector>

#include "common/random.hpp"
#include "controller/scenario/prbs.hpp"
#include "controller/scenario/scenario_config.hpp"

namespace levitas::scenario {

class Signal {
 public:
  Signal(const Excitation& config, double period_s);

  [[nodiscard]] double Next() noexcept;

 private:
  void FillMultisine(const Excitation& config, double period_s);
  [[nodiscard]] double NextBit() noexcept;
  [[nodiscard]] double NextSine() noexcept;
  [[nodiscard]] double StepHz() const noexcept;
  [[nodiscard]] double SweepHz() const noexcept;

  SignalKind kind_;
  Prbs sequence_;
  Random random_;
  std::uint32_t divisor_;
  double low_share_;
  double from_hz_, to_hz_;
  bool linear_;
  std::uint64_t steps_;          ///< of a stepped sine
  std::uint64_t dwell_cycles_;   ///< of each
  std::uint64_t repeat_cycles_;  ///< 0: never again
  std::uint64_t width_cycles_;
  double period_s_;
  std::vector<double> table_;  ///< one period of a multisine
  std::uint64_t cycle_{0};     ///< within the repetition
  double present_{0.0};        ///< of the bit
  double phase_turns_{0.0};
};

}  // namespace levitas::scenario
