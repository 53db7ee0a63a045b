#pragma once
// The evidence of causes in recorded data: rig, terms, records, observers, the linearisation.
//
// Lifetime refers to rig, records, settings and terms of the caller.
// Units    evidence in nats. Thread: blocks the caller, two threads inside.

#include <string>
#include <vector>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/evidence_landscape.hpp"

namespace levitas::diagnosis {

class RecordLandscape final : public EvidenceLandscape {
 public:
  /// `recorded` is fitted, as spans where it has more than `effort.rows`.
  RecordLandscape(const RigView& rig, const std::vector<Record>& recorded, const Settings& settings,
                  const Effort& effort, const std::vector<Term>& terms);

  /// Selects the observers of one speed of kSpeeds; invalidates the linearisation.
  void Observe(std::size_t speed);
  [[nodiscard]] std::vector<Trajectory> RunAt(const Point& point) const {
    return search_.Run(records_, gains_, point);
  }

  /// LineariseAt with every innovation weighed alike: no filter takes a fault for coloured noise.
  void LineariseUnfiltered(const Point& point);
  /// [nat] of these causes at the point, with a filter of its own; smaller is better.
  [[nodiscard]] double MisfitOf(const Causes& causes, const Point& point) const;

  [[nodiscard]] const RigView& rig() const { return rig_; }
  [[nodiscard]] const std::vector<Term>& terms() const { return terms_; }
  [[nodiscard]] const Search& search() const { return search_; }
  [[nodiscard]] const std::vector<Record>& records() const { return records_; }
  [[nodiscard]] const Gains& gains() const { return gains_; }
  [[nodiscard]] std::size_t speed() const { return speed_; }
  [[nodiscard]] const View& view() const { return view_; }
  /// On the present linearisation, `given` being part of the base.
  [[nodiscard]] Evidence EvidenceGiven(const Causes& given) const {
    return {view_.problem, terms_, given};
  }

  [[nodiscard]] const Causes& hypotheses() const override { return search_.hypotheses(); }
  void LineariseAt(const Point& point) override;
  [[nodiscard]] double GainOf(const Hypothesis& cause, const Causes& given) const override;
  [[nodiscard]] double GainAt(const Refined& fit, const Hypothesis& cause,
                              const Causes& given) const override;
  [[nodiscard]] std::vector<Candidate> Screen(const Causes& given) const override;
  [[nodiscard]] double EvidenceOf(const Causes& set) const override;
  [[nodiscard]] Point SolutionOf(const Causes& set) const override;
  [[nodiscard]] Point SolutionAt(const Refined& fit, const Causes& set) const override;
  [[nodiscard]] Refined Fit(const Causes& set, const Point& start, int passes,
                            double worth = kAnyEvidence) const override;
  [[nodiscard]] Refined Refit(const Causes& set, double worth = kAnyEvidence) const override;
  [[nodiscard]] Refined RefineShapeOf(const Causes& set, std::size_t at, Refined fit,
                                      double worth = kAnyEvidence) const override;
  [[nodiscard]] bool HasShape(const Hypothesis& cause) const override;
  [[nodiscard]] std::string PlaceAt(const Point& point, const Hypothesis& cause) const override;
  [[nodiscard]] std::vector<ModeProbe> Probes() const override;
  void ReportProgress(double share, const std::string& what) const override;

 private:
  void Linearise(Point at, std::size_t whitening_order);

  const RigView& rig_;
  const std::vector<Term>& terms_;
  const Settings& settings_;
  int passes_;
  Search search_;
  std::vector<Record> part_;            ///< of longer records
  const std::vector<Record>& records_;  ///< that are fitted
  std::size_t speed_{0};                ///< of the observers, in kSpeeds
  Gains gains_;
  Refiner refiner_;
  View view_;
  mutable double progress_{0.0};  ///< share of the work, by the last progress
};

}  // namespace levitas::diagnosis
