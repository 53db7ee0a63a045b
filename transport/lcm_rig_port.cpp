#include "transport/lcm_rig_port.hpp"

#include <fmt/core.h>

#include "rt/clock.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/read_bound.hpp"

namespace levitas::transport {

LcmRigPort::LcmRigPort(const LcmNetwork& network, std::size_t axes, std::int64_t spin_ns)
    : receiver_(network, Direction::kSensor, spin_ns),
      sender_(network, Direction::kCurrent),
      sensor_codec_(axes),
      current_codec_(axes) {}

bool LcmRigPort::Accept(const Received& received, SensorFrame& frame) noexcept {
  const Packet packet = ParsePacket(received.datagram);
  if (packet.kind == PacketKind::kFragment) return false;
  if (packet.kind == PacketKind::kShort && packet.channel == channel::kTorsion) {
    KeepTorsion(received, packet.payload);
    return false;
  }
  const bool ours = packet.kind == PacketKind::kShort && packet.channel == channel::kSensor;
  if (packet.kind == PacketKind::kShort && !ours) return false;  // somebody else's channel
  const std::int64_t now_ns = rt::MonotonicNowNs();
  if (ours && partner_.Refuses(received.speaker(), now_ns)) return false;
  if (!ours || !sensor_codec_.Decode(packet.payload, frame)) {
    ++counters_.frames_rejected;
    return false;
  }
  partner_.Heard(received.speaker(), now_ns);
  watch_.Saw(received.identity, packet.sequence);
  if (wire_session_ != frame.rig_session) {
    wire_session_ = frame.rig_session;
    ++session_;
  }
  frame.rig_session = session_;
  return true;
}

void LcmRigPort::KeepTorsion(const Received& received,
                             std::span<const std::uint8_t> payload) noexcept {
  if (!wire_session_ || partner_.Refuses(received.speaker(), rt::MonotonicNowNs())) return;
  TorsionBatch& batch = torsion_[torsion_came_ % torsion_.size()];
  if (!torsion_codec_.Decode(payload, batch) || batch.rig_session != *wire_session_) return;
  batch.rig_session = session_;
  ++torsion_came_;
  if (torsion_came_ - torsion_taken_ > kKeptBatches) ++torsion_taken_;
}

bool LcmRigPort::TakeTorsion(TorsionBatch& batch) noexcept {
  if (torsion_taken_ == torsion_came_) return false;
  batch = torsion_[torsion_taken_ % torsion_.size()];
  ++torsion_taken_;
  return true;
}

port::ReadResult LcmRigPort::Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept {
  bool found = false;
  for (ReadBound bound; bound.MayGoOn(deadline_ns);) {
    // Once there is a frame only what is already queued may replace it.
    const Received received = found ? receiver_.Next() : receiver_.Receive(deadline_ns);
    if (received.datagram.empty()) break;
    SensorFrame next = frame;
    if (!Accept(received, next)) {
      bound.Useless();
      continue;
    }
    // On the way one frame may overtake another: the last to arrive is not always the newest.
    if (found && next.rig_session == frame.rig_session && next.cycle < frame.cycle) {
      ++counters_.frames_skipped;
      continue;
    }
    frame = next;
    // What queued up before the first read was nobody's to read.
    if (found && counters_.frames_read > 0) ++counters_.frames_skipped;
    found = true;
  }
  if (!found) return port::ReadResult::kNothing;
  ++counters_.frames_read;
  return port::ReadResult::kFrame;
}

bool LcmRigPort::Write(const CurrentFrame& frame) noexcept {
  if (!sender_.Send(current_codec_.Encode(frame))) {
    ++counters_.write_failures;
    return false;
  }
  ++counters_.currents_written;
  return true;
}

port::PortCounters LcmRigPort::counters() const noexcept {
  port::PortCounters counters = counters_;
  counters.frames_lost = watch_.lost();
  counters.frames_refused = partner_.refused() + receiver_.refused();
  return counters;
}

std::string LcmRigPort::TakeNews() {
  const auto stranger = partner_.TakeNews();
  if (!stranger) return receiver_.TakeNews();
  return fmt::format(
      "frames of a second rig at {} are refused: the rig at {} is heard; end one of them, or give "
      "each pair a --port of its own",
      AddressText(*stranger), AddressText(partner_.partner()));
}

std::string LcmRigPort::Trouble() const {
  if (partner_.stranger() == 0) return receiver_.Trouble();
  return fmt::format("{} frames of a second rig were refused, last of {}", partner_.refused(),
                     AddressText(partner_.stranger()));
}

void LcmRigPort::SayGoodbye(const CurrentFrame& last) noexcept {
  // Said three times: nobody repeats it when it is lost.
  for (int time = 0; time < 3; ++time) (void)sender_.Send(current_codec_.EncodeGoodbye(last));
}

}  // namespace levitas::transport
