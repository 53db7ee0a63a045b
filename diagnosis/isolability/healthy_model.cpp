#include "diagnosis/isolability/healthy_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/problem.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/events.hpp"
#include "diagnosis/inference/mains_lines.hpp"
#include "diagnosis/inference/residual.hpp"
#include "diagnosis/records/load.hpp"

namespace levitas::diagnosis {
namespace {

using effect::EffectConfig;
using effect::Id;

/// Lines that a fault may be, although healthy records do not show them.
constexpr std::array kLinesHz{50.0, 60.0};

std::vector<Record> Numbered(std::vector<Record> records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].number = static_cast<std::uint32_t>(i);
    records[i].keeps_validation = true;  // as a diagnosis without --holdout fits them
  }
  return records;
}

/// The innovations of the first runs less those of the second.
std::vector<Trajectory> Difference(const std::vector<Trajectory>& first,
                                   std::vector<Trajectory> second, std::size_t axes) {
  for (std::size_t r = 0; r < second.size(); ++r) {
    auto& moments = second[r].moments;
    for (std::size_t n = 0; n < moments.size(); ++n) {
      const SamplePoint& without = first[r].moments[n];
      for (std::size_t a = 0; a < axes; ++a) {
        moments[n].innovation_m[a] = without.innovation_m[a] - moments[n].innovation_m[a];
      }
      moments[n].counts = moments[n].counts && without.counts;
    }
  }
  return second;
}

}  // namespace

HealthyModel::HealthyModel(const config::RigFile& rig, std::vector<Record> records, bool calibrate,
                           const Judging& judging, std::optional<double> orbit_m)
    : tolerances_(rig.tolerances.value_or(config::Tolerances{})),
      plant_(rig.plant),
      rig_(rig.numbers, rig.plant),
      records_(Spans(Numbered(std::move(records)), kMostRows)),
      orbit_m_(orbit_m.value_or(LargestOrbit(records_, rig_.axes))) {
  if (rig_.geared()) throw BadInput("--plan knows rigs with one rotor, not geared shafts");
  lines_hz_ = MainsLines(rig_, records_);
  for (const double hz : kLinesHz) {
    if (std::find(lines_hz_.begin(), lines_hz_.end(), hz) == lines_hz_.end()) {
      lines_hz_.push_back(hz);
    }
  }
  own_terms_ = AllTerms(rig_, tolerances_, orbit_m_).size();
  terms_ = TermsOf(rig_);
  search_ = std::make_unique<const Search>(rig_, terms_, "", judging.model_error_share);
  gains_ = search_->DesignGains(records_, kSlow);
  std::vector<double> theta = search_->Usual();
  if (calibrate) {
    constexpr int kPasses = 10;
    const Refined fit =
        CalibrateNuisances(rig_, *search_, terms_, records_, records_, gains_, kSlow, kPasses);
    if (!fit.ok) throw BadInput("these records cannot be calibrated: is it the same rig?");
    theta = fit.theta;
  }
  view_ = search_->Linearise(records_, gains_, theta, kWhiteningOrder, search_->Everything());
}

std::vector<Term> HealthyModel::TermsOf(const RigView& rig) const {
  std::vector<Term> terms = AllTerms(rig, tolerances_, orbit_m_);
  const auto mains = MainsTerms(rig, lines_hz_, records_.size());
  terms.insert(terms.end(), mains.begin(), mains.end());
  return terms;
}

LinearProblem HealthyModel::Nothing() const {
  return {view_.sum.jtj, Eigen::VectorXd::Zero(view_.sum.jtj.rows()), 0.0, view_.sum.values};
}

LinearProblem HealthyModel::OfMains(const EffectConfig& entry) const {
  Eigen::VectorXd size = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(terms_.size()));
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    if (term.effect != Id::kMainsPickup || term.location.frequency_hz != entry.values[0]) continue;
    if (!entry.Acts(term.location.axis.value_or(0))) continue;
    if (term.parameter == "cosine")
      size[static_cast<Eigen::Index>(i)] = entry.values[1] / term.scale();
  }
  // e falls along J by what the fault has and the model lacks.
  const Eigen::VectorXd moved = view_.sum.jtj * size;
  return {view_.sum.jtj, -moved, size.dot(moved), view_.sum.values};
}

std::optional<LinearProblem> HealthyModel::SignatureOf(
    const std::vector<EffectConfig>& fault) const {
  if (fault.empty() || EventEvidence(fault)) return std::nullopt;
  if (fault.front().id == Id::kSampleJitter) return std::nullopt;
  if (fault.front().id == Id::kMainsPickup) return OfMains(fault.front());
  plant::PlantConfig spoilt = plant_;
  spoilt.effects.insert(spoilt.effects.end(), fault.begin(), fault.end());
  const RigView with(rig_.numbers, spoilt);
  const std::vector<Term> terms = TermsOf(with);
  const std::vector<Trajectory> runs =
      Difference(*view_.runs, Search(with, terms).Run(records_, gains_, view_.theta), rig_.axes);
  NormalEquations sum = view_.sum;
  view_.slopes->Renew(runs, view_.whitener, sum);
  return LinearProblem{std::move(sum.jtj), std::move(sum.jte), sum.ete, sum.values};
}

std::optional<double> HealthyModel::EventEvidence(const std::vector<EffectConfig>& fault) const {
  if (fault.empty()) return std::nullopt;
  const EffectConfig& entry = fault.front();
  if (entry.id == Id::kDroppedSamples) {
    constexpr double kPerFrame = 10.0;  // events.cpp
    double rows = 0.0;
    for (const Record& record : records_) rows += static_cast<double>(record.rows.size());
    return kPerFrame * (rows * entry.values[0] * entry.values[1] - 1.0);
  }
  if (entry.id != Id::kSensorNoise) return std::nullopt;
  plant::PlantConfig spoilt = plant_;
  spoilt.effects.insert(spoilt.effects.end(), fault.begin(), fault.end());
  const RigView with(rig_.numbers, spoilt);
  double evidence = 0.0;
  for (std::size_t a = 0; a < rig_.axes; ++a) {
    const double off = std::log(with.ReadingNoise(a) / rig_.ReadingNoise(a)) / kNoiseTolerance;
    const double gain = 0.5 * off * off - std::log(10.0);
    if (gain >= kDecisive) evidence += gain;
  }
  return evidence;
}

}  // namespace levitas::diagnosis
