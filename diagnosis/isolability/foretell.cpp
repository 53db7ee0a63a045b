#include "diagnosis/isolability/foretell.hpp"

#include <algorithm>
#include <map>
#include <mutex>

#include "common/each_in_parallel.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// Records diagnosed together: sums add. The mains of the further records are left out, since each
/// record has terms of its own for them.
void Add(const LinearProblem& further, std::size_t own_terms, LinearProblem& to) {
  const auto own = static_cast<Eigen::Index>(own_terms);
  to.jtj.topLeftCorner(own, own) += further.jtj.topLeftCorner(own, own);
  to.jte.head(own) += further.jte.head(own);
  to.ete += further.ete;
  to.values += further.values;
}

}  // namespace

std::optional<Prediction> Foretell(const HealthyModel& model, const HealthyModel* further,
                                   const std::vector<effect::EffectConfig>& fault,
                                   const Judging& judging) {
  if (fault.empty()) return std::nullopt;
  const effect::Id effect = fault.front().id;
  if (const auto evidence = model.EventEvidence(fault)) {
    const auto more = further != nullptr ? further->EventEvidence(fault) : std::nullopt;
    return PredictEvent(effect, *evidence + more.value_or(0.0), judging);
  }
  auto signature = model.SignatureOf(fault);
  if (!signature) return std::nullopt;
  if (further != nullptr && fault.front().id != effect::Id::kMainsPickup) {
    if (const auto more = further->SignatureOf(fault)) Add(*more, model.own_terms(), *signature);
  }
  return Predict(effect, *signature, model.terms(), model.hypotheses(), judging);
}

std::vector<Foretold> ForetellAll(const HealthyModel& model, const HealthyModel* further,
                                  const std::vector<StatedFault>& faults, const Judging& judging,
                                  const Progress& progress) {
  // A fault holds three runs of all records: more at a time would take gigabytes.
  constexpr std::size_t kMostAtATime = 4;
  std::vector<std::optional<Prediction>> predictions(faults.size());
  std::mutex telling;
  std::size_t done = 0;
  EachThatMayFail(faults.size(), std::min(kMostAtATime, Processors()), [&](std::size_t i) {
    if (progress) {
      const std::scoped_lock one(telling);
      progress(static_cast<double>(done) / static_cast<double>(faults.size()),
               std::string(effect::At(faults[i].entry.id).name));
    }
    predictions[i] = Foretell(model, further, {faults[i].entry}, judging);
    const std::scoped_lock one(telling);
    ++done;
  });
  std::vector<Foretold> all;
  for (std::size_t i = 0; i < faults.size(); ++i) {
    if (predictions[i]) all.push_back({faults[i], *std::move(predictions[i])});
  }
  return all;
}

std::vector<std::vector<effect::Id>> TiedGroups(const std::vector<Foretold>& all) {
  using effect::Id;
  std::map<Id, std::size_t, effect::ByName>
      group;  // of each effect; merged groups keep the lower number
  const auto join = [&group](Id one, Id other) {
    const std::size_t a = group.try_emplace(one, group.size()).first->second;
    const std::size_t b = group.try_emplace(other, group.size()).first->second;
    for (auto& [id, number] : group) {
      if (number == std::max(a, b)) number = std::min(a, b);
    }
  };
  for (const Foretold& one : all) {
    for (const Id tie : one.prediction.ties) join(one.prediction.effect, tie);
  }
  std::map<std::size_t, std::vector<Id>> members;
  for (const auto& [id, number] : group) members[number].push_back(id);
  std::vector<std::vector<Id>> groups;
  groups.reserve(members.size());
  for (auto& [number, ids] : members) groups.push_back(std::move(ids));
  return groups;
}

}  // namespace levitas::diagnosis
