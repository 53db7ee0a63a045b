#include "hil/can_port/can_rig_link.hpp"

#include "hil/can_port/can_rig_port.hpp"

namespace levitas::can_port {

CanRigLink::CanRigLink(const can::Layout& layout, const std::vector<can::BusConfig>& buses,
                       can::BusAccess& access)
    : access_(access), assembler_(layout) {
  for (const can::Message& message : layout.messages) {
    if (message.sender != can::Sender::kRig) continue;
    const Outgoing outgoing{can::MessageCodec(message, layout.format), can::BusOf(message, buses),
                            message.every};
    // The slow ones first: a rotation belongs to the positions it comes with.
    outgoing_.insert(message.every > 1 ? outgoing_.begin() : outgoing_.end(), outgoing);
  }
}

bool CanRigLink::Send(const SensorFrame& frame) noexcept {
  own_cycle_ = frame.cycle;
  if (watch_.AnyOff()) {
    ++counters_.send_failures;
    return false;
  }
  const can::Values values = can::ValuesOf(frame);
  bool sent = true;
  for (Outgoing& outgoing : outgoing_) {
    if (frame.cycle % outgoing.every != 0) continue;
    const can::SendResult result = access_.Send(outgoing.bus, outgoing.codec.Encode(values));
    watch_.Note(result);
    sent = result == can::SendResult::kSent && sent;
  }
  ++(sent ? counters_.frames_sent : counters_.send_failures);
  return sent;
}

port::RigLink::ReceiveResult CanRigLink::Accept(const can::Reception& reception,
                                                CurrentFrame& frame) noexcept {
  if (reception.event != can::BusEvent::kFrame) {
    watch_.Note(reception);
    return ReceiveResult::kNothing;
  }
  if (!watch_.Hears(reception.socket)) return ReceiveResult::kNothing;
  const can::Outcome outcome = assembler_.Take(reception.frame, own_cycle_, frame);
  if (outcome == can::Outcome::kGoodbye) return ReceiveResult::kGoodbye;
  return outcome == can::Outcome::kFrame ? ReceiveResult::kCurrent : ReceiveResult::kNothing;
}

port::RigLink::ReceiveResult CanRigLink::Receive(CurrentFrame& frame,
                                                 std::int64_t deadline_ns) noexcept {
  bool found = false;
  for (int taken = 0;; ++taken) {
    if (taken == kMostPerRead) {
      ++watch_.counters().read_limit;
      return ReceiveResult::kNothing;  // as in can_rig_port.cpp
    }
    const can::Reception reception = access_.Next();
    if (reception.event == can::BusEvent::kNothing) {
      if (found || !access_.Wait(deadline_ns)) break;
      continue;
    }
    const ReceiveResult answer = Accept(reception, frame);
    if (answer == ReceiveResult::kGoodbye) return answer;
    if (answer == ReceiveResult::kNothing) continue;
    if (found) ++counters_.currents_skipped;
    found = true;
  }
  if (!found) return ReceiveResult::kNothing;
  ++counters_.currents_read;
  return ReceiveResult::kCurrent;
}

port::RigLink::Counters CanRigLink::counters() const noexcept {
  Counters counters = counters_;
  const can::OutcomeCounters& outcomes = assembler_.outcomes();
  counters.currents_rejected = outcomes[can::Outcome::kDamaged] +
                               outcomes[can::Outcome::kRepeated] +
                               outcomes[can::Outcome::kOutOfOrder];
  counters.currents_lost = assembler_.lost();
  return counters;
}

std::string CanRigLink::Trouble() const { return Text(watch_.counters(), access_.dropped()); }

}  // namespace levitas::can_port
