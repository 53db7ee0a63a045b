#include "identification/live/live_identification.hpp"

#include <cmath>
#include <exception>
#include <levitas_msg/controller_state_t.hpp>
#include <utility>

#include "lcmtypes/checked_decode.hpp"
#include "plant_sim/plant/slowest_amplifier.hpp"
#include "session/log/record_codec.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::identification {
namespace {

namespace channel = transport::channel;

}  // namespace

LiveIdentification::LiveIdentification(LiveOptions options, OnPoint on_point)
    : options_(std::move(options)), on_point_(std::move(on_point)) {}

void LiveIdentification::Take(std::string_view channel, std::span<const std::uint8_t> payload) {
  if (ended_) return;
  bool good = true;
  if (channel == channel::kHeader) {
    good = TakeHeader(payload);
  } else if (channel == channel::kState) {
    good = TakeState(payload);
  } else if (channel == channel::kSamples) {
    good = TakeSamples(payload);
  }
  if (!good) ++refused_;
}

bool LiveIdentification::TakeHeader(std::span<const std::uint8_t> payload) {
  session::SessionHeader header;
  int version = 0;
  if (session::DecodeHeader(payload, header, version) != session::HeaderResult::kGood) return false;
  Take(header);
  return true;
}

void LiveIdentification::Take(const session::SessionHeader& header) {
  const bool known =
      rig_ && header.start_utc_ns == header_.start_utc_ns && header.rig_yaml == header_.rig_yaml;
  if (known || ended_) return;
  if (recursion_ && recursion_->counts().learnt > 0) {
    ended_ = true;
    return;
  }
  rig_ = configuration::ParseRig(header.rig_yaml, "the announced rig");
  header_ = header;
  recursion_.emplace(OptionsFor(*rig_), on_point_);
  feed_.emplace(rig_->numbers, *recursion_);
}

void LiveIdentification::Take(std::uint64_t cycle, Mode mode) {
  if (feed_ && !ended_) feed_->Take(cycle, mode);
}

OnlineOptions LiveIdentification::OptionsFor(const configuration::RigFile& rig) const {
  const auto axes = static_cast<Eigen::Index>(rig.numbers.axes());
  OnlineOptions online{options_.model, axes, axes, rig.numbers.period_s(), 0};
  online.window_rows = std::max<Eigen::Index>(2, std::lround(options_.window_s / online.period_s));
  online.model.input_lag_hz = options_.input_lag_hz.value_or(plant::SlowestAmplifierHz(rig.plant));
  online.model.input_delay = options_.input_delay.value_or(
      static_cast<Eigen::Index>(std::lround(rig.plant.delay_samples)));
  if (options_.sensors) online.model.sensors = options_.sensors(axes);
  return online;
}

bool LiveIdentification::TakeState(std::span<const std::uint8_t> payload) {
  levitas_msg::controller_state_t state{};
  if (!message::DecodeChecked(payload, state) || state.cycle < 0) return false;
  Take(static_cast<std::uint64_t>(state.cycle), static_cast<Mode>(state.mode));
  return true;
}

bool LiveIdentification::TakeSamples(std::span<const std::uint8_t> payload) {
  if (!feed_) return true;  // the header is not here yet: nothing is wrong with the batch
  levitas_msg::sample_batch_t batch{};
  return message::DecodeChecked(payload, batch) && feed_->Take(std::move(batch));
}

}  // namespace levitas::identification
