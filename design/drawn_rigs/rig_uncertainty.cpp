#include "design/drawn_rigs/rig_uncertainty.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::uncertainty {
namespace {

/// Half intervals: of the i-th flexible mode about its number, of an axis as a share.
struct Sizes {
  std::function<double(std::size_t mode, double hz)> frequency_hz;
  std::function<double(std::size_t mode)> damping_share;
  std::function<double(std::size_t axis)> current_gain;
  std::function<double(std::size_t axis)> stiffness;
};

std::vector<Parameter> Around(const configuration::RigFile& rig, const Sizes& sizes,
                              std::size_t modes) {
  const plant::PlantModel model(rig.plant);
  std::vector<Parameter> out;
  // Geared shafts share their modes: no effect moves one of them alone.
  if (!rig.plant.shafts.empty()) modes = 0;
  std::vector<std::size_t> flexible;
  for (std::size_t i = 0; i < model.frequency().size() && flexible.size() < modes; ++i)
    if (model.frequency()[i] > 0.0) flexible.push_back(i);
  for (std::size_t i = 0; i < flexible.size(); ++i) {
    const double hz = model.frequency()[flexible[i]] / kTwoPi;
    const double size = sizes.frequency_hz(i, hz);
    out.push_back({Kind::kModeFrequency, i, hz, hz - size, hz + size});
  }
  for (std::size_t i = 0; i < flexible.size(); ++i) {
    const double ratio = model.damping_ratio()[flexible[i]];
    const double size = std::min(sizes.damping_share(i), 0.99) * ratio;  // damping stays damping
    out.push_back({Kind::kModeDamping, i, ratio, ratio - size, ratio + size});
  }
  const auto per_axis = [&](Kind kind, const auto& size) {
    for (std::size_t axis = 0; axis < model.channels(); ++axis)
      out.push_back({kind, axis, 1.0, 1.0 - size(axis), 1.0 + size(axis)});
  };
  per_axis(Kind::kCurrentGain, sizes.current_gain);
  per_axis(Kind::kStiffness, sizes.stiffness);
  return out;
}

/// The entry of `rig` that holds this number of the whole axis or mode from the start, alone; it is
/// made where there is none. An entry of several axes is divided.
effect::EffectConfig& EntryOf(plant::PlantConfig& rig, effect::Id id, std::uint32_t axes,
                              std::size_t mode, std::size_t channels, double without) {
  const auto meant = [&](const effect::EffectConfig& entry) {
    return entry.id == id && !entry.timed() && (entry.axes & axes) != 0U && entry.mode == mode;
  };
  effect::EffectConfig one;
  one.id = id;
  one.axes = axes;
  one.mode = mode;
  one.values[0] = without;
  const auto found = std::ranges::find_if(rig.effects, meant);
  if (found == rig.effects.end()) {
    rig.effects.push_back(one);
    return rig.effects.back();
  }
  const std::uint32_t all = (1U << static_cast<unsigned>(channels)) - 1U;
  if (axes == effect::kAllAxes || (found->axes & all) == axes) return *found;
  one.values = found->values;
  one.strength = found->strength;
  found->axes = found->axes & all & ~axes;
  rig.effects.push_back(one);
  return rig.effects.back();
}

/// The same for every mode and every axis.
auto Always(double size) {
  return [size](std::size_t) { return size; };
}

constexpr double kDeviations = 3.0;

}  // namespace

std::vector<Parameter> Stated(const configuration::RigFile& rig, const StatedUncertainty& stated) {
  return Around(rig,
                {.frequency_hz = [&](std::size_t, double) { return stated.mode_hz; },
                 .damping_share = Always(stated.damping_share),
                 .current_gain = Always(stated.current_gain),
                 .stiffness = Always(stated.stiffness)},
                stated.modes);
}

