#pragma once
// State of the search of one diagnosis: rig, terms, records, the present linearisation, and the
// causes found so far.
//
// Units   evidence in nats. Thread: blocks the caller, two threads inside. Internal to
//         diagnose.cpp, selection.cpp, exchange.cpp, alternatives.cpp, fit_gain.cpp,
//         moved_calibration.cpp, validation.cpp and suspicion.cpp.

#include <limits>
#include <string>
#include <vector>

#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

/// Extent of a search.
struct Effort {
  int calibrations;          ///< passes with the slow observer
  std::size_t shortlist;     ///< candidates refitted for every cause
  int passes;                ///< of each
  std::size_t alternatives;  ///< refitted in the end
  std::size_t rows;          ///< of all records
  bool first_cause_only;
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

struct SearchState {
  SearchState(const RigView& of, const std::vector<Record>& recorded,
              const std::vector<Record>& aside, const Settings& asked, const Effort& spent,
              std::vector<Term>& all);
  SearchState(const SearchState&) = delete;
  SearchState& operator=(const SearchState&) = delete;

  void ReportProgress(double share, const std::string& what) const;
  /// Selects the observers of one speed; invalidates the linearisation.
  void Observe(std::size_t with);
  /// Linearises all terms about theta.
  void LineariseAll();
  /// Causes fitted from where the linearisation sees them (Refiner::Fit).
  [[nodiscard]] Refined Refit(const std::vector<Hypothesis>& set,
                              double worth = -std::numeric_limits<double>::infinity()) const;
  /// Gives a refined member of a family its new place, here and in the search.
  void TakePlace(Hypothesis& member);
  /// Evidence of a cause given the others, on the linearisation.
  [[nodiscard]] double GainOf(std::size_t cause) const;

  const RigView& rig;
  const std::vector<Record>& all_records;
  const std::vector<Record>& validation;  ///< of the user; may be empty
  std::vector<Term>& terms;
  const Settings& settings;
  Effort effort;
  Search search;
  std::vector<Record> part;            ///< of longer records
  const std::vector<Record>& records;  ///< that are fitted
  std::size_t speed{0};                ///< of the observers, in kSpeeds
  std::size_t slowest{0};              ///< that can be gone back to
  Gains gains;
  Refiner refiner;

  std::vector<double> theta, calibrated;  ///< with the causes; nuisances alone
  Runs calibrated_runs;
  View view;
  std::vector<Hypothesis> causes;
  std::vector<Candidate> refitted;    ///< by the last search for a further cause
  std::vector<Candidate> candidates;  ///< every effect at its best place, best first
  double leader_evidence{};           ///< of all causes with the first one
  std::vector<CauseSet> contenders;   ///< sets that the leader's evidence does not refute
  Doubt doubt{Doubt::kNothing};
  double probability{};  ///< of what is suspected

 private:
  mutable double progress_{0.0};  ///< share of the work, by the last progress
};

}  // namespace levitas::diagnosis
