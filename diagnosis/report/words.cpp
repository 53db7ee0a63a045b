#include "diagnosis/report/words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "diagnosis/report/excitation_coverage.hpp"
#include "diagnosis/report/input_warnings.hpp"
#include "diagnosis/report/validation_check.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// Pairs of similar effects, and the experiment that separates them.
struct Pair {
  const char* first;
  const char* second;
  const char* experiment;
};

constexpr std::array kPairs{
    Pair{"unbalance", "shaft_bow",
         "a run-up over at least a factor of two in speed: unbalance "
         "grows with the square of speed, a bow does not"},
    Pair{"unbalance", "sensor_runout",
         "a slow roll and a run-up: run-out stays as it is at low "
         "speed, unbalance vanishes"},
    Pair{"sensor_runout", "misalignment",
         "a run-up through a bending mode: only a force excites it"},
    Pair{"current_gain", "sensor_gain",
         "a record of the healthy rig or a known weight "
         "hung on the shaft"},
    Pair{"current_gain", "displacement_stiffness",
         "standing with a test signal at two bias currents"},
    Pair{"current_gain", "force_constant",
         "standing with a test signal at two bias currents: only a force "
         "constant changes the negative stiffness"},
    Pair{"command_offset", "static_load",
         "two bias currents: the force of an offset current grows with the "
         "bias, a load stays"},
    Pair{"extra_delay", "amplifier_bandwidth", "standing with a test signal rich above 500 Hz"},
    Pair{"extra_delay", "eddy_current", "standing with a test signal rich above 500 Hz"},
    Pair{"eddy_current", "amplifier_bandwidth",
         "standing with measured coil currents, or a test "
         "signal rich above 500 Hz"},
    Pair{"sensor_offset", "static_load",
         "two bias currents: an offset's force grows with the bias "
         "squared, a load stays"},
    Pair{"mains_pickup", "sensor_runout", "another speed: mains stay at their frequency"}};

constexpr const char* kNoneNeeded = "none needed";

}  // namespace

std::string PlaceOfEffect(const std::string& effect) {
  const effect::Row* row = effect::Find(effect);
  if (row == nullptr) throw std::logic_error(effect + " is not in the catalogue of effects");
  return std::string(effect::Name(row->place));
}

namespace {

/// ": tau_us 5.21 us (4.9 to 5.5)", the first number of a cause, with its place where it is not the
/// same at all; empty where it has none.
std::string Size(const DiagnosisResult& s, const Hypothesis& cause) {
  const auto parameters = Parameters(s);
  const auto first = std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) {
    return p.effect == cause.effect && p.key != kPhaseKey;
  });
  if (first == parameters.end()) return {};
  const bool everywhere = std::all_of(first, parameters.end(), [&first](const auto& p) {
    return p.effect != first->effect || p.key != first->key || p.value == first->value;
  });
  return fmt::format(": {} {:.4g}{}{}{} ({:.4g} to {:.4g})", first->key, first->value,
                     first->unit.empty() ? "" : " ", first->unit,
                     everywhere ? "" : " at " + first->place, first->low, first->high);
}

/// Of a rig in which nothing is hidden: how far it is from its file, and what that is worth.
std::string Explained(const DiagnosisResult& s) {
  const auto values = CalibratedValues(s);
  double furthest = 0.0;
  for (const CalibratedValue& v : values) furthest = std::max(furthest, v.from_file);
  const std::string moved = fmt::format("with its {} numbers moved by at most {:.1f} tolerances",
                                        values.size(), furthest);
  if (!SomethingToGain(s.validation)) {
    return "the rig file explains the data to their noise as it stands" +
           (values.empty() ? "" : ", and " + moved) + ".";
  }
  return fmt::format(
      "the rig file {} explains the data to their noise; as it stands it does not "
      "({:.1f} times the noise, rms).",
      moved, std::sqrt(1.0 + s.validation.to_gain.value));
}

std::string Finding(const DiagnosisResult& s) {
  const SearchResult& a = s.answer;
  if (a.verdict == Verdict::kNone) {
    const std::string limits = UnobservableSentence(s);
    return fmt::format("Nothing is hidden{}: {}{}{}",
                       limits.empty() ? "" : " as far as these records can show", Explained(s),
                       limits.empty() ? "" : " ", limits);
  }
  if (a.verdict == Verdict::kUnknown) {
    std::string where = fmt::format("{:.0f} Hz", a.remainder.frequency_hz);
    if (a.remainder.order > 0.0)
      where += fmt::format(", order {:.0f} of rotation", a.remainder.order);
    return fmt::format(
        "A residual is left that no effect of the vocabulary explains: most of all in {} "
        "about {}, following {}.",
        s.view->numbers.channels[a.remainder.worst_channel], where, a.remainder.coherent_with);
  }
  const double nat = a.candidates.front().score;
  std::string text = fmt::format("{} at {}{}; {:.0f} nat, which is odds of e^{:.0f} to 1 for it",
                                 a.causes.front().effect, a.causes.front().place,
                                 Size(s, a.causes.front()), nat, nat);
  for (std::size_t i = 1; i < a.causes.size(); ++i) {
    text += fmt::format("; and {} at {}{}", a.causes[i].effect, a.causes[i].place,
                        Size(s, a.causes[i]));
  }
  if (!a.also_possible.empty()) {
    text += "; these data do not separate it from";
    for (const auto& other : a.also_possible) text += " " + other;
  }
  return text + ".";
}

}  // namespace

