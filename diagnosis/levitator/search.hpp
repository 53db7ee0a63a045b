#pragma once
// Model selection for a levitator: which causes explain its residual.
//
// Method     calibrate; screen every cause; refit the best few on the nonlinear model; accept the
//            best; drop earlier ones that the others explain (backward check); again until none
//            gains kDecisive and a share of what is explained already (form_share). Where all
//            further causes are small beside the first one, the search is made from other first
//            causes, too: such a chain is the mark of a wrong first one.
// Score      nat that a cause adds to all others; of one that was not named, what it would add in
//            place of the named one it does most for.
// Validation the same gain in likelihood on records that were not fitted, where there are any. The
//            weakest cause is dropped as long as it loses there: what a wrong first cause leaves is
//            taken up by a chain of such.
// Thread     blocks the caller, two threads inside.

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/inference/fit_gain.hpp"
#include "diagnosis/levitator/fit.hpp"

namespace levitas::levitator {

inline constexpr double kForm = 0.001;  ///< share of the evidence that a law's form may leave

/// Causes within this share of a cause's evidence are a tie: force laws are not known better.
inline constexpr double kFormOfTie = 0.005;

struct Score {
  std::size_t cause{};  ///< index into Causes()
  double nat{};
  double validation_nat{};  ///< NaN where there is no validation data
  double behind_nat{};      ///< of one not named: behind the cause in whose place it stands
  bool named{};
  bool refitted{};
  std::size_t instead_of{};  ///< of one not named: the named one; Causes().size() if none
};

struct Found {
  CauseSet causes;  ///< the weightiest first
  Fitted calibrated;
  Fitted extended;
  Filters filters;                ///< of the extended model
  std::vector<Score> scores;      ///< best variant of every effect, named ones first
  double evidence{};              ///< [nat] of all causes together
  bool judged{};                  ///< there were such records
  diagnosis::FitGain validation;  ///< of all causes together on them
};

struct SearchSettings {
  std::size_t most_causes{10};
  double form_share{kForm};  ///< of what is explained, to be gained by a further cause
  /// Validation data are a part of the records themselves: what loses there is no cause at all.
  bool own_validation{false};
  std::function<void(double, const std::string&)> progress;
};

[[nodiscard]] Found Search(const Misfit& data, const Misfit* validation,
                           const SearchSettings& settings);

/// What `with` explains beyond `without` of records that neither was fitted to.
[[nodiscard]] diagnosis::FitGain GainOn(const Misfit& validation, const Filters& filters,
                                        const Theta& with, const Theta& without);

/// Parameters of a fit for validation records: of the per-record parameters, the mean.
[[nodiscard]] Theta SharedPart(const Theta& theta, std::size_t records);

}  // namespace levitas::levitator
