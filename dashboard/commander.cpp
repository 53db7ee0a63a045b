#include "dashboard/commander.hpp"

#include <fmt/core.h>

#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>

#include "transport/lcm_packet.hpp"

namespace levitas::dashboard {
namespace {

template <class Message>
void Append(const Message& message, std::vector<std::uint8_t>& datagram) {
  const std::size_t header = datagram.size();
  const int size = message.getEncodedSize();
  datagram.resize(header + static_cast<std::size_t>(size));
  message.encode(datagram.data() + header, 0, size);
}

}  // namespace

Commander::Commander(const transport::LcmNetwork& network, std::chrono::milliseconds patience)
    : patience_(patience),
      sender_(network, transport::Direction::kCommand),
      // A later start never repeats the numbers of an earlier one.
      sequence_(std::chrono::duration_cast<std::chrono::microseconds>(
                    std::chrono::system_clock::now().time_since_epoch())
                    .count()) {}

void Commander::Send(const char* channel, Datagram& datagram) {
  const std::lock_guard lock(sending_);  // for the length of a system call
  transport::WriteHeader(datagram, datagrams_.fetch_add(1), channel);
  sender_.Send(datagram);
}

template <class Encode>
CommandReply Commander::Ask(OperatorCommand command, const char* channel, Encode encode) {
  Datagram datagram(transport::HeaderSize(channel));
  const bool stop = command == OperatorCommand::kEmergencyStop;
  std::int64_t sequence = 0;
  if (stop) {
    sequence = NextNumber();
    encode(datagram, sequence);
    Send(channel, datagram);
    Withdraw(sequence);
  }
  std::unique_lock lock(mutex_);
  if (!stop) {
    // Under the lock in which it is sent first: what leaves later has the larger number.
    sequence = NextNumber();
    encode(datagram, sequence);
  }
  const auto mine = waiting_.emplace(sequence, std::nullopt).first;
  const auto settled = [&] { return mine->second || (!stop && Withdrawn(sequence)); };
  const auto end = std::chrono::steady_clock::now() + patience_;
  for (bool said = stop; !settled() && std::chrono::steady_clock::now() < end; said = false) {
    if (!said) Send(channel, datagram);
    answered_.wait_for(lock, kRepeat, settled);
  }
  CommandReply reply = mine->second ? *mine->second : Unanswered(command, settled());
  waiting_.erase(mine);
  return reply;
}

/// What is older and unanswered gives up.
void Commander::Withdraw(std::int64_t stop) {
  std::int64_t newest = newest_stop_.load();
  while (newest < stop && !newest_stop_.compare_exchange_weak(newest, stop)) {
  }
  answered_.notify_all();
}

CommandReply Commander::Unanswered(OperatorCommand command, bool withdrawn) const {
  if (withdrawn) {
    return {CommandOutcome::kUnanswered,
            fmt::format("{} is not asked for any more: an emergency stop came after it",
                        Name(command))};
  }
  return {CommandOutcome::kUnanswered,
          fmt::format("the controller did not answer {} within {:.1f} s: is it running, and on "
                      "this port?",
                      Name(command), std::chrono::duration<double>(patience_).count())};
}

CommandReply Commander::Send(const CommandRequest& request) {
  levitas_msg::operator_command_t message{};
  message.command = static_cast<std::int8_t>(request.command);
  message.speed_rad_per_s = request.speed_rad_per_s;
  message.acceleration_rad_per_s2 = request.acceleration_rad_per_s2;
  return Ask(request.command, transport::channel::kCommand,
             [&](Datagram& datagram, std::int64_t sequence) {
               message.sequence = sequence;
               Append(message, datagram);
             });
}

CommandReply Commander::SendExcitation(const std::string& step_yaml) {
  levitas_msg::excitation_request_t message{};
  message.step_yaml = step_yaml;
  return Ask(OperatorCommand::kExcite, transport::channel::kExcitation,
             [&](Datagram& datagram, std::int64_t sequence) {
               message.sequence = sequence;
               Append(message, datagram);
             });
}

void Commander::Saw(const transport::CommandAnswer& answer) {
  if (answer.sender_port != sender_.port()) return;
  {
    const std::lock_guard lock(mutex_);
    const auto mine = waiting_.find(answer.sequence);
    if (mine == waiting_.end()) return;
    mine->second = {answer.refused ? CommandOutcome::kRefused : CommandOutcome::kAccepted,
                    answer.text};
  }
  answered_.notify_all();
}

}  // namespace levitas::dashboard
