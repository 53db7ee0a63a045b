#include "diagnosis/report/event_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/diagnose/diagnose_files.hpp"
#include "diagnosis/report/effect_entry.hpp"
#include "numerics/normal_distribution.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

struct Burst {
  double probability{}, deviation{}, samples{};
};

/// As plant_sim takes it: a probability of at most a half.
Burst BurstOf(const LostFrames& frames) {
  constexpr double kMost = 0.5;
  const auto bursts = static_cast<double>(frames.bursts);
  const auto held = static_cast<double>(frames.lost);
  const double free = std::max(1.0, static_cast<double>(frames.sent) - held + bursts);
  return {std::min(kMost, bursts / free), std::sqrt(bursts) / free,
          std::max(1.0, std::round(held / std::max(1.0, bursts)))};
}

bool IsCause(const DiagnosisResult& s, effect::Id id) {
  return std::any_of(s.answer.causes.begin(), s.answer.causes.end(),
                     [id](const Hypothesis& cause) { return cause.effect == id; });
}

/// Axes of the cause `sensor_noise`: its place lists their channels.
std::vector<std::size_t> NoisyAxes(const DiagnosisResult& s) {
  std::vector<std::size_t> axes;
  for (const Hypothesis& cause : s.answer.causes) {
    if (cause.effect != effect::Id::kSensorNoise) continue;
    const std::string listed = cause.place + ", ";
    for (std::size_t a = 0; a < s.view->axes; ++a) {
      const std::string name = s.view->numbers.channels[a] + ", ";
      const auto at = listed.find(name);
      if (at == 0 || (at != std::string::npos && listed[at - 1] == ' ')) axes.push_back(a);
    }
  }
  return axes;
}

/// [m] of one sample, the converter's steps left out.
double NoiseOf(const DiagnosisResult& s, std::size_t axis) {
  const double reading = s.view->ReadingNoise(axis);
  const double own = s.view->model->effects().readings[axis].noise_rms_m;
  const double found = s.answer.residual.channels.at(axis).noise_rms_m;
  return std::sqrt(std::max(0.0, found * found - (reading * reading - own * own)));
}

NamedParameter Named(effect::Id id, const char* key, double value, const Location& at) {
  const KeyUnit unit = UnitOfKey(key);
  NamedParameter p;
  p.effect = effect::At(id).name;
  p.key = key;
  p.name = fmt::format("{}[{}]", key, at.name);
  p.unit = unit.symbol;
  p.si = unit.si;
  p.value = p.low = p.high = value / unit.si;
  p.location = at;
  return p;
}

}  // namespace

std::vector<NamedParameter> EventParameters(const DiagnosisResult& s) {
  std::vector<NamedParameter> out;
  if (IsCause(s, effect::Id::kDroppedSamples) && s.lost_frames.bursts > 0) {
    const Burst burst = BurstOf(s.lost_frames);
    const Location all = Everywhere("all axes");
    NamedParameter p = Named(effect::Id::kDroppedSamples, "probability", burst.probability, all);
    p.low = std::max(0.0, p.value - numerics::kInterval90 * burst.deviation);
    p.high = p.value + numerics::kInterval90 * burst.deviation;
    out.push_back(p);
    out.push_back(Named(effect::Id::kDroppedSamples, "burst_samples", burst.samples, all));
  }
  for (const std::size_t axis : NoisyAxes(s)) {
    out.push_back(
        Named(effect::Id::kSensorNoise, "rms_um", NoiseOf(s, axis), AtAxis(s.view->numbers, axis)));
  }
  return out;
}

std::vector<effect::EffectConfig> EventEntries(const DiagnosisResult& s) {
  std::vector<effect::EffectConfig> entries;
  if (IsCause(s, effect::Id::kDroppedSamples) && s.lost_frames.bursts > 0) {
    const Burst burst = BurstOf(s.lost_frames);
    const auto entry =
        MakeEntry(effect::Id::kDroppedSamples, Everywhere("all axes"), s.view->axes,
                  {{"probability", burst.probability, 6}, {"burst_samples", burst.samples, 6}});
    if (entry) entries.push_back(*entry);
  }
  for (const std::size_t axis : NoisyAxes(s)) {
    const auto entry = MakeEntry(effect::Id::kSensorNoise, AtAxis(s.view->numbers, axis),
                                 s.view->axes, {{"rms_um", 1e6 * NoiseOf(s, axis), 6}});
    if (entry) entries.push_back(*entry);
  }
  return entries;
}

}  // namespace levitas::diagnosis
