#pragma once
// Correction of T while a block runs: how the error really answers to the block, learned from the
// block's own steps.
//
// Equation   E = -M (D + c), M the answer that T inverts if the model is right. Over two windows
//              w = -T (E_1 - E_0) = A (c_1 - c_0),   A = T M,
//            A <- A + (w - A dc) dc^H / (dc^H dc + r^2),    (Broyden's update, damped)
//            r = |w| least_change/|E_1 - E_0|: what noise and other causes may have moved,
//            and the block adapts with A^-1 T instead of T: (N5) of docs/derivations.md. A = I
//            where the model is right; it changes little over speed, since T follows the model.
// Window     kTurns whole turns at least, and kLeastS: amplitudes are means over it, so that the
//            static error and other orders than the block's leave nothing in them.
// Excited    a pair of windows counts where the error changed by `least_change_m` at least, and the
//            speed by less than kSteady: over speed the disturbance changes, too.
// Beginning  until the first pair that counts, and for kFirstWindows windows at most: the block is
//            to be cautious then, since T may be wrong.
// Bounded    a correction that takes an element of A further than kMost from the identity, or one
//            of its inverse beyond kFastest (the block would be so many times faster), is refused;
//            the last one stays.
// Units      E [m], c [m] or [A]; A has no unit.
// Thread     loop thread only; no allocation, nothing thrown. A step that ends a window costs the
//            inverse of one complex matrix of the axes.
// Not done   learning in a run-up.

#include <array>
#include <complex>
#include <cstdint>

#include "common/axes.hpp"
#include "common/unit_phasor.hpp"
#include "controller/synchronous/generalised_notch.hpp"
#include "controller/synchronous/inverse_ladder.hpp"

namespace levitas::synchronous {

class InfluenceEstimate {
 public:
  static constexpr double kTurns = 4.0;
  static constexpr double kLeastS = 0.1;
  static constexpr double kMost = 6.0;
  static constexpr double kFastest = 5.0;
  static constexpr double kSteady = 0.003;
  static constexpr std::uint32_t kFirstWindows = 4;

  InfluenceEstimate(std::size_t axes, double period_s, double least_change_m) noexcept;

  /// Forgets windows, keeps nothing learned.
  void Reset() noexcept;
  /// A block that was off begins again: what was learned stays, the windows begin anew.
  void Restart() noexcept;
  /// One period of a block that adapts; `turns` of the shaft in this period.
  void Observe(const InverseLanes& inverse, const UnitPhasor& phasor, double turns,
               const AxisArray& error, const NotchState& state) noexcept;
  /// A^-1 T; T itself until something was learned.
  [[nodiscard]] const InverseLanes& Corrected(const InverseLanes& inverse) noexcept;

  [[nodiscard]] bool beginning() const noexcept {
    return learned_ == 0 && windows_ < kFirstWindows;
  }
  [[nodiscard]] std::uint32_t learned() const noexcept { return learned_; }
  [[nodiscard]] std::uint32_t refused() const noexcept { return refused_; }
  /// A[to][from].
  [[nodiscard]] std::complex<double> element(std::size_t to, std::size_t from) const noexcept {
    return {answer_.real[to][from], answer_.imaginary[to][from]};
  }

 private:
  struct Means {
    AxisArray error_real{}, error_imaginary{};
    AxisArray given_real{}, given_imaginary{};
  };

  void EndWindow(const InverseLanes& inverse) noexcept;
  void Take(const std::array<std::complex<double>, kMaxAxes>& answer,
            const std::array<std::complex<double>, kMaxAxes>& step, double damped2) noexcept;
  [[nodiscard]] bool Invert(const ComplexMatrix& answer, ComplexMatrix& inverse) const noexcept;

  std::size_t axes_;
  double period_s_;
  double least_change_m_;
  Means sum_, before_;
  bool has_before_{};
  double turned_{};
  double samples_{};
  double turns_per_sample_{};  ///< of the window before
  ComplexMatrix answer_;       // A
  ComplexMatrix correct_;      // A^-1
  const InverseLanes* of_{};
  bool fresh_{};
  InverseLanes corrected_;
  std::uint32_t learned_{}, refused_{};
  std::uint32_t windows_{};  ///< since the block began
};

}  // namespace levitas::synchronous
