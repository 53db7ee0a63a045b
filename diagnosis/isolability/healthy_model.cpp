#include "diagnosis/isolability/healthy_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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

/// Add a force or a reading in proportion to their size.
constexpr std::array kAdditive{Id::kUnbalance, Id::kShaftBow, Id::kMisalignment, Id::kSensorRunout,
                               Id::kStaticLoad};

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

HealthyModel::HealthyModel(const configuration::RigFile& rig, std::vector<Record> records,
                           bool calibrate, const Judging& judging, std::optional<double> orbit_m)
    : tolerances_(rig.tolerances.value_or(configuration::Tolerances{})),
      plant_(rig.plant),
      rig_(rig.numbers, rig.plant),
      records_(Spans(Numbered(std::move(records)), kMostRows, rig_.period_s)),
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
  search_ = std::make_unique<const Search>(rig_, terms_, std::nullopt, judging.model_error_share);
  gains_ = search_->DesignGains(records_, kSlow);
  Point point = search_->HealthyPoint();
  if (calibrate) {
    constexpr int kPasses = 5;
    const Refined fit =
        CalibrateNuisances(rig_, *search_, terms_, records_, records_, gains_, kSlow, kPasses);
    if (!fit.ok) throw BadInput("these records cannot be calibrated: is it the same rig?");
    point = fit.point;
  }
  view_ = search_->Linearise(records_, gains_, point, kWhiteningOrder, search_->Everything());
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

/// A diagnosis has terms for lines that stand out of their neighbourhood alone.
bool HealthyModel::ShowsLine(const EffectConfig& entry) const {
  std::vector<Record> spoilt = records_;
  for (Record& record : spoilt) {
    for (analysis::RecordedRow& row : record.rows) {
      const double time_s = rig_.period_s * static_cast<double>(row.cycle);
      const double reading_m = entry.strength * entry.values[1] *
                               std::cos(2.0 * std::numbers::pi * entry.values[0] * time_s);
      for (std::size_t a = 0; a < rig_.axes; ++a) {
        if (entry.Acts(a)) row.sample.position_m[a] += reading_m;
      }
    }
  }
  const std::vector<double> lines = MainsLines(rig_, spoilt);
  return std::find(lines.begin(), lines.end(), entry.values[0]) != lines.end();
}

LinearProblem HealthyModel::OfMains(const EffectConfig& entry) const {
  if (!ShowsLine(entry)) return Nothing();
  Eigen::VectorXd size = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(terms_.size()));
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    if (term.effect != Id::kMainsPickup || term.location.frequency_hz != entry.values[0]) continue;
    if (!entry.Acts(term.location.axis.value_or(0))) continue;
    if (term.parameter == "cosine")
      size[static_cast<Eigen::Index>(i)] = entry.strength * entry.values[1] / term.scale();
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
  if (std::find(kAdditive.begin(), kAdditive.end(), fault.front().id) == kAdditive.end()) {
    return Calibrated(RunWith(fault, records_, gains_));
  }
  constexpr double kShare = 0.05;
  std::vector<EffectConfig> small = fault;
  for (EffectConfig& entry : small) entry.strength *= kShare;
  LinearProblem of_small = Calibrated(RunWith(small, records_, gains_));
  const Eigen::VectorXd jte = of_small.jte / kShare;
  return LinearProblem{std::move(of_small.jtj), jte, of_small.ete / (kShare * kShare),
                       of_small.values};
}

std::vector<Trajectory> HealthyModel::RunWith(const std::vector<EffectConfig>& fault,
                                              const std::vector<Record>& records,
                                              const Gains& gains) const {
  plant::PlantConfig spoilt = plant_;
  spoilt.effects.insert(spoilt.effects.end(), fault.begin(), fault.end());
  const RigView with(rig_.numbers, spoilt);
  const std::vector<Term> terms = TermsOf(with);
  return Search(with, terms).Run(records, gains, view_.point);
}

LinearProblem HealthyModel::Calibrated(const std::vector<Trajectory>& faulty) const {
  const Eigen::VectorXd healthy = search_->Scaled(view_.point.theta);
  // About the healthy rig, of the model at theta against that with the fault.
  const auto problem_at = [&](const std::vector<Trajectory>& runs, const Eigen::VectorXd& away) {
    NormalEquations sum = view_.sum;
    view_.slopes->Renew(Difference(runs, faulty, rig_.axes), view_.whitener, sum);
    return std::pair{AtOrigin(sum, away), 0.5 * sum.ete};
  };
  auto [best, cost] = problem_at(*view_.runs, Eigen::VectorXd::Zero(healthy.size()));
  constexpr int kPasses = 2;  // calibration of a real record converges about as fast
  for (int pass = 0; pass < kPasses; ++pass) {
    const Fit fit = Evidence(best, terms_, {}).Solve();
    std::vector<double> theta(terms_.size());
    for (std::size_t i = 0; i < theta.size(); ++i) {
      const double scaled =
          healthy[static_cast<Eigen::Index>(i)] + fit.theta[static_cast<Eigen::Index>(i)];
      theta[i] =
          std::max(LeastPossible(terms_[i]), terms_[i].healthy_mean + scaled * terms_[i].scale());
    }
    const Eigen::VectorXd away = search_->Scaled(theta) - healthy;
    auto [next, left] =
        problem_at(search_->Run(records_, gains_, {theta, view_.point.shapes}), away);
    const double now = left + 0.5 * fit.penalty;
    if (!(now < cost)) break;  // also where a run was lost
    best = std::move(next);
    cost = now;
  }
  return best;
}

std::optional<double> HealthyModel::EventEvidence(const std::vector<EffectConfig>& fault) const {
  if (fault.empty()) return std::nullopt;
  const EffectConfig& entry = fault.front();
  if (entry.id == Id::kDroppedSamples) {
    constexpr double kPerFrame = 10.0;  // events.cpp
    double rows = 0.0;
    for (const Record& record : records_) rows += static_cast<double>(record.rows.size());
    return kPerFrame * (rows * entry.strength * entry.values[0] * entry.values[1] - 1.0);
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
