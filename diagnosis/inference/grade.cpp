#include "diagnosis/inference/grade.hpp"

#include <algorithm>

#include "diagnosis/inference/suspicion.hpp"

namespace levitas::diagnosis {
namespace {

bool IsUnexplained(const Judging& judging, const Remainder& left, bool named) {
  if (!(left.sigma > judging.unexplained_sigma)) return false;
  const bool stands_out = left.sigma > judging.stands_out_sigma;
  return !named ||
         left.explained < (stands_out ? judging.nearly_all_share : judging.explained_share);
}

/// A cause far ahead of all others, though it leaves a residual. Not of a chain that the search had
/// to cut off: as many causes as it may have imitate what is not in the vocabulary.
bool LeadsFar(const SelectionRules& rules, const CauseSelection& found) {
  if (found.causes.size() >= rules.most_causes && rules.most_causes > 1) return false;
  const auto& all = found.candidates;
  if (found.causes.empty() || all.empty() || all.front().effect != found.causes.front().effect)
    return false;
  const double suspected = rules.judging.suspected_nat;
  const double next = all.size() > 1 ? all[1].score : 0.0;
  return all.front().refitted && all.front().score - std::max(0.0, next) > suspected;
}

}  // namespace

Verdict GradeOf(const SelectionRules& rules, const Remainder& left, CauseSelection& found) {
  if (IsUnexplained(rules.judging, left, !found.causes.empty())) {
    if (!LeadsFar(rules, found)) return Verdict::kUnknown;
    const double likely = std::clamp(left.explained, 0.0, 1.0) *
                          ProbabilityOfLeader(found.candidates, rules.judging.decisive_nat);
    if (!(likely > kLikely)) return Verdict::kUnknown;
    found.doubt = Doubt::kResidualIsLeft;
    found.probability = likely;
    return Verdict::kSuspected;
  }
  if (found.causes.empty()) return found.stopped ? Verdict::kUnknown : Verdict::kNone;
  if (found.stopped && found.doubt == Doubt::kNothing) {
    found.doubt = Doubt::kStopped;
    found.probability = ProbabilityOfLeader(found.candidates, rules.judging.decisive_nat);
  }
  return found.doubt == Doubt::kNothing ? Verdict::kEffect : Verdict::kSuspected;
}

}  // namespace levitas::diagnosis
