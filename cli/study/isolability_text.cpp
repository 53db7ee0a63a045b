#include "cli/study/isolability_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "plant_sim/effect/catalogue.hpp"
#include "report/text/text_table.hpp"

namespace levitas::cli {
namespace {

using diagnosis::Foretold;
using diagnosis::Isolation;
using diagnosis::Prediction;
using diagnosis::Tried;

std::string AnswerText(const Prediction& p) {
  switch (p.isolation) {
    case Isolation::kFound:
      return p.by_moved_number ? "found by its number alone" : "found";
    case Isolation::kTied:
      return fmt::format("tied with {}", fmt::join(effect::NamesOf(p.ties), ", "));
    case Isolation::kTakenFor:
      return fmt::format("taken for {}", fmt::join(effect::NamesOf(p.ties), ", "));
    case Isolation::kNotVisible:
      break;
  }
  return "not visible";
}

std::string Nat(double nat) {
  return std::isfinite(nat) ? fmt::format("{:.1f}", nat) : std::string("-");
}

std::string NameOf(effect::Id id) { return std::string(effect::At(id).name); }

const Prediction* Before(const std::vector<Foretold>& all, effect::Id effect) {
  for (const Foretold& one : all) {
    if (one.prediction.effect == effect) return &one.prediction;
  }
  return nullptr;
}

/// Faults that a way makes better off.
std::vector<std::string> Helped(const std::vector<Foretold>& all, const Tried& tried) {
  std::vector<std::string> helped;
  for (const diagnosis::Outcome& outcome : tried.outcomes) {
    const Prediction* before = Before(all, outcome.effect);
    if (before != nullptr && diagnosis::Splits(*before, outcome.after)) {
      helped.push_back(NameOf(outcome.effect));
    }
  }
  return helped;
}

/// A JSON number, or null for what a place refuses.
nlohmann::ordered_json Number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

nlohmann::ordered_json FaultJson(const Prediction& p) {
  return {{"effect", NameOf(p.effect)},
          {"answer", Word(p.isolation)},
          {"detectable_nat", Number(p.detectable_nat)},
          {"evidence_nat", Number(p.evidence_nat)},
          {"visible_from", Number(p.visible_from)},
          {"probability", Number(p.probability)},
          {"by_moved_number", p.by_moved_number},
          {"ties", effect::NamesOf(p.ties)}};
}

}  // namespace

std::string IsolabilityText(const std::vector<Foretold>& all) {
  report::TextTable table;
  table.Add({"fault", "where", "size", "nat left", "evidence", "from", "next nat", "chance %"});
  for (const Foretold& one : all) {
    const Prediction& p = one.prediction;
    table.Add({NameOf(p.effect), one.fault.place, one.fault.size, Nat(p.detectable_nat),
               Nat(p.evidence_nat),
               p.visible_from > 0.0 && p.visible_from < 100.0
                   ? fmt::format("{:.2g}", p.visible_from)
                   : std::string("-"),
               p.alternatives.empty() ? "-" : Nat(p.alternatives.front().evidence_nat),
               fmt::format("{:.0f}", 100.0 * p.probability)});
  }
  std::string text =
      table.Text() +
      "\nnat left: half the squared norm of the signature that calibration cannot take; evidence: "
      "for the\nfault itself, Occam factor paid; from: share of the size from which it would be "
      "decisive; next: of\nthe best other effect; chance: that noise leaves it decisive.\n\n";
  std::vector<std::string> found;
  std::vector<std::string> hidden;
  for (const Foretold& one : all) {
    const Prediction& p = one.prediction;
    if (p.isolation == Isolation::kFound) found.push_back(NameOf(p.effect));
    if (p.isolation == Isolation::kNotVisible) hidden.push_back(NameOf(p.effect));
  }
  text += fmt::format("Found alone ({}): {}\n", found.size(), fmt::join(found, ", "));
  text += fmt::format("Not visible at this size ({}): {}\n", hidden.size(),
                      hidden.empty() ? "none" : fmt::format("{}", fmt::join(hidden, ", ")));
  const auto groups = TiedGroups(all);
  text += fmt::format("Ties ({}):{}\n", groups.size(), groups.empty() ? " none" : "");
  for (const auto& group : groups)
    text += fmt::format("  {}\n", fmt::join(effect::NamesOf(group), " | "));
  for (const Foretold& one : all) {
    const Isolation isolation = one.prediction.isolation;
    if (isolation != Isolation::kTied && isolation != Isolation::kTakenFor) continue;
    text += fmt::format("    {}: {}\n", NameOf(one.prediction.effect), AnswerText(one.prediction));
  }
  return text;
}

std::string SplitsText(const std::vector<Foretold>& all, const std::vector<Tried>& tried) {
  std::string text = "\nWhat would help, beside these records:\n";
  std::set<std::string> helped_by_any;
  for (const Tried& one : tried) {
    const auto helped = Helped(all, one);
    helped_by_any.insert(helped.begin(), helped.end());
    text += fmt::format("  {}\n    {}\n", one.what,
                        !one.failed.empty() ? "not possible: " + one.failed
                        : helped.empty()    ? std::string("splits nothing")
                                            : fmt::format("{}", fmt::join(helped, ", ")));
  }
  for (const Foretold& one : all) {
    const Prediction& p = one.prediction;
    if (p.isolation == Isolation::kFound || helped_by_any.contains(NameOf(p.effect))) continue;
    text += fmt::format("  {}: {}; none of these helps\n", NameOf(p.effect), AnswerText(p));
  }
  return text;
}

std::optional<std::size_t> BestScenario(const std::vector<Foretold>& all,
                                        const std::vector<Tried>& tried) {
  std::optional<std::size_t> best;
  std::size_t most = 0;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const std::size_t helps = Helped(all, tried[i]).size();
    if (tried[i].scenario.empty() || helps <= most) continue;
    most = helps;
    best = i;
  }
  return best;
}

nlohmann::ordered_json IsolabilityJson(const std::vector<Foretold>& all,
                                       const std::vector<Tried>& tried) {
  nlohmann::ordered_json json;
  json["faults"] = nlohmann::ordered_json::array();
  for (const Foretold& one : all) {
    auto entry = FaultJson(one.prediction);
    entry["place"] = one.fault.place;
    entry["size"] = one.fault.size;
    for (const diagnosis::Alternative& other : one.prediction.alternatives) {
      entry["matrix"][NameOf(other.effect)] = {{"evidence_nat", Number(other.evidence_nat)},
                                               {"left_nat", Number(other.left_nat)},
                                               {"place", other.place}};
    }
    json["faults"].push_back(entry);
  }
  json["tied_groups"] = nlohmann::ordered_json::array();
  for (const auto& group : TiedGroups(all)) json["tied_groups"].push_back(effect::NamesOf(group));
  json["tried"] = nlohmann::ordered_json::array();
  for (const Tried& one : tried) {
    nlohmann::ordered_json entry{
        {"what", one.what}, {"helps", Helped(all, one)}, {"failed", one.failed}};
    entry["faults"] = nlohmann::ordered_json::array();
    for (const diagnosis::Outcome& outcome : one.outcomes) {
      entry["faults"].push_back(FaultJson(outcome.after));
    }
    json["tried"].push_back(entry);
  }
  return json;
}

}  // namespace levitas::cli
