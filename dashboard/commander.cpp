#include "dashboard/commander.hpp"

#include <fmt/core.h>

#include <levitas_msg/operator_command_t.hpp>
#include <vector>

#include "transport/lcm_packet.hpp"

namespace levitas::dashboard {
namespace {

constexpr std::string_view kPrefix = "command ";

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

CommandReply Commander::Send(const CommandRequest& request) {
  const char* channel = transport::channel::kCommand;
  levitas_msg::operator_command_t message{};
  message.command = static_cast<std::int8_t>(request.command);
  message.speed_rad_per_s = request.speed_rad_per_s;
  message.acceleration_rad_per_s2 = request.acceleration_rad_per_s2;
  const std::size_t header = transport::HeaderSize(channel);
  std::vector<std::uint8_t> datagram(header + static_cast<std::size_t>(message.getEncodedSize()));

  std::unique_lock lock(mutex_);
  message.sequence = ++sequence_;
  message.encode(datagram.data() + header, 0, message.getEncodedSize());
  Answers& answers = answers_.at(static_cast<std::size_t>(request.command));
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
                      Name(request.command), std::chrono::duration<double>(patience_).count())};
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
