#pragma once
// A healthy rig's records, linearised once, and the signature that a fault would leave in them.
//
// Signature  s = e(model of the rig) - e(model of the rig with the effect), both driven with the
//            recorded commands: what the fault would add to the readings. The effect is the plant's
//            own (plant_sim/effect), at its size, nonlinear as it is.
// Equation   J^T J of all terms, J^T s and s^T s, whitened by the healthy innovations, about the
//            healthy rig (evidence.hpp). The mains are a sine of the effect's amplitude in every
//            record, by their terms, and no signature where the line would not be looked for
//            (mains_lines.hpp).
// Nonlinear  what calibration takes is fitted on the nonlinear model: e of the calibrated model
//            less e of that with the effect, two Gauss-Newton passes with the healthy Jacobian.
// Additive   what adds a force or a reading (unbalance, bow, misalignment, run-out, load) is taken
//            in proportion, from a twentieth of it: driven with the healthy rig's commands, the
//            model of a large unbalance swings far out of its bearings, which the loop of the real
//            rig prevents.
// Calibrated records of a real rig are calibrated first; those of a simulated rig file are not.
// Single samples  noise and lost frames have no signature: `EventEvidence` (as events.hpp counts).
// Limits     the loop is not run again: what a fault does to the commands by feedback is left out.
//            One axis and more, no geared shafts.
// Units      nat. Thread: blocks the caller, every processor inside.
// Failure    BadInput for geared shafts, and for records that cannot be calibrated.

#include <memory>
#include <optional>
#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {

class HealthyModel {
 public:
  /// `records` are levitated (LeaveOutContact).
  /// `orbit_m`: see terms.hpp; without it, the largest in the records.
  HealthyModel(const configuration::RigFile& rig, std::vector<Record> records, bool calibrate,
               const Judging& judging, std::optional<double> orbit_m = std::nullopt);
  HealthyModel(const HealthyModel&) = delete;
  HealthyModel& operator=(const HealthyModel&) = delete;

  /// The healthy rig: no signature.
  [[nodiscard]] LinearProblem Nothing() const;
  /// None for what has no signature.
  [[nodiscard]] std::optional<LinearProblem> SignatureOf(
      const std::vector<effect::EffectConfig>& fault) const;
  /// None for what is no event.
  [[nodiscard]] std::optional<double> EventEvidence(
      const std::vector<effect::EffectConfig>& fault) const;

  /// Runs of the model of the rig with the fault, with the healthy rig's parameters.
  [[nodiscard]] std::vector<Trajectory> RunWith(const std::vector<effect::EffectConfig>& fault,
                                                const std::vector<Record>& records,
                                                const Gains& gains) const;

  [[nodiscard]] const Point& point() const noexcept { return view_.point; }
  [[nodiscard]] const RigView& rig() const noexcept { return rig_; }
  [[nodiscard]] const std::vector<Term>& terms() const noexcept { return terms_; }
  [[nodiscard]] const std::vector<Hypothesis>& hypotheses() const { return search_->hypotheses(); }
  /// The first so many terms are not those of the mains.
  [[nodiscard]] std::size_t own_terms() const noexcept { return own_terms_; }
  [[nodiscard]] double orbit_m() const noexcept { return orbit_m_; }
  [[nodiscard]] const std::vector<Record>& records() const noexcept { return records_; }

 private:
  [[nodiscard]] std::vector<Term> TermsOf(const RigView& rig) const;
  /// Of runs with a fault: the model calibrated to them as far as that lowers the cost.
  [[nodiscard]] LinearProblem Calibrated(const std::vector<Trajectory>& faulty) const;
  [[nodiscard]] bool ShowsLine(const effect::EffectConfig& entry) const;
  [[nodiscard]] LinearProblem OfMains(const effect::EffectConfig& entry) const;

  configuration::Tolerances tolerances_;
  plant::PlantConfig plant_;
  RigView rig_;
  std::vector<Record> records_;
  double orbit_m_;
  std::size_t own_terms_{};
  std::vector<double> lines_hz_;  ///< of the mains
  std::vector<Term> terms_;
  std::unique_ptr<const Search> search_;
  Gains gains_;
  View view_;
};

}  // namespace levitas::diagnosis
