#include "transport/operator_receiver.hpp"

#include <algorithm>
#include <utility>

#include "rt/clock.hpp"
#include "rt/thread_trouble.hpp"

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
    if (auto command = ReadCommand(packet, received.sender))
      return HandleCommand(received.identity, *command);
    Add(rejected_);
  } else if (packet.channel == channel::kExcitation && handlers_.excite) {
    if (auto request = ReadExcitation(packet, received.sender)) {
      return HandleExcitation(received.identity, *std::move(request));
    }
    Add(rejected_);
  } else if (packet.channel == channel::kHello) {
    Welcome(received.identity);
  }
}

bool OperatorReceiver::Share::Left(std::int64_t now_ns, int most) noexcept {
  if (now_ns - second_ns >= kSecondNs) {
    second_ns = now_ns;
    in_second = 0;
  }
  return in_second < most;
}

void OperatorReceiver::Welcome(std::uint64_t sender) {
  const std::uint64_t challenge = receiver_.Challenge();  // 0: no key, and none is needed
  if (challenge == 0 || !handlers_.challenge) return;
  if (!hellos_.Left(rt::MonotonicNowNs(), kMostHellos)) return;
  ++hellos_.in_second;
  handlers_.challenge({.value = challenge, .asked_by = sender});
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

bool OperatorReceiver::Fits(std::uint64_t sender, std::int64_t sequence) {
  Seen* seen = Find(sender);
  if (seen != nullptr && sequence <= seen->largest) {
    if (sequence < seen->largest) Add(old_);
    return false;
  }
  if (stops_passed_ < stops_.asked()) {
    Add(overtaken_);
    return false;
  }
  if (seen == nullptr || seen->share.Left(rt::MonotonicNowNs(), kMostPerSecond)) return true;
  Drop();
  return false;
}

void OperatorReceiver::Note(std::uint64_t sender, std::int64_t sequence) noexcept {
  if (Seen* seen = Find(sender); seen != nullptr) {
    seen->largest = std::max(seen->largest, sequence);
    ++seen->share.in_second;
    return;
  }
  seen_[next_seen_] = {.sender = sender, .largest = sequence, .share = {.in_second = 1}};
  next_seen_ = (next_seen_ + 1) % kRemembered;
}

void OperatorReceiver::Settle(std::uint64_t sender, std::int64_t sequence, bool taken) {
  if (!taken) return Drop();
  Note(sender, sequence);
}

void OperatorReceiver::HandleCommand(std::uint64_t sender, NetworkCommand command) {
  if (command.command == OperatorCommand::kEmergencyStop) {
    // Taken elsewhere; here it makes what its sender said before it old. It may be ahead of the
    // other thread: then that stop still counts as not passed, until the socket is empty.
    Note(sender, command.origin.sequence);
    stops_passed_ = std::min(stops_passed_ + 1, stops_.asked());
    return;
  }
  const std::int64_t sequence = command.origin.sequence;
  if (!Fits(sender, sequence)) return;
  command.stops_before = stops_passed_;
  Settle(sender, sequence, handlers_.take(command));
}

void OperatorReceiver::HandleExcitation(std::uint64_t sender, NetworkExcitation request) {
  const std::int64_t sequence = request.origin.sequence;
  if (!Fits(sender, sequence)) return;
  request.stops_before = stops_passed_;
  Settle(sender, sequence, handlers_.excite(request));
}

}  // namespace levitas::transport
