#include "hil/can_port/can_rig_port.hpp"

#include "rt/clock.hpp"

namespace levitas::can_port {

namespace {
constexpr int kGoodbyes = 3;         // nobody repeats it when it is lost
constexpr std::int64_t kMaxAge = 2;  // [periods] in real time
}  // namespace

CanRigPort::CanRigPort(const can::Layout& layout, const std::vector<can::BusConfig>& buses,
                       const CanPortOptions& options, can::BusAccess& access)
    : options_(options), period_ns_(layout.period_ns), access_(access), assembler_(layout) {
  for (const can::Message& message : layout.messages) {
    if (message.sender != can::Sender::kController) continue;
    (message.every == 1 ? fast_ : slow_)
        .push_back({can::MessageCodec(message, layout.format), can::BusOf(message, buses)});
  }
}

bool CanRigPort::Accept(const can::Reception& reception, std::int64_t newest_ns,
                        SensorFrame& frame) noexcept {
  if (reception.event != can::BusEvent::kFrame) {
    watch_.Note(reception);
    return false;
  }
  if (!watch_.Hears(reception.socket)) return false;
  SensorFrame got;
  if (assembler_.Take(reception.frame, got) != can::Outcome::kFrame) return false;
  if (options_.realtime) {
    if (newest_ns - reception.frame.received_ns > kMaxAge * period_ns_) {
      ++watch_.counters().stale;
      return false;
    }
    got.sample_time_ns = reception.frame.received_ns - options_.wire_ns;
  } else {
    got.sample_time_ns = static_cast<std::int64_t>(got.cycle) * period_ns_;
  }
  frame = got;
  return true;
}

port::ReadResult CanRigPort::Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept {
  const std::int64_t now_ns = options_.realtime ? rt::MonotonicNowNs() : 0;
  SensorFrame newest;
  bool found = false;
  for (int taken = 0;; ++taken) {
    if (taken == kMostPerRead) {
      // What was found may be old: a newer one may lie behind what is left.
      ++watch_.counters().read_limit;
      return port::ReadResult::kNothing;
    }
    const can::Reception reception = access_.Next();
    if (reception.event == can::BusEvent::kNothing) {
      // Once there is a frame only what is already queued may replace it.
      if (found || !access_.Wait(deadline_ns)) break;
      continue;
    }
    if (!Accept(reception, now_ns, newest)) continue;
    if (found) ++counters_.frames_skipped;
    found = true;
  }
  if (!found) return port::ReadResult::kNothing;
  ++counters_.frames_read;
  frame = newest;
  return port::ReadResult::kFrame;
}

bool CanRigPort::Send(Outgoing& outgoing, const can::Values& values) noexcept {
  const can::SendResult result = access_.Send(outgoing.bus, outgoing.codec.Encode(values));
  watch_.Note(result);
  return result == can::SendResult::kSent;
}

bool CanRigPort::Write(const CurrentFrame& frame) noexcept {
  if (watch_.AnyOff()) {
    ++counters_.write_failures;
    return false;
  }
  const can::Values values = can::ValuesOf(frame, false);
  // Before the currents: a bias belongs to the currents it comes with.
  drive_owed_ = schedule_.Due(frame) || drive_owed_;
  if (drive_owed_) {
    drive_owed_ = false;
    for (Outgoing& outgoing : slow_) drive_owed_ = !Send(outgoing, values) || drive_owed_;
  }
  bool sent = true;
  for (Outgoing& outgoing : fast_) sent = Send(outgoing, values) && sent;
  ++(sent ? counters_.currents_written : counters_.write_failures);
  return sent;
}

port::PortCounters CanRigPort::counters() const noexcept {
  port::PortCounters counters = counters_;
  const can::OutcomeCounters& outcomes = assembler_.outcomes();
  counters.frames_rejected = outcomes[can::Outcome::kDamaged] + outcomes[can::Outcome::kRepeated] +
                             outcomes[can::Outcome::kOutOfOrder];
  counters.frames_lost = assembler_.lost();
  return counters;
}

void CanRigPort::SayGoodbye(const CurrentFrame& last) noexcept {
  const can::Values values = can::ValuesOf(last, true);
  for (int time = 0; time < kGoodbyes; ++time) {
    for (Outgoing& outgoing : slow_) Send(outgoing, values);  // the drive's last set point
    for (Outgoing& outgoing : fast_) Send(outgoing, values);
  }
}

std::string CanRigPort::Trouble() const {
  std::string text = Text(watch_.counters(), access_.dropped());
  const can::OutcomeCounters& outcomes = assembler_.outcomes();
  const auto add = [&](can::Outcome outcome, const char* name) {
    if (outcomes[outcome] == 0) return;
    text += (text.empty() ? "" : "; ") + std::to_string(outcomes[outcome]) + " x " + name;
  };
  if (access_.clock_steps() > 0) {
    text += (text.empty() ? "" : "; ") + std::to_string(access_.clock_steps()) +
            " x the wall clock was set (without effect)";
  }
  add(can::Outcome::kDamaged, "damaged frame");
  add(can::Outcome::kRepeated, "copy of a frame");
  add(can::Outcome::kOutOfOrder, "frame out of order");
  return text;
}

}  // namespace levitas::can_port
