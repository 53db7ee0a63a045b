#pragma once
// The cost of the flexible rotor's published identification beside that of the modal fit, on the
// same data: what a user's marks do where this project takes the data's own scatter.
//
// Equation  C = sum_k (w_k (20 lg|P_k| - 20 lg|P_k,data|))^2 over the entries within a plane: no
//           phase, no noise.
// Weights   w = 30 on lines within 5 Hz of a peak or valley of an entry, 0.1 where noise rules, 1
//           elsewhere (Sahinkaya, Sawicki: identification of a two-bearing rotor, II.C and IV.A).
//           There the user marks them by eye; here peaks and valleys are those of the fitted model,
//           and noise rules where its deviation exceeds a third of the reading, marks or not.
// Order     standing first; then the gyroscopic matrix alone from the fastest response, without
//           lines below one per turn, as there. From the optimum of the modal fit on; other starts
//           are not tried.
// Prior     that of the modal fit, a few out of some ten thousand squares: without it bearing
//           constants have no value.
// Judged    each by the model that it was fitted with: the modal fit with the magnets' working
//           gains (working_gains.hpp), the other without.
// Thread    any; uses `threads` of the options. Needs the responses of the modal fit in their
//           order: standing first, the fastest last.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "identification/modal/identify_modal.hpp"

namespace levitas::identification {

enum class DecibelRegion { kMarked, kNoisy, kOther };
inline constexpr std::size_t kDecibelRegions = 3;
inline constexpr std::array<double, kDecibelRegions> kDecibelWeights{30.0, 0.1, 1.0};

/// Per line of the response and entry; what is not in the cost has weight 0 (DecibelWeights).
[[nodiscard]] std::vector<Eigen::MatrixXd> DecibelWeights(const ModalFrame& frame,
                                                          const Physical& rig,
                                                          const FrequencyResponse& response,
                                                          const ModalFitOptions& options);

/// Root of the mean square of what is left of a response, in decibels.
struct DecibelLeft {
  std::array<double, kDecibelRegions> rms_db{};
  double weighted_rms_db{};  ///< sqrt(C / sum of w^2)
};

struct DecibelSpeed {
  double speed_rad_per_s{};
  std::array<double, kDecibelRegions> share{};  ///< of the entries in the cost
  DecibelLeft modal, decibel;                   ///< of the modal fit, of the one of this cost
  double modal_misfit{}, decibel_misfit{};      ///< modal_quality.hpp
};

/// Noisy lines pull on what the marked ones say little of, and magnitudes within a plane are even
/// in the gyroscopic matrix: either search may still creep where it is ended.
struct DecibelStage {
  std::size_t unknowns{};
  bool converged{};
};

struct DecibelFit {
  Physical rig;
  std::vector<DecibelSpeed> speeds;  ///< those fitted: standing, and the fastest where there is one
  DecibelStage standing, gyroscopic;
};

[[nodiscard]] DecibelFit FitDecibels(const ModalResult& modal,
                                     const std::vector<FrequencyResponse>& responses);

}  // namespace levitas::identification
