#pragma once
// Sends an operator's command to the controller and waits for the controller's own word on it.
//
// Confirmed  by the event that the controller publishes for each command it takes ("command lift
//            ..." or "... refused in mode ..."). Nothing is assumed: without that event within
//            `patience` the reply is "unanswered", and the page says so. Repetition the same
//            message goes out every kRepeat until it is answered; the controller takes a sequence
//            number once (transport/operator_receiver.hpp).
// Thread     Send: any, several at once; it blocks for at most `patience`. Saw: the receiver's.
// Failure    construction throws Problem when the network cannot be reached.

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "common/enums.hpp"
#include "transport/multicast_socket.hpp"

namespace levitas::dashboard {

struct CommandRequest {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};
  double acceleration_rad_per_s2{};
};

enum class CommandOutcome : std::uint8_t { kAccepted, kRefused, kUnanswered };

struct CommandReply {
  CommandOutcome outcome{CommandOutcome::kUnanswered};
  std::string text;  ///< the controller's sentence, or what to look at
};

/// What an event's text says about a command; nothing when it is about something else.
struct CommandAnswer {
  OperatorCommand command{};
  bool refused{};
};
[[nodiscard]] std::optional<CommandAnswer> AnswerIn(const std::string& event_text);

class Commander {
 public:
  static constexpr std::chrono::milliseconds kPatience{1500};
  static constexpr std::chrono::milliseconds kRepeat{100};

  explicit Commander(const transport::LcmNetwork& network,
                     std::chrono::milliseconds patience = kPatience);

  [[nodiscard]] CommandReply Send(const CommandRequest& request);
  /// `step_yaml`: see config/excitation_request.hpp.
  [[nodiscard]] CommandReply SendExcitation(const std::string& step_yaml);
  /// Text of every event of the controller.
  void Saw(const std::string& event_text);

 private:
  struct Answers {
    std::uint64_t count{0};
    CommandReply newest;
  };

  /// Sends what `encode(sequence)` gives until an answer to `command` is there.
  template <class Encode>
  [[nodiscard]] CommandReply Ask(OperatorCommand command, const char* channel, Encode encode);

  std::chrono::milliseconds patience_;
  std::mutex mutex_;
  std::condition_variable answered_;
  transport::MulticastSender sender_;
  std::int64_t sequence_;
  std::uint32_t datagrams_{0};
  std::array<Answers, kOperatorCommandCount> answers_;
};

}  // namespace levitas::dashboard
