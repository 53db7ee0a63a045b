#include "dashboard/commander.hpp"

#include <fmt/core.h>

#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <vector>

#include "transport/lcm_packet.hpp"

namespace levitas::dashboard {
namespace {

constexpr std::string_view kPrefix = "command ";

template <class Message>
void Append(const Message& message, std::vector<std::uint8_t>& datagram) {
  const std::size_t header = datagram.size();
  const int size = message.getEncodedSize();
  datagram.resize(header + static_cast<std::size_t>(size));
  message.encode(datagram.data() + header, 0, size);
}

}  // namespace

std::optional<CommandAnswer> AnswerIn(const std::string& event_text) {
  const std::string_view text = event_text;
  if (!text.starts_with(kPrefix)) return std::nullopt;
  const std::string_view rest = text.substr(kPrefix.size());
  for (std::uint8_t i = 1; i < kOperatorCommandCount; ++i) {
    const auto command = static_cast<OperatorCommand>(i);
    const std::string_view name = Name(command);
    if (!rest.starts_with(name) || !rest.substr(name.size()).starts_with(' ')) continue;
    return CommandAnswer{command, rest.substr(name.size()).starts_with(" refused")};
  }
  return std::nullopt;
}

Commander::Commander(const transport::LcmNetwork& network, std::chrono::milliseconds patience)
    : patience_(patience),
      sender_(network, transport::Direction::kCommand),
      // A later start never repeats the numbers of an earlier one.
      sequence_(std::chrono::duration_cast<std::chrono::microseconds>(
                    std::chrono::system_clock::now().time_since_epoch())
                    .count()) {}

template <class Encode>
CommandReply Commander::Ask(OperatorCommand command, const char* channel, Encode encode) {
  std::unique_lock lock(mutex_);
  std::vector<std::uint8_t> datagram(transport::HeaderSize(channel));
  encode(datagram, ++sequence_);
  Answers& answers = answers_.at(static_cast<std::size_t>(command));
  const std::uint64_t before = answers.count;
  const auto end = std::chrono::steady_clock::now() + patience_;
  while (std::chrono::steady_clock::now() < end) {
    transport::WriteHeader(datagram, datagrams_++, channel);
    sender_.Send(datagram);
    if (answered_.wait_for(lock, kRepeat, [&] { return answers.count != before; })) {
      return answers.newest;
    }
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
             [&](std::vector<std::uint8_t>& datagram, std::int64_t sequence) {
               message.sequence = sequence;
               Append(message, datagram);
             });
}

CommandReply Commander::SendExcitation(const std::string& step_yaml) {
  levitas_msg::excitation_request_t message{};
  message.step_yaml = step_yaml;
  return Ask(OperatorCommand::kExcite, transport::channel::kExcitation,
             [&](std::vector<std::uint8_t>& datagram, std::int64_t sequence) {
               message.sequence = sequence;
               Append(message, datagram);
             });
}

void Commander::Saw(const std::string& event_text) {
  const auto answer = AnswerIn(event_text);
  if (!answer) return;
  {
    const std::lock_guard lock(mutex_);
    Answers& answers = answers_.at(static_cast<std::size_t>(answer->command));
    ++answers.count;
    answers.newest = {answer->refused ? CommandOutcome::kRefused : CommandOutcome::kAccepted,
                      event_text};
  }
  answered_.notify_all();
}

}  // namespace levitas::dashboard
