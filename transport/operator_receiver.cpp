#include "transport/operator_receiver.hpp"

#include <algorithm>
#include <utility>

#include "controller/rt/clock.hpp"
#include "controller/rt/thread_trouble.hpp"

namespace levitas::transport {

namespace {
constexpr std::int64_t kSliceNs = 50'000'000;  // how long the destructor may have to wait
constexpr std::int64_t kSecondNs = 1'000'000'000;
}  // namespace

OperatorReceiver::OperatorReceiver(const LcmNetwork& network, StopLatch& stops,
                                   OperatorHandlers handlers)
    : receiver_(network, Direction::kCommand),
      stops_(stops),
      handlers_(std::move(handlers)),
      stop_receiver_(network, stops, handlers_.enter_stop_thread) {
  thread_ = std::thread([this] { Run(); });
}

OperatorReceiver::~OperatorReceiver() {
  stopping_.store(true);
  thread_.join();
}

OperatorCounts OperatorReceiver::counts() const noexcept {
  const auto get = [](const Count& count) { return count.load(std::memory_order_relaxed); };
  return {get(rejected_) + receiver_.refused(), get(old_), get(overtaken_), get(dropped_)};
}

void OperatorReceiver::Run() {
  while (!stopping_.load()) {
    rt::Guarded("commands", [this] {
      Received received = receiver_.Next();
      if (received.datagram.empty()) {
        // Nothing is left that was sent before these, also if the kernel had to drop a stop.
        const std::uint64_t asked = stops_.asked();
        received = receiver_.Receive(rt::MonotonicNowNs());
        if (received.datagram.empty()) {
          stops_passed_ = asked;
          received = receiver_.Receive(rt::MonotonicNowNs() + kSliceNs);
        }
      }
      if (!received.datagram.empty()) Handle(received);
    });
  }
}

// Where the queue overflows, a stop's own datagram may never arrive here, and it is never empty.
void OperatorReceiver::CountRead() noexcept {
  const std::uint64_t asked = stops_.asked();
  if (stops_passed_ >= asked) {
    read_behind_ = 0;
    return;
  }
  if (read_behind_ == 0) next_passed_ = asked;
  if (++read_behind_ <= kMostQueued) return;
  stops_passed_ = std::max(stops_passed_, next_passed_);
  read_behind_ = 0;
}

void OperatorReceiver::Handle(const Received& received) {
  CountRead();
  const Packet packet = ParsePacket(received.datagram);
  if (packet.kind == PacketKind::kFragment) return;
  if (packet.kind != PacketKind::kShort) {
    Add(rejected_);
  } else if (packet.channel == channel::kCommand) {
    if (auto command = ReadCommand(packet, received.sender)) return HandleCommand(*command);
    Add(rejected_);
  } else if (packet.channel == channel::kExcitation && handlers_.excite) {
    if (auto request = ReadExcitation(packet, received.sender)) {
      return HandleExcitation(*std::move(request));
    }
    Add(rejected_);
  }
}

OperatorReceiver::Seen* OperatorReceiver::Find(std::uint64_t sender) noexcept {
  const auto found = std::find_if(seen_.begin(), seen_.end(),
                                  [sender](const Seen& seen) { return seen.sender == sender; });
  return found == seen_.end() ? nullptr : &*found;
}

void OperatorReceiver::Drop() {
  Add(dropped_);
  if (handlers_.dropped) handlers_.dropped();
}

bool OperatorReceiver::Fits(const CommandOrigin& origin) {
  Seen* seen = Find(origin.sender);
  if (seen != nullptr && origin.sequence <= seen->largest) {
    if (origin.sequence < seen->largest) Add(old_);
    return false;
  }
  if (stops_passed_ < stops_.asked()) {
    Add(overtaken_);
    return false;
  }
  if (seen == nullptr) return true;
  const std::int64_t now_ns = rt::MonotonicNowNs();
  if (now_ns - seen->second_ns >= kSecondNs) {
    seen->second_ns = now_ns;
    seen->in_second = 0;
  }
  if (seen->in_second < kMostPerSecond) return true;
  Drop();
  return false;
}

void OperatorReceiver::Note(const CommandOrigin& origin) noexcept {
  if (Seen* seen = Find(origin.sender); seen != nullptr) {
    seen->largest = std::max(seen->largest, origin.sequence);
    ++seen->in_second;
    return;
  }
  seen_[next_seen_] = {.sender = origin.sender, .largest = origin.sequence, .in_second = 1};
  next_seen_ = (next_seen_ + 1) % kRemembered;
}

void OperatorReceiver::Settle(const CommandOrigin& origin, bool taken) {
  if (!taken) return Drop();
  Note(origin);
}

void OperatorReceiver::HandleCommand(NetworkCommand command) {
  if (command.command == OperatorCommand::kEmergencyStop) {
    // Taken elsewhere; here it makes what its sender said before it old. It may be ahead of the
    // other thread: then that stop still counts as not passed, until the socket is empty.
    Note(command.origin);
    stops_passed_ = std::min(stops_passed_ + 1, stops_.asked());
    return;
  }
  if (!Fits(command.origin)) return;
  command.stops_before = stops_passed_;
  Settle(command.origin, handlers_.take(command));
}

void OperatorReceiver::HandleExcitation(NetworkExcitation request) {
  if (!Fits(request.origin)) return;
  request.stops_before = stops_passed_;
  Settle(request.origin, handlers_.excite(request));
}

}  // namespace levitas::transport