std::string VerdictSentence(const DiagnosisResult& s) {
  std::string text = Finding(s);
  for (const std::string& more : {ValidationSentence(s), DoubtSentence(s)}) {
    if (!more.empty()) text += " " + more;
  }
  return text;
}

namespace {

std::string Experiment(const DiagnosisResult& s) {
  const SearchResult& a = s.answer;
  if (!PassesValidation(s)) return ValidationExperiment(s);
  if (s.own_words) return s.own_words->next.empty() ? kNoneNeeded : s.own_words->next;
  if (a.verdict == Verdict::kNone) {
    const std::string missing = MissingRecords(s);
    return missing.empty() ? kNoneNeeded : missing;
  }
  if (a.verdict == Verdict::kUnknown) {
    return "the same with another speed and another bias current: the change of the residual "
           "shows whether it belongs to the rotation, the magnets or neither";
  }
  if (a.also_possible.empty()) return kNoneNeeded;
  const std::string& cause = a.causes.front().effect;
  for (const auto& pair : kPairs) {
    for (const auto& other : a.also_possible) {
      if ((cause == pair.first && other == pair.second) ||
          (cause == pair.second && other == pair.first)) {
        return pair.experiment;
      }
    }
  }
  return "a longer record with a stronger test signal, standing and at two speeds";
}

}  // namespace

std::string NextExperiment(const DiagnosisResult& s) {
  std::string check;
  if (!DoubtSentence(s).empty()) {
    check = "check units and signs of the columns and the rig file, and diagnose again";
  } else if (!ChangedSince(s).empty()) {
    check = "check that the healthy records are of this rig, as it was before";
  }
  std::string experiment = Experiment(s);
  if (check.empty()) return experiment;
  return experiment == kNoneNeeded ? check : fmt::format("{}; then {}", check, experiment);
}

bool NeedsExperiment(const DiagnosisResult& s) { return Experiment(s) != kNoneNeeded; }

double Confidence(const DiagnosisResult& s) {
  const auto& candidates = s.answer.candidates;
  if (s.answer.verdict == Verdict::kUnknown) return 0.0;
  if (s.answer.verdict == Verdict::kNone) {
    const double rival = candidates.empty() ? -INFINITY : candidates.front().score;
    return 1.0 / (1.0 + std::exp(rival));
  }
  if (candidates.empty()) return 0.0;
  const double best = std::max(0.0, candidates.front().score);
  double sum = std::exp(-best);
  for (const Candidate& c : candidates) {
    if (std::isfinite(c.score)) sum += std::exp(c.score - best);
  }
  return std::exp(candidates.front().score - best) / sum;
}

std::string PlaceOf(const DiagnosisResult& s) {
  const SearchResult& a = s.answer;
  if (!a.causes.empty()) {
    if (a.causes.front().effect == "axis_rotation") return a.causes.front().place.substr(0, 6);
    return PlaceOfEffect(a.causes.front().effect);
  }
  if (a.verdict == Verdict::kNone) return "";
  if (a.remainder.coherent_with == "current") return "magnet";
  if (a.remainder.coherent_with == "rotation" || a.remainder.coherent_with == "position")
    return "rotor";
  return a.remainder.coherent_with == "mains" ? "sensor" : "external";
}

std::vector<std::string> Channels(const DiagnosisResult& s) {
  const auto& channels = s.view->numbers.channels;
  if (s.answer.causes.empty()) {
    if (s.answer.verdict == Verdict::kNone) return {};
    return {channels[s.answer.remainder.worst_channel]};
  }
  std::vector<std::string> found;
  for (std::size_t a = 0; a < channels.size(); ++a) {
    const std::string& channel = channels[a];
    const std::string& bearing = s.view->numbers.bearings[a / 2];
    for (const std::size_t t : s.answer.causes.front().terms) {
      const std::string place = " " + s.terms[t].place + ",";
      const bool named = place.find(" " + channel + ",") != std::string::npos ||
                         place.find(" " + bearing + ",") != std::string::npos;
      if (named && std::find(found.begin(), found.end(), channel) == found.end()) {
        found.push_back(channel);
      }
    }
  }
  return found.empty() ? channels : found;
}

}  // namespace levitas::diagnosis
