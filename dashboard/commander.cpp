#include "dashboard/commander.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <future>
#include <iterator>
#include <levitas_msg/challenge_t.hpp>
#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <memory>
#include <utility>

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
      identity_(sender_.identity()),
      // A later start on this machine never repeats the numbers of an earlier one, whatever its
      // clock of the day is set to; starts on different machines have seals of their own.
      sequence_(
          std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch())
              .count()),
      repeater_([this] { RepeatStops(); }) {}

Commander::~Commander() {
  {
    const std::lock_guard lock(stops_mutex_);
    ending_ = true;
  }
  stops_changed_.notify_all();
  repeater_.join();
}

void Commander::Send(const char* channel, Datagram& datagram) {
  const std::lock_guard lock(sending_);  // for the length of a system call
  transport::WriteHeader(datagram, datagrams_.fetch_add(1), channel);
  sender_.Send(datagram);
}

template <class Encode>
CommandReply Commander::Ask(OperatorCommand command, const char* channel, Encode encode) {
  Datagram datagram(transport::HeaderSize(channel));
  std::unique_lock lock(mutex_);
  // Under the lock in which it is sent first: what leaves later has the larger number.
  const std::int64_t sequence = NextNumber();
  encode(datagram, sequence);
  const auto mine = waiting_.emplace(sequence, std::nullopt).first;
  const auto settled = [&] { return mine->second || Withdrawn(sequence); };
  const auto end = Clock::now() + patience_;
  while (!settled() && Clock::now() < end) {
    const bool sent = MayBeTaken();
    if (sent) Send(channel, datagram);
    answered_.wait_for(lock, kRepeat, [&] { return settled() || (!sent && MayBeTaken()); });
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

bool Commander::MayBeTaken() const {
  return identity_ == 0 || (challenged_ && Clock::now() - *challenged_ < kChallengeServes);
}

std::int64_t Commander::SendStop() {
  levitas_msg::operator_command_t message{};
  message.command = static_cast<std::int8_t>(OperatorCommand::kEmergencyStop);
  message.sequence = NextNumber();
  Datagram datagram(transport::HeaderSize(transport::channel::kCommand));
  Append(message, datagram);
  Send(transport::channel::kCommand, datagram);
  Withdraw(message.sequence);
  return message.sequence;
}

void Commander::Stop(Told told) {
  const std::int64_t sequence = SendStop();
  {
    const std::lock_guard lock(stops_mutex_);
    stops_.push_back({sequence, Clock::now() + patience_, std::move(told)});
  }
  stops_changed_.notify_all();
}

// Until the end all that wait are told, the last of them that nobody answered.
void Commander::RepeatStops() {
  std::unique_lock lock(stops_mutex_);
  while (!ending_ || !stops_.empty()) {
    if (stops_.empty()) {
      stops_changed_.wait(lock, [this] { return ending_ || !stops_.empty(); });
      continue;
    }
    stops_changed_.wait_for(lock, kRepeat, [this] { return ending_ || stops_.empty(); });
    const auto over = std::partition(stops_.begin(), stops_.end(), [this](const WaitingStop& one) {
      return !ending_ && Clock::now() < one.end;
    });
    std::vector<WaitingStop> unanswered(std::make_move_iterator(over),
                                        std::make_move_iterator(stops_.end()));
    stops_.erase(over, stops_.end());
    const bool again = !stops_.empty();
    lock.unlock();
    for (const WaitingStop& one : unanswered) {
      one.told(Unanswered(OperatorCommand::kEmergencyStop, false));
    }
    if (again) (void)SendStop();
    lock.lock();
  }
}

// Whoever asked before the stop that is answered is answered with it: the trip is the same.
void Commander::SawOfStop(const transport::CommandAnswer& answer) {
  std::vector<WaitingStop> told;
  {
    const std::lock_guard lock(stops_mutex_);
    const auto answered = std::partition(stops_.begin(), stops_.end(), [&](const WaitingStop& one) {
      return one.sequence > answer.sequence;
    });
    told.assign(std::make_move_iterator(answered), std::make_move_iterator(stops_.end()));
    stops_.erase(answered, stops_.end());
  }
  const CommandReply reply{answer.refused ? CommandOutcome::kRefused : CommandOutcome::kAccepted,
                           answer.text};
  for (const WaitingStop& one : told) one.told(reply);
  stops_changed_.notify_all();
}

void Commander::SayHello() {
  if (identity_ == 0) return;
  Datagram datagram(transport::HeaderSize(transport::channel::kHello));
  levitas_msg::challenge_t message{};
  message.asked_by = static_cast<std::int64_t>(identity_);
  Append(message, datagram);
  Send(transport::channel::kHello, datagram);
}

bool Commander::Asked(const transport::Challenge& challenge) const noexcept {
  return identity_ != 0 && challenge.asked_by == identity_;
}

void Commander::Heard(const transport::Challenge& challenge) {
  {
    const std::lock_guard lock(sending_);
    sender_.AnswerChallenge(challenge.value);
  }
  {
    const std::lock_guard lock(mutex_);
    challenged_ = Clock::now();
  }
  answered_.notify_all();
}

CommandReply Commander::Send(const CommandRequest& request) {
  if (request.command == OperatorCommand::kEmergencyStop) {
    auto reply = std::make_shared<std::promise<CommandReply>>();
    Stop([reply](const CommandReply& told) { reply->set_value(told); });
    return reply->get_future().get();
  }
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
  if (answer.command == OperatorCommand::kEmergencyStop) return SawOfStop(answer);
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
