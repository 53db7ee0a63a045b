#pragma once
// The evidence of causes in recorded data: rig, terms, records, observers, the linearisation.
//
// Lifetime refers to rig, records, settings and terms of the caller.
// Units    evidence in nats. Thread: blocks the caller, every processor inside.

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/observed_landscape.hpp"

namespace levitas::diagnosis {

class RecordLandscape final : public ObservedLandscape {
 public:
  /// `recorded` is fitted, as spans where it has more than `effort.rows`.
  RecordLandscape(const RigView& rig, const std::vector<Record>& recorded, const Settings& settings,
                  const Effort& effort, const std::vector<Term>& terms);

  [[nodiscard]] std::vector<Trajectory> RunAt(const Point& point) const {
    return search_.Run(records_, gains_, point);
  }

  [[nodiscard]] const RigView& rig() const { return rig_; }
  [[nodiscard]] const Search& search() const { return search_; }
  [[nodiscard]] const std::vector<Record>& records() const { return records_; }
  [[nodiscard]] const Gains& gains() const { return gains_; }
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
  [[nodiscard]] bool StopAsked() const override { return search_.StopAsked(); }
  void ReportProgress(double share, const std::string& what) const override;

  [[nodiscard]] const std::vector<Term>& terms() const override { return terms_; }
  [[nodiscard]] std::size_t speed() const override { return speed_; }
  void Observe(std::size_t speed) override;
  [[nodiscard]] const View& view() const override { return view_; }
  void LineariseUnfiltered(const Point& point) override;
  [[nodiscard]] Runs RunsAt(const Point& point) const override;
  [[nodiscard]] bool ModelDivergesAt(const Point& point) const override;
  [[nodiscard]] bool IsLoudAt(const Point& point) const override;
  [[nodiscard]] Whitener PlainFilterOf(const std::vector<Trajectory>& runs) const override;
  [[nodiscard]] double MisfitOf(const Causes& causes, const Point& point) const override;
  [[nodiscard]] Point FileNumbers() const override { return search_.HealthyPoint(); }
  [[nodiscard]] std::unique_ptr<FileFits> FitsFromFile() const override;

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
