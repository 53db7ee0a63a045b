#include "plant_sim/loop/torsion_gauge.hpp"

#include <fmt/core.h>

#include <array>
#include <stdexcept>

#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/rotor/torsion_springs.hpp"

namespace levitas::plant_run {
namespace {

// Another stream than that of the probes, which begins with the seed itself.
constexpr std::uint64_t kStream = 0x746F7273696F6EULL;

std::vector<rotor::TorsionGauges> NoiseOf(const std::vector<rotor::Shaft>& shafts) {
  std::vector<rotor::TorsionGauges> noise;
  for (const rotor::TorsionSpring& spring : rotor::GaugedSprings(shafts)) {
    noise.push_back(spring.gauges);
  }
  if (noise.size() > kMaxCouplings) {
    throw std::invalid_argument(fmt::format("gauges on {} couplings; at most {} can be recorded",
                                            noise.size(), kMaxCouplings));
  }
  return noise;
}

}  // namespace

TorsionGauge::TorsionGauge(const plant::PlantModel& model, std::uint64_t seed)
    : loads_(model), noise_(NoiseOf(model.config().shafts)), random_(seed ^ kStream) {}

void TorsionGauge::Begin(std::uint64_t cycle, std::uint32_t rig_session) noexcept {
  filling_.first_cycle = cycle;
  filling_.rig_session = rig_session;
  filling_.couplings = static_cast<std::uint32_t>(noise_.size());
  filling_.samples = 0;
}

const TorsionBatch* TorsionGauge::Sample(const plant::Plant& plant, std::uint64_t cycle,
                                         std::uint32_t rig_session) noexcept {
  const TorsionBatch* ended = nullptr;
  if (filling_.samples > 0 && cycle != filling_.first_cycle + filling_.samples) {
    complete_ = filling_;
    ended = &complete_;
    filling_.samples = 0;
  }
  if (filling_.samples == 0) Begin(cycle, rig_session);
  const std::size_t couplings = noise_.size();
  const std::size_t at = filling_.samples * couplings;
  const auto torque = std::span(filling_.torque_n_m).subspan(at, couplings);
  const auto twist = std::span(filling_.twist_rad).subspan(at, couplings);
  loads_.Gauge(plant, torque, twist);
  for (std::size_t i = 0; i < couplings; ++i) {
    torque[i] += noise_[i].torque_noise_rms_n_m * random_.Normal();
    twist[i] += noise_[i].twist_noise_rms_rad * random_.Normal();
  }
  if (++filling_.samples < kTorsionSamples) return ended;
  // After an instant that was skipped the batch before it is handed over first; this one is just
  // begun then, so that both never end at once.
  complete_ = filling_;
  filling_.samples = 0;
  return &complete_;
}

}  // namespace levitas::plant_run
