#include "diagnosis/isolability/foretell.hpp"

#include <algorithm>
#include <map>

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
  const std::string effect(effect::At(fault.front().id).name);
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
  std::vector<Foretold> all;
  double done = 0.0;
  for (const StatedFault& fault : faults) {
    const std::string effect(effect::At(fault.entry.id).name);
    if (progress) progress(done / static_cast<double>(faults.size()), effect);
    done += 1.0;
    auto prediction = Foretell(model, further, {fault.entry}, judging);
    if (prediction) all.push_back({fault, *std::move(prediction)});
  }
  return all;
}

std::vector<std::vector<std::string>> TiedGroups(const std::vector<Foretold>& all) {
  std::map<std::string, std::size_t> group;  // of each effect; merged groups keep the lower number
  const auto join = [&group](const std::string& one, const std::string& other) {
    const std::size_t a = group.try_emplace(one, group.size()).first->second;
    const std::size_t b = group.try_emplace(other, group.size()).first->second;
    for (auto& [name, number] : group) {
      if (number == std::max(a, b)) number = std::min(a, b);
    }
  };
  for (const Foretold& one : all) {
    for (const std::string& tie : one.prediction.ties) join(one.prediction.effect, tie);
  }
  std::map<std::size_t, std::vector<std::string>> members;
  for (const auto& [name, number] : group) members[number].push_back(name);
  std::vector<std::vector<std::string>> groups;
  groups.reserve(members.size());
  for (auto& [number, names] : members) groups.push_back(std::move(names));
  return groups;
}

}  // namespace levitas::diagnosis
