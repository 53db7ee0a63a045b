#include "diagnosis/words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "diagnosis/gear_entry.hpp"

namespace levitas::diagnosis {
namespace {

const std::string kSecond{"s"};
constexpr double kInterval = 1.645;  ///< standard deviations of 5 and 95 %

struct EffectPlace {
  const char* effect;
  const char* place;
};

constexpr std::array kPlaces{EffectPlace{"extra_delay", "timing"},
                             EffectPlace{"dropped_samples", "timing"},
                             EffectPlace{"sample_jitter", "timing"},
                             EffectPlace{"amplifier_bandwidth", "amplifier"},
                             EffectPlace{"amplifier_slew", "amplifier"},
                             EffectPlace{"current_gain", "magnet"},
                             EffectPlace{"displacement_stiffness", "magnet"},
                             EffectPlace{"coil_asymmetry", "magnet"},
                             EffectPlace{"magnetic_saturation", "magnet"},
                             EffectPlace{"hysteresis", "magnet"},
                             EffectPlace{"eddy_current", "magnet"},
                             EffectPlace{"axis_rotation", "magnet"},
                             EffectPlace{"misalignment", "external"},
                             EffectPlace{"coupling_stiffness", "external"},
                             EffectPlace{"cross_coupled_stiffness", "external"},
                             EffectPlace{"static_load", "external"},
                             EffectPlace{"support_mode", "support"},
                             EffectPlace{"touchdown_rub", "support"},
                             EffectPlace{"unbalance", "rotor"},
                             EffectPlace{"shaft_bow", "rotor"},
                             EffectPlace{"shaft_anisotropy", "rotor"},
                             EffectPlace{"modal_frequency", "rotor"},
                             EffectPlace{"modal_damping", "rotor"},
                             EffectPlace{"gyroscopic_inertia", "rotor"},
                             EffectPlace{"internal_damping", "rotor"},
                             EffectPlace{"rotor_mass", "rotor"},
                             EffectPlace{"breathing_crack", "rotor"},
                             EffectPlace{"mesh_stiffness", "gear"},
                             EffectPlace{"mesh_stiffness_variation", "gear"},
                             EffectPlace{"backlash", "gear"},
                             EffectPlace{"mesh_friction", "gear"},
                             EffectPlace{"transmission_error", "gear"},
                             EffectPlace{"gear_runout", "gear"},
                             EffectPlace{"tooth_crack", "gear"}};

/// Pairs that look alike, and what tells them apart.
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
    Pair{"extra_delay", "amplifier_bandwidth", "standing with a test signal rich above 500 Hz"},
    Pair{"extra_delay", "eddy_current", "standing with a test signal rich above 500 Hz"},
    Pair{"eddy_current", "amplifier_bandwidth",
         "standing with measured coil currents, or a test "
         "signal rich above 500 Hz"},
    Pair{"sensor_offset", "static_load",
         "two bias currents: an offset's force grows with the bias "
         "squared, a load stays"},
    Pair{"mains_pickup", "sensor_runout", "another speed: mains stay at their frequency"}};

}  // namespace

std::string PlaceOfEffect(const std::string& effect) {
  for (const auto& entry : kPlaces) {
    if (effect == entry.effect) return entry.place;
  }
  return "sensor";
}

