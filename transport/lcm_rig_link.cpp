#include "transport/lcm_rig_link.hpp"

#include <fmt/core.h>

#include "rt/clock.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/read_bound.hpp"

namespace levitas::transport {

LcmRigLink::LcmRigLink(const LcmNetwork& network, std::size_t axes, std::int64_t spin_ns)
    : receiver_(network, Direction::kCurrent, spin_ns),
      sender_(network, Direction::kSensor),
      sensor_codec_(axes),
      current_codec_(axes) {}

bool LcmRigLink::Send(const SensorFrame& frame) noexcept {
  const bool sent = sender_.Send(sensor_codec_.Encode(frame));
  ++(sent ? counters_.frames_sent : counters_.send_failures);
  return sent;
}

bool LcmRigLink::SendTorsion(const TorsionBatch& batch) noexcept {
  const std::span<const std::uint8_t> datagram = torsion_.Encode(batch);
  return !datagram.empty() && sender_.Send(datagram);
}

port::RigLink::ReceiveResult LcmRigLink::Accept(const Received& received,
                                                CurrentFrame& frame) noexcept {
  const Packet packet = ParsePacket(received.datagram);
  if (packet.kind == PacketKind::kFragment) return ReceiveResult::kNothing;
  const bool current = packet.channel == channel::kCurrent;
  const bool goodbye = packet.channel == channel::kGoodbye;
  if (packet.kind == PacketKind::kShort && !current && !goodbye) return ReceiveResult::kNothing;
  const std::int64_t now_ns = rt::MonotonicNowNs();
  const bool sound = packet.kind == PacketKind::kShort;
  if (sound && partner_.Refuses(received.speaker(), now_ns)) return ReceiveResult::kNothing;
  if (!sound || !current_codec_.Decode(packet.payload, frame)) {
    ++counters_.currents_rejected;
    return ReceiveResult::kNothing;
  }
  watch_.Saw(received.identity, packet.sequence);
  partner_.Heard(received.speaker(), now_ns);
  if (goodbye) partner_.Release();  // the next one need not wait for the silence
  return goodbye ? ReceiveResult::kGoodbye : ReceiveResult::kCurrent;
}

port::RigLink::ReceiveResult LcmRigLink::Receive(CurrentFrame& frame,
                                                 std::int64_t deadline_ns) noexcept {
  bool found = false;
  for (ReadBound bound; bound.MayGoOn(deadline_ns);) {
    const Received received = found ? receiver_.Next() : receiver_.Receive(deadline_ns);
    if (received.datagram.empty()) break;
    CurrentFrame next = frame;
    const ReceiveResult answer = Accept(received, next);
    if (answer == ReceiveResult::kNothing) {
      bound.Useless();
      continue;
    }
    if (found) ++counters_.currents_skipped;
    // On the way one may overtake another: the last to arrive is not always the newest.
    if (found && answer == ReceiveResult::kCurrent && next.cycle < frame.cycle) continue;
    frame = next;
    found = true;
    if (answer == ReceiveResult::kGoodbye) return answer;
  }
  if (!found) return ReceiveResult::kNothing;
  ++counters_.currents_read;
  return ReceiveResult::kCurrent;
}

port::RigLink::Counters LcmRigLink::counters() const noexcept {
  Counters counters = counters_;
  counters.currents_lost = watch_.lost();
  counters.currents_refused = partner_.refused() + receiver_.refused();
  return counters;
}

std::string LcmRigLink::TakeNews() {
  const auto stranger = partner_.TakeNews();
  if (!stranger) return receiver_.TakeNews();
  return fmt::format(
      "currents of a second controller at {} are refused: the controller at {} is heard; end one "
      "of them, or give each pair a --port of its own",
      AddressText(*stranger), AddressText(partner_.partner()));
}

std::string LcmRigLink::Trouble() const {
  if (partner_.stranger() == 0) return receiver_.Trouble();
  return fmt::format("{} currents of a second controller were refused, last of {}",
                     partner_.refused(), AddressText(partner_.stranger()));
}

}  // namespace levitas::transport
