#include "dashboard/live_run.hpp"

#include <exception>
#include <levitas_msg/sample_batch_t.hpp>
#include <utility>

#include "configuration/rig_file.hpp"
#include "lcmtypes/checked_decode.hpp"
#include "plant_sim/plant/slowest_amplifier.hpp"
#include "plant_sim/plant/train_model.hpp"
#include "session/log/block_events.hpp"
#include "session/log/record_codec.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::dashboard {
namespace {

namespace channel = transport::channel;

template <class Message>
bool Keep(std::span<const std::uint8_t> payload, std::optional<Message>& newest) {
  Message message{};
  if (!message::DecodeChecked(payload, message)) return false;
  newest = std::move(message);
  return true;
}

std::vector<double> RatiosOfBearings(const plant::PlantConfig& plant) {
  std::vector<double> ratios(plant.bearings.size(), 1.0);
  if (plant.shafts.empty()) return ratios;
  const std::vector<double> of_shafts = plant::SpeedRatios(plant);
  for (std::size_t b = 0; b < ratios.size(); ++b) {
    ratios[b] = of_shafts.at(plant.bearings[b].shaft);
  }
  return ratios;
}

}  // namespace

void LiveRun::Take(std::string_view channel, std::span<const std::uint8_t> payload,
                   std::int64_t now_ns) {
  bool good = true;
  if (channel == channel::kHeader) {
    good = TakeHeader(payload);
  } else if (channel == channel::kState) {
    good = TakeState(payload, now_ns);
  } else if (channel == channel::kTiming) {
    good = Keep(payload, timing_);
  } else if (channel == channel::kHistogram) {
    good = Keep(payload, histogram_);
  } else if (channel == channel::kEvent) {
    good = TakeEvent(payload);
  } else if (channel == channel::kSamples) {
    good = TakeSamples(payload);
  }
  if (!good) Refuse();
}

bool LiveRun::TakeHeader(std::span<const std::uint8_t> payload) {
  session::SessionHeader header;
  int version = 0;
  if (session::DecodeHeader(payload, header, version) != session::HeaderResult::kGood) return false;
  const bool known = run_number_ > 0 && header.start_utc_ns == header_.start_utc_ns &&
                     header.rig_yaml == header_.rig_yaml;
  if (known) return true;
  try {
    const configuration::RigFile rig =
        configuration::ParseRig(header.rig_yaml, "the announced rig");
    rig_ = rig.numbers;
    amplifier_hz_ = plant::SlowestAmplifierHz(rig.plant);
    speed_ratios_ = RatiosOfBearings(rig.plant);
  } catch (const std::exception&) {
    return false;  // of a program of another version, or no rig at all
  }
  TakeController(header);
  header_ = std::move(header);
  samples_.emplace(*rig_, on_bucket_);
  state_.reset();
  timing_.reset();
  histogram_.reset();
  ++run_number_;
  return true;
}

// A controller that cannot be read costs what is shown of its blocks, not the run.
void LiveRun::TakeController(const session::SessionHeader& header) {
  blocks_.clear();
  saves_bias_ = false;
  if (header.controller_yaml.empty()) return;
  try {
    const configuration::ControllerFile controller =
        configuration::ParseController(header.controller_yaml, "the announced controller", *rig_);
    for (const auto& block : controller.synchronous.blocks) {
      blocks_.push_back({block.name, false, {}});
    }
    saves_bias_ = !controller.bias.empty();
  } catch (const std::exception&) {
    return;  // of a program of another version
  }
}

void LiveRun::TellBlock(const session::Event& event) {
  const auto told = session::ReadBlockEvent(event.text);
  if (!told) return;
  for (LiveBlock& block : blocks_) {
    if (block.name != told->name) continue;
    block.acts = told->begins;
    block.why = told->why;
  }
}

bool LiveRun::TakeState(std::span<const std::uint8_t> payload, std::int64_t now_ns) {
  if (!Keep(payload, state_)) return false;
  state_arrived_ns_ = now_ns;
  return true;
}

bool LiveRun::TakeEvent(std::span<const std::uint8_t> payload) {
  session::Event event;
  if (!session::DecodeEvent(payload, event)) return false;
  TellBlock(event);
  const double period_s = rig_ ? rig_->period_s() : 0.0;
  const double time_s = static_cast<double>(event.cycle) * period_s;
  events_.push_back({++event_count_, std::move(event), time_s});
  if (events_.size() > kMaxEvents) events_.pop_front();
  return true;
}

bool LiveRun::TakeSamples(std::span<const std::uint8_t> payload) {
  if (!samples_) return true;  // the header is not here yet: nothing is wrong with the batch
  levitas_msg::sample_batch_t batch{};
  return message::DecodeChecked(payload, batch) && samples_->Add(batch);
}

}  // namespace levitas::dashboard
