#pragma once
// Model selection: the effects that explain the difference between a rig and its model.
//
// Method     1 calibrate: the nuisances within their tolerances, with a fast observer first
//              (smooth, coarse) and a slow one after it (sees slow effects), Gauss-Newton on
//              innovations;
//            2 screen: one pass with the sensitivities of every term gives the evidence of every
//              hypothesis (evidence.hpp) on top of the causes found so far;
//            3 refit: the best few by Gauss-Newton together with the nuisances on the nonlinear
//              model (refine.hpp); the best of them is a cause, and each earlier one is dropped
//              again when the others explain its share (backward check); shape parameters of a
//              family are refined (refine_shape.hpp); again from 2 until none gains enough; each of
//              several causes is exchanged for its nearest alternatives (exchange.hpp);
//            4 rank: every effect in place of the first cause, the nearest refitted;
//            5 no cause stays unless all together fit better than chance would (fit_gain.hpp);
//              what calibration had to move too far is tried as one (moved_calibration.hpp);
//            6 judge causes by the user's validation data (validation.hpp); doubt a chain that had
//              to be cut off (selection_steps.hpp); without a cause, look for one that is likely
//              all the same (suspicion.hpp);
//            7 analyse the residual (residual.hpp).
// Divergence a model that diverges is held by a faster observer until the causes found make that
//            unnecessary (divergence.hpp).
// Quick      kQuickRows of the records, one cause, ranked by the refits of the screen's best; no 4.
// Enough     Judging::decisive_nat, and a further cause more than form_share of what is explained
//            already (judging.hpp has all numbers that decide, with their sources).
// Answer     `effect` when a cause gains enough; ties are all causes within decisive_nat of it, or
//            within form_share of its evidence; `suspected` for a reason of Doubt (verdict.hpp);
//            `unknown` when the residual power stands out of the noise and is more than a small
//            part of the calibrated model's excess; else `none`.
// Units      evidence in nats. Thread: blocks the caller, every processor inside.
// Failure    BadInput for records that are too short.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/inference/evidence.hpp"
#include "diagnosis/inference/judging.hpp"
#include "diagnosis/inference/residual.hpp"
#include "diagnosis/inference/verdict.hpp"
#include "diagnosis/model/observer_speed.hpp"
#include "diagnosis/model/point.hpp"
#include "diagnosis/terms/terms.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

struct Settings {
  bool quick{};  ///< a first answer: the strongest cause, from a part of the records
  std::size_t most_causes{3};
  std::optional<effect::Id> only;  ///< the one effect that is looked for; none: all
  Judging judging;
  /// Share done and what is being done; may be empty.
  std::function<void(double, const std::string&)> progress;
  /// Asked between steps, from several threads: true ends the search with what it has found by
  /// then. May be empty.
  std::function<bool()> stop;
};

struct Candidate {
  effect::Id effect{};
  std::string place;
  double score{};  ///< [nat] evidence beyond nuisances and the other causes
  std::size_t hypothesis{};
  bool refitted{};  ///< on the nonlinear model; else from the screen
  /// [nat] gain on the user's validation data over the calibrated model (validation.hpp)
  std::optional<double> validation_nat = std::nullopt;
};

/// Of the parameter of one term, in its unit.
struct Estimate {
  std::size_t term{};  ///< index among the terms
  double value{};
  double deviation{};
};

struct SearchResult {
  Verdict verdict{Verdict::kNone};
  Doubt doubt{Doubt::kNothing};           ///< why the causes are suspected, not named
  double probability{};                   ///< of what is suspected
  bool stopped{};                         ///< Settings::stop ended the search
  std::vector<Hypothesis> causes;         ///< in the order of selection
  std::vector<effect::Id> also_possible;  ///< effects that the data cannot separate from the first
  std::vector<Estimate> parameters;       ///< of the causes
  std::vector<Estimate> calibration;      ///< of the nuisances
  std::vector<Candidate> candidates;      ///< best place of every effect, best first
  ObserverSpeed speed{kSlow};             ///< under which the model followed the records in the end
  Residual residual;
  Point calibrated;  ///< nuisances alone
  Point extended;    ///< with the causes
  /// Posterior of extended.theta: terms x parameters, so that extended.theta + spread z with z
  /// normal of unit variance is a rig that fits as well; in the terms' own units.
  Eigen::MatrixXd spread;
  double evidence{};   ///< [nat] of all causes together
  double explained{};  ///< share of the calibrated model's excess over the noise
};

/// A family that is named has the shape of its best member (refine_shape.hpp) in `extended`, and is
/// called after it. `validation`: records of the user to judge causes by, not fitted; may be empty.
[[nodiscard]] SearchResult Diagnose(const RigView& rig, const std::vector<Record>& records,
                                    const std::vector<Record>& validation, const Settings& settings,
                                    const std::vector<Term>& terms);

}  // namespace levitas::diagnosis
