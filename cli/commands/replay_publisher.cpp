#include "cli/commands/replay_publisher.hpp"

#include <algorithm>
#include <chrono>
#include <levitas_msg/controller_state_t.hpp>
#include <levitas_msg/current_frame_t.hpp>
#include <levitas_msg/sensor_frame_t.hpp>
#include <thread>
#include <vector>

#include "session/log/record_codec.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/multicast_socket.hpp"

namespace levitas::cli {
namespace {

using transport::Direction;
using Clock = std::chrono::steady_clock;

/// One LCM network (one UDP port) to publish on, the way the live programs do.
class Outlet {
 public:
  Outlet(const transport::LcmNetwork& network, Direction direction) : sender_(network, direction) {}
  template <class Message>
  bool Send(const char* channel, const Message& message) {
    bytes_.resize(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
    return Send(channel, bytes_);
  }
  bool Send(const char* channel, const session::Bytes& bytes) {
    datagram_.resize(transport::HeaderSize(channel));
    transport::WriteHeader(datagram_, sequence_++, channel);
    datagram_.insert(datagram_.end(), bytes.begin(), bytes.end());
    return sender_.Send(datagram_);
  }

 private:
  transport::MulticastSender sender_;
  std::uint32_t sequence_{0};
  session::Bytes bytes_;
  std::vector<std::uint8_t> datagram_;
};

std::vector<double> Values(const AxisArray& array, std::size_t axes) {
  return {array.begin(), array.begin() + static_cast<std::ptrdiff_t>(std::min(axes, kMaxAxes))};
}

levitas_msg::sensor_frame_t SensorMessage(const SensorFrame& frame) {
  levitas_msg::sensor_frame_t m;
  m.cycle = static_cast<std::int64_t>(frame.cycle);
  m.sample_time_ns = frame.sample_time_ns;
  m.rig_session = static_cast<std::int32_t>(frame.rig_session);
  m.rig_status = static_cast<std::int32_t>(frame.rig_status);
  m.held_currents = static_cast<std::int32_t>(frame.held_currents);
  m.position_m = Values(frame.position_m, frame.axes);
  m.axes = static_cast<std::int32_t>(m.position_m.size());
  m.speed_rad_per_s = frame.speed_rad_per_s;
  m.angle_rad = frame.angle_rad;
  return m;
}

levitas_msg::current_frame_t CurrentMessage(const CurrentFrame& frame) {
  levitas_msg::current_frame_t m;
  m.cycle = static_cast<std::int64_t>(frame.cycle);
  m.control_current_a = Values(frame.control_current_a, frame.axes);
  m.axes = static_cast<std::int32_t>(m.control_current_a.size());
  m.bias_current_a = frame.bias_current_a;
  m.speed_set_point_rad_per_s = frame.speed_set_point_rad_per_s;
  m.acceleration_limit_rad_per_s2 = frame.acceleration_limit_rad_per_s2;
  m.amplifiers_enabled = static_cast<std::int8_t>(frame.amplifiers_enabled);
  m.drive_enabled = static_cast<std::int8_t>(frame.drive_enabled);
  return m;
}

levitas_msg::controller_state_t StateMessage(const cycle::CycleRecord& record, std::size_t axes) {
  levitas_msg::controller_state_t m;
  m.cycle = static_cast<std::int64_t>(record.in.cycle);
  m.time_ns = record.in.frame.sample_time_ns;
  m.mode = static_cast<std::int8_t>(record.out.mode);
  m.fault = static_cast<std::int8_t>(record.out.fault);
  m.fault_axis = record.out.fault_axis;
  m.position_m = Values(record.in.frame.position_m, axes);
  m.reference_m = Values(record.out.reference_m, axes);
  m.control_current_a = Values(record.out.current.control_current_a, axes);
  m.axes = static_cast<std::int32_t>(m.position_m.size());
  m.bias_current_a = record.out.current.bias_current_a;
  m.speed_rad_per_s = record.in.frame.speed_rad_per_s;
  m.records_lost = 0;
  return m;
}

/// Waits for the moment a record had in the run, `speed` times as fast; never longer than
/// kLongestWait for one record.
class Pace {
 public:
  Pace(std::int64_t period_ns, double speed)
      : period_s_(static_cast<double>(period_ns) * 1e-9 / speed), start_(Clock::now()) {}

  void WaitFor(const cycle::CycleInputs& in) {
    if (started_) {
      const auto periods =
          static_cast<double>(in.cycle - last_cycle_) + static_cast<double>(in.missed_deadlines);
      const std::chrono::duration<double> step(periods * period_s_);
      if (step > kLongestWait) ++shortened_;
      due_s_ += std::min<std::chrono::duration<double>>(step, kLongestWait).count();
    }
    started_ = true;
    last_cycle_ = in.cycle;
    std::this_thread::sleep_until(start_ + std::chrono::duration_cast<Clock::duration>(
                                               std::chrono::duration<double>(due_s_)));
  }
  [[nodiscard]] std::uint64_t shortened() const noexcept { return shortened_; }

 private:
  double period_s_;
  Clock::time_point start_;
  bool started_{false};
  std::uint64_t last_cycle_{};
  double due_s_{};
  std::uint64_t shortened_{};
};

}  // namespace

PublishReport Publish(session::SessionReader& reader, const PublishOptions& options) {
  namespace channel = transport::channel;
  transport::LcmNetwork network = transport::ParseLcmNetwork(options.port);
  transport::TakeKey(network, options.key, "take what is published for their own");
  Outlet sensors(network, Direction::kSensor);
  Outlet currents(network, Direction::kCurrent);
  Outlet telemetry(network, Direction::kTelemetry);
  const std::size_t axes = reader.header().channels.size();
  constexpr std::int64_t kStatePeriodNs = 10'000'000;
  const auto state_cycles = static_cast<std::uint64_t>(std::max<std::int64_t>(
      kStatePeriodNs / std::max<std::int64_t>(reader.header().period_ns, 1), 1));
  Pace pace(reader.header().period_ns, options.speed);
  PublishReport report;
  const auto count = [&report](bool sent) { report.failed += sent ? 0 : 1; };
  const auto tell_events = [&] {
    session::Bytes bytes;
    for (; report.events < reader.events().size(); ++report.events) {
      session::EncodeEvent(reader.events()[report.events], bytes);
      count(telemetry.Send(channel::kEvent, bytes));
    }
  };
  cycle::CycleRecord record;
  while (reader.Next(record)) {
    pace.WaitFor(record.in);
    tell_events();
    if (record.in.frame_present)
      count(sensors.Send(channel::kSensor, SensorMessage(record.in.frame)));
    count(currents.Send(channel::kCurrent, CurrentMessage(record.out.current)));
    if (record.in.cycle % state_cycles == 0) {
      count(telemetry.Send(channel::kState, StateMessage(record, axes)));
    }
    ++report.cycles;
  }
  tell_events();
  report.gaps = pace.shortened();
  return report;
}

}  // namespace levitas::cli