std::vector<NamedParameter> Parameters(const SessionAnswer& s) {
  std::vector<NamedParameter> out;
  const auto& estimates = s.answer.parameters;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& e = estimates[i];
    const double spread = kInterval * e.deviation;
    NamedParameter p{e.effect, e.parameter, e.unit, e.value, e.value - spread, e.value + spread};
    if (e.parameter == "cosine" && i + 1 < estimates.size() &&
        estimates[i + 1].parameter == "sine") {
      const Estimate& sine = estimates[++i];
      p.name = "amplitude";
      p.value = std::hypot(e.value, sine.value);
      p.low = std::max(0.0, p.value - spread);
      p.high = p.value + spread;
      const double phase = std::atan2(sine.value, e.value);
      const double wide = p.value > spread ? spread / p.value : 3.14;
      out.push_back(
          {e.effect, fmt::format("phase[{}]", e.place), "rad", phase, phase - wide, phase + wide});
    } else if (e.parameter == "sqrt(tau_s)") {
      p.name = "tau_s";
      p.unit = kSecond;
      p.value = e.value * e.value;
      p.low = std::pow(std::max(0.0, e.value - spread), 2);
      p.high = std::pow(e.value + spread, 2);
    } else if (const MeshView* mesh = MeshOf(*s.view, e.place); e.effect == "mesh_stiffness") {
      const bool stiff = e.parameter == "stiffness";
      const double own = stiff ? mesh->stiffness_n_per_m : mesh->damping_n_s_per_m;
      p.unit = stiff ? "N/m" : "N s/m";
      p.value = own * (1.0 + p.value);
      p.low = own * (1.0 + p.low);
      p.high = own * (1.0 + p.high);
    } else if (e.parameter == "ratio") {
      p.value += 1.0;
      p.low += 1.0;
      p.high += 1.0;
    } else if (e.parameter == "lag_ratio") {
      // A longer lag is a lower bandwidth: the ends of the interval change places.
      constexpr double kLeastLag = 0.05;
      p.name = "ratio";
      p.value = 1.0 / std::max(kLeastLag, 1.0 + e.value);
      p.low = 1.0 / std::max(kLeastLag, 1.0 + e.value + spread);
      p.high = 1.0 / std::max(kLeastLag, 1.0 + e.value - spread);
    } else if (e.effect == "extra_delay") {
      p.name = "delay_s";
      p.unit = kSecond;
      p.value *= s.view->period_s;
      p.low *= s.view->period_s;
      p.high *= s.view->period_s;
    }
    p.name = fmt::format("{}[{}]", p.name, e.place);
    out.push_back(p);
  }
  return out;
}

std::string VerdictSentence(const SessionAnswer& s) {
  const Answer& a = s.answer;
  if (a.verdict == Verdict::kNone) {
    return "Nothing is hidden: with its tolerances calibrated, the nominal model explains the data "
           "to their noise.";
  }
  if (a.verdict == Verdict::kUnknown) {
    std::string where = fmt::format("{:.0f} Hz", a.remainder.frequency_hz);
    if (a.remainder.order > 0.0)
      where += fmt::format(", order {:.0f} of rotation", a.remainder.order);
    return fmt::format(
        "Something is left that no effect of the vocabulary explains: most of all in {} "
        "about {}, following {}.",
        s.view->numbers.channels[a.remainder.worst_channel], where, a.remainder.coherent_with);
  }
  std::string text = fmt::format("{} at {} ({:.0f} nat)", a.causes.front().effect,
                                 a.causes.front().place, a.candidates.front().score);
  for (std::size_t i = 1; i < a.causes.size(); ++i) {
    text += fmt::format(", and {} at {}", a.causes[i].effect, a.causes[i].place);
  }
  if (!a.also_possible.empty()) {
    text += "; these data cannot tell it from";
    for (const auto& other : a.also_possible) text += " " + other;
  }
  return text + ".";
}

std::string NextExperiment(const SessionAnswer& s) {
  const Answer& a = s.answer;
  if (a.verdict == Verdict::kNone) return "none needed";
  if (a.verdict == Verdict::kUnknown) {
    return "the same with another speed and another bias current: what the remainder does tells "
           "whether it belongs to the rotation, the magnets or neither";
  }
  if (a.also_possible.empty()) return "none needed";
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

double Confidence(const SessionAnswer& s) {
  const auto& candidates = s.answer.candidates;
  if (candidates.empty()) return 0.0;
  const double best = std::max(0.0, candidates.front().score);
  double sum = std::exp(-best);
  for (const Candidate& c : candidates) {
    if (std::isfinite(c.score)) sum += std::exp(c.score - best);
  }
  return (s.answer.causes.empty() ? std::exp(-best) : std::exp(candidates.front().score - best)) /
         sum;
}

std::string PlaceOf(const SessionAnswer& s) {
  const Answer& a = s.answer;
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

std::vector<std::string> Channels(const SessionAnswer& s) {
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
