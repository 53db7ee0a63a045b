#include "design/uncertainty/rig_uncertainty.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/two_pi.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::uncertainty {
namespace {

struct Sizes {
  double frequency_share{};  ///< of the frequency; 0: `frequency_hz` holds
  double frequency_hz{};
  double damping_share{};
  double current_gain{};
  double stiffness{};
};

std::vector<Parameter> Around(const config::RigFile& rig, const Sizes& sizes, std::size_t modes) {
  const plant::PlantModel model(rig.plant);
  std::vector<Parameter> out;
  // Geared shafts share their modes: no effect moves one of them alone.
  if (!rig.plant.shafts.empty()) modes = 0;
  std::vector<std::size_t> flexible;
  for (std::size_t i = 0; i < model.frequency().size() && flexible.size() < modes; ++i)
    if (model.frequency()[i] > 0.0) flexible.push_back(i);
  for (std::size_t i = 0; i < flexible.size(); ++i) {
    const double hz = model.frequency()[flexible[i]] / kTwoPi;
    const double size =
        sizes.frequency_share > 0.0 ? sizes.frequency_share * hz : sizes.frequency_hz;
    out.push_back({Kind::kModeFrequency, i, hz, hz - size, hz + size});
  }
  for (std::size_t i = 0; i < flexible.size(); ++i) {
    const double ratio = model.damping_ratio()[flexible[i]];
    const double size = std::min(sizes.damping_share, 0.99) * ratio;  // damping stays damping
    out.push_back({Kind::kModeDamping, i, ratio, ratio - size, ratio + size});
  }
  for (std::size_t axis = 0; axis < model.channels(); ++axis)
    out.push_back(
        {Kind::kCurrentGain, axis, 1.0, 1.0 - sizes.current_gain, 1.0 + sizes.current_gain});
  for (std::size_t axis = 0; axis < model.channels(); ++axis)
    out.push_back({Kind::kStiffness, axis, 1.0, 1.0 - sizes.stiffness, 1.0 + sizes.stiffness});
  return out;
}

void Add(plant::PlantConfig& rig, effect::Id id, std::uint32_t axes, std::size_t mode,
         double value) {
  effect::EffectConfig entry;
  entry.id = id;
  entry.axes = axes;
  entry.mode = mode;
  entry.values[0] = value;
  rig.effects.push_back(entry);
}

}  // namespace

std::vector<Parameter> Stated(const config::RigFile& rig, const StatedUncertainty& stated) {
  return Around(rig,
                {.frequency_hz = stated.mode_hz,
                 .damping_share = stated.damping_share,
                 .current_gain = stated.current_gain,
                 .stiffness = stated.stiffness},
                stated.modes);
}

std::vector<Parameter> FromTolerances(const config::RigFile& rig, std::size_t modes) {
  constexpr double kDeviations = 3.0;
  const config::Tolerances t = rig.tolerances.value_or(config::Tolerances{});
  return Around(rig,
                {.frequency_share = kDeviations * t.modal_frequency,
                 .damping_share = kDeviations * t.modal_damping,
                 .current_gain = kDeviations * t.current_gain,
                 .stiffness = kDeviations * t.displacement_stiffness},
                modes);
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

config::RigFile At(const config::RigFile& rig, const std::vector<Parameter>& parameters,
                   const std::vector<double>& place) {
  if (place.size() != parameters.size())
    throw std::invalid_argument("a drawn rig needs one place per parameter");
  config::RigFile out = rig;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    const double value = 0.5 * (p.low + p.high) + place[i] * p.size();
    const auto axis = 1U << static_cast<unsigned>(p.index);
    switch (p.kind) {
      case Kind::kModeFrequency:
        Add(out.plant, effect::Id::kModalFrequency, effect::kAllAxes, p.index + 1, value);
        break;
      case Kind::kModeDamping:
        Add(out.plant, effect::Id::kModalDamping, effect::kAllAxes, p.index + 1, value);
        break;
      case Kind::kCurrentGain:
        Add(out.plant, effect::Id::kCurrentGain, axis, 1, value);
        break;
      case Kind::kStiffness:
        Add(out.plant, effect::Id::kDisplacementStiffness, axis, 1, value);
        break;
    }
  }
  return out;
}

}  // namespace levitas::uncertainty