std::vector<Parameter> FromTolerances(const configuration::RigFile& rig, std::size_t modes) {
  const configuration::Tolerances t = rig.tolerances.value_or(configuration::Tolerances{});
  const double frequency_share = kDeviations * t.modal_frequency;
  return Around(rig,
                {.frequency_hz = [=](std::size_t, double hz) { return frequency_share * hz; },
                 .damping_share = Always(kDeviations * t.modal_damping),
                 .current_gain = Always(kDeviations * t.current_gain),
                 .stiffness = Always(kDeviations * t.displacement_stiffness)},
                modes);
}

std::vector<Parameter> FromIdentification(const configuration::RigFile& rig,
                                          const IdentifiedDeviations& found) {
  if (found.current_gain.size() != rig.numbers.axes() ||
      found.stiffness.size() != rig.numbers.axes() ||
      found.frequency_hz.size() != found.damping_share.size()) {
    throw BadInput(fmt::format(
        "the identification is of {} axes, rig {} has {}; give the rig file that it wrote (--out)",
        found.current_gain.size(), rig.numbers.name, rig.numbers.axes()));
  }
  const auto of = [](const std::vector<double>& deviations) {
    return [&deviations](std::size_t i) { return kDeviations * deviations[i]; };
  };
  return Around(
      rig,
      {.frequency_hz = [&](std::size_t i, double) { return kDeviations * found.frequency_hz[i]; },
       .damping_share = of(found.damping_share),
       .current_gain = of(found.current_gain),
       .stiffness = of(found.stiffness)},
      found.frequency_hz.size());
}

std::string NameOf(const Parameter& parameter, const std::vector<std::string>& channels) {
  switch (parameter.kind) {
    case Kind::kModeFrequency:
      return fmt::format("mode {} frequency [Hz]", parameter.index + 1);
    case Kind::kModeDamping:
      return fmt::format("mode {} damping ratio [1]", parameter.index + 1);
    case Kind::kCurrentGain:
      return fmt::format("ki {} [1]", channels.at(parameter.index));
    case Kind::kStiffness:
      return fmt::format("ks {} [1]", channels.at(parameter.index));
  }
  return "";
}

std::vector<double> DrawPlace(Random& draw, std::size_t parameters) {
  std::vector<double> out(parameters);
  for (double& place : out) place = 2.0 * draw.Uniform() - 1.0;
  return out;
}

configuration::RigFile At(const configuration::RigFile& rig,
                          const std::vector<Parameter>& parameters,
                          const std::vector<double>& place) {
  if (place.size() != parameters.size())
    throw std::invalid_argument("a drawn rig needs one place per parameter");
  configuration::RigFile out = rig;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    const double value = 0.5 * (p.low + p.high) + place[i] * p.size();
    const auto of_mode = [&](effect::Id id) {
      EntryOf(out.plant, id, effect::kAllAxes, p.index + 1, rig.numbers.axes(), value).values[0] =
          value;
    };
    // A share is of what the file has: of its own entry where it has one.
    const auto of_axis = [&](effect::Id id) {
      EntryOf(out.plant, id, 1U << static_cast<unsigned>(p.index), 1, rig.numbers.axes(), 1.0)
          .values[0] *= value;
    };
    switch (p.kind) {
      case Kind::kModeFrequency:
        of_mode(effect::Id::kModalFrequency);
        break;
      case Kind::kModeDamping:
        of_mode(effect::Id::kModalDamping);
        break;
      case Kind::kCurrentGain:
        of_axis(effect::Id::kCurrentGain);
        break;
      case Kind::kStiffness:
        of_axis(effect::Id::kDisplacementStiffness);
        break;
    }
  }
  return out;
}

std::vector<configuration::RigFile> DrawRigs(const configuration::RigFile& rig,
                                             const std::vector<Parameter>& parameters,
                                             std::size_t count, std::uint64_t seed) {
  Random draw(seed);
  std::vector<configuration::RigFile> rigs;
  rigs.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    rigs.push_back(At(rig, parameters, DrawPlace(draw, parameters.size())));
  }
  return rigs;
}

}  // namespace levitas::uncertainty
