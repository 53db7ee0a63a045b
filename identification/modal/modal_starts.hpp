#pragma once
// Does a fit end at the same optimum wherever it begins?
//
// Start     every fitted unknown of the rig file times a factor drawn uniformly from
//           1 +- `everything`; ki, ks and sensor gains from 1 +- `gains`. What is known and the
//           prior stay where they are: one problem, many beginnings.
// Same      the costs differ by less than 0.1 %, and the plants of two fits differ by less than a
//           tenth of what the data allow: mean of |P_1 - P_2|^2 / (var + (floor |P_data|)^2) < 0.01
//           over all fitted responses. Directions that no response identifies do not count.
// Thread    any.

#include "common/random.hpp"
#include "identification/modal/identify_modal.hpp"

namespace levitas::identification {

struct StartSpread {
  double everything{0.3};
  double gains{0.3};
};

[[nodiscard]] Eigen::VectorXd RandomStart(const ModalStart& start, const std::vector<bool>& fitted,
                                          const StartSpread& spread, Random& random);

/// Mean square difference of the two fits' plants in units of the allowed variance.
[[nodiscard]] double Apart(const ModalResult& one, const ModalResult& other,
                           const std::vector<FrequencyResponse>& responses);

struct StartsOutcome {
  int starts{};
  int same{};                 ///< reached the optimum of `reference`
  std::vector<double> apart;  ///< per start
  double median_time_s{};     ///< of one fit
};

inline constexpr double kSameOptimum = 0.01;
inline constexpr double kSameCost = 1e-3;

[[nodiscard]] StartsOutcome TryStarts(const ModalResult& reference,
                                      const std::vector<FrequencyResponse>& responses, int starts,
                                      const StartSpread& spread, std::uint64_t seed);

}  // namespace levitas::identification
