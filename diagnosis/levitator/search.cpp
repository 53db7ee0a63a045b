#include "diagnosis/levitator/search.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "diagnosis/inference/alternatives.hpp"
#include "diagnosis/inference/first_cause.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/refuted_causes.hpp"
#include "diagnosis/inference/selection_steps.hpp"
#include "diagnosis/inference/validation.hpp"

namespace levitas::levitator {
namespace {

/// The screen at one set's fit says little of how far a coil's law comes on the nonlinear model:
/// the best few are fitted whatever it gives them, and no screen takes the place of a fit.
diagnosis::SelectionRules RulesOf(const SearchSettings& settings) {
  constexpr double kAnyDistance = std::numeric_limits<double>::infinity();
  diagnosis::SelectionRules rules;
  rules.judging.form_share = settings.form_share;
  rules.judging.far_beyond = kAnyDistance;
  rules.effort = {.shortlist = 5, .passes = kAllSteps, .alternatives = 4};
  rules.most_causes = settings.most_causes;
  rules.screen_decides = false;
  rules.alike = Alike;
  return rules;
}

std::size_t EffectsSearched() {
  std::set<effect::Id> effects;
  for (const diagnosis::Hypothesis& cause : AllCauses()) effects.insert(cause.effect);
  return effects.size();
}

/// What every candidate gains on the validation data in the place where it stands.
void JudgeCandidates(const LevitatorLandscape& landscape, const Misfit& validation, Found& out) {
  for (std::size_t k = 0; k < out.in_place.size(); ++k) {
    const Causes rest = diagnosis::Without(out.causes, k);
    const Fitted& base = landscape.FitOf(rest);
    for (diagnosis::Candidate& candidate : out.in_place[k]) {
      if (!candidate.refitted) continue;
      const Causes set = diagnosis::With(rest, AllCauses()[candidate.hypothesis]);
      const diagnosis::FitGain gain =
          GainOn(validation, out.filters, landscape.FitOf(set).theta, base.theta);
      candidate.validation_nat = 0.5 * gain.value;
    }
  }
}

}  // namespace

diagnosis::FitGain GainOn(const Misfit& validation, const Filters& filters, const Theta& with,
                          const Theta& without) {
  const std::size_t records = validation.series().size();
  std::vector<double> gain = validation.BlockSums(SharedPart(without, records), filters);
  const std::vector<double> left = validation.BlockSums(SharedPart(with, records), filters);
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] -= left[i];
  return diagnosis::GainOfBlocks(gain);
}

Theta SharedPart(const Theta& theta, std::size_t records) {
  Theta out = Zeros(records);
  const std::size_t from = (theta.size() - kParameters) / kOwnParameters;
  for (const OwnParameter own : {kOwnResistance, kOwnOffset}) {
    double mean = 0.0;
    for (std::size_t i = 0; i < from; ++i) mean += theta[Own(i, own)] / static_cast<double>(from);
    for (std::size_t i = 0; i < records; ++i) out[Own(i, own)] = mean;
  }
  std::copy(theta.begin(), theta.begin() + static_cast<std::ptrdiff_t>(kParameters), out.begin());
  return out;
}

Found Search(const Misfit& data, const Misfit* validation, const SearchSettings& settings) {
  LevitatorLandscape landscape(data, settings.progress);
  const diagnosis::SelectionRules rules = RulesOf(settings);
  Found out;
  out.filters = landscape.filters();
  diagnosis::CauseSelection found;
  found.calibrated = found.point = landscape.SolutionOf({});
  diagnosis::AddCauses(landscape, rules, found);
  diagnosis::ReconsiderFirstCause(landscape, rules, found);
  diagnosis::DropUnproven(landscape, rules, found);
  if (validation != nullptr) {
    const auto gain = [&](const diagnosis::Refined& with, const diagnosis::Refined& without) {
      return GainOn(*validation, out.filters, with.point.theta, without.point.theta);
    };
    diagnosis::DropRefuted(landscape, rules, gain, settings.own_validation ? 0 : 1, found);
  }
  out.in_place = diagnosis::RankInPlaceOfEach(landscape, rules, found);
  out.causes = found.causes;
  out.calibrated = landscape.FitOf({});  // which the search may have bettered
  out.extended = landscape.FitOf(found.causes);
  out.evidence = out.extended.evidence - out.calibrated.evidence;
  if (validation != nullptr) {
    JudgeCandidates(landscape, *validation, out);
    out.validation = GainOn(*validation, out.filters, out.extended.theta, out.calibrated.theta);
    diagnosis::DoubtBy(out.validation, {out.evidence, EffectsSearched()}, rules.judging, found);
    out.doubt = found.doubt;
    out.probability = found.probability;
  }
  landscape.ReportProgress(1.0, "done");
  return out;
}

}  // namespace levitas::levitator
