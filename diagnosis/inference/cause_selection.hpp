#pragma once
// Causes found so far, what competes with them, and how far a search may go. Plain data.
//
// Units   evidence in nats; theta in the terms' own units. Thread: any.

#include <functional>
#include <utility>
#include <vector>

#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

/// Extent of a search.
struct Effort {
  int calibrations{};          ///< passes with the slow observer
  std::size_t shortlist{};     ///< candidates refitted for every cause
  int passes{};                ///< of each
  std::size_t alternatives{};  ///< refitted in the end
  std::size_t rows{};          ///< of all records
  bool first_cause_only{};
};

/// What the steps of the selection go by.
struct SelectionRules {
  Judging judging;
  Effort effort;
  std::size_t most_causes{3};
  /// What the screen gives too little to be named is not fitted. False: the best of the screen are
  /// fitted whatever it gives them, since laws bend away from it.
  bool screen_decides{true};
  /// Effects that do much the same by their physics: each is refitted in the other's place, however
  /// far behind it seems. Empty: none.
  std::function<bool(effect::Id, effect::Id)> alike{};
};

/// Causes and their fit.
struct CauseSet {
  std::vector<Hypothesis> causes;
  Refined fit;

  /// Keeps the better one.
  void Take(const std::vector<Hypothesis>& other, Refined with) {
    if (!with.ok || (fit.ok && with.evidence <= fit.evidence)) return;
    causes = other;
    fit = std::move(with);
  }
};

struct CauseSelection {
  Point point, calibrated;  ///< with the causes; nuisances alone
  Runs calibrated_runs;     ///< of the fitted records
  std::vector<Hypothesis> causes;
  std::vector<Candidate> refitted;    ///< by the last search for a further cause
  std::vector<Candidate> candidates;  ///< every effect at its best place, best first
  double leader_evidence{};           ///< of all causes with the first one
  std::vector<CauseSet> contenders;   ///< sets that the leader's evidence does not refute
  bool whitened_anew{};               ///< by a search that ends with its first cause
  bool stopped{};                     ///< the search was ended before everything was tried
  Doubt doubt{Doubt::kNothing};
  double probability{};  ///< of what is suspected

  /// The calibrated numbers; the shapes that were found are still those that are screened.
  [[nodiscard]] Point WithoutCauses() const { return {calibrated.theta, point.shapes}; }
};

}  // namespace levitas::diagnosis
