#include "benchmark/accuracy/agreement.hpp"

#include <algorithm>

namespace levitas::accuracy {
namespace {

using diagnosis::Isolation;
using diagnosis::Prediction;

bool Has(const std::vector<effect::Id>& list, effect::Id effect) {
  return std::find(list.begin(), list.end(), effect) != list.end();
}

}  // namespace

std::vector<effect::Id> NamedOrTied(const std::string& verdict,
                                    const std::vector<effect::Id>& named,
                                    const std::vector<effect::Id>& ties) {
  if (named.empty() || (verdict != "effect" && verdict != "suspected")) return {};
  std::vector<effect::Id> all{named.front()};
  all.insert(all.end(), ties.begin(), ties.end());
  return all;
}

Isolation KindOf(effect::Id hidden, const std::vector<effect::Id>& named_or_tied) noexcept {
  if (named_or_tied.empty()) return Isolation::kNotVisible;
  if (!Has(named_or_tied, hidden)) return Isolation::kTakenFor;
  return named_or_tied.size() == 1 ? Isolation::kFound : Isolation::kTied;
}

std::vector<effect::Id> Foretold(const Prediction& prediction) {
  std::vector<effect::Id> all = prediction.ties;
  const Isolation isolation = prediction.isolation;
  if (isolation == Isolation::kFound || isolation == Isolation::kTied) {
    all.insert(all.begin(), prediction.effect);
  }
  return all;
}

RowEntries CompareRow(const Prediction& prediction, const std::vector<effect::Id>& named_or_tied) {
  const std::vector<effect::Id> foretold = Foretold(prediction);
  RowEntries entries;
  const auto compare = [&](effect::Id effect) {
    ++entries.all;
    if (Has(foretold, effect) == Has(named_or_tied, effect)) ++entries.right;
  };
  compare(prediction.effect);
  for (const diagnosis::Alternative& other : prediction.alternatives) compare(other.effect);
  return entries;
}

}  // namespace levitas::accuracy
