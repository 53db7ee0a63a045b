#pragma once
// Sends an operator's command to the controller and waits for the controller's own word on it.
//
// Confirmed  by the answer that the controller publishes under the command's number and the port it
//            came from (transport/command_answer.hpp): what others ask, or a scenario does,
//            confirms nothing here. Nothing is assumed: without an answer within `patience` the
//            reply is "unanswered", and the page says so.
// Repetition the same message goes out every kRepeat until it is answered; the controller takes a
//            number once, and none below the largest (transport/operator_receiver.hpp).
// Stop       an emergency stop leaves before any lock is asked for. What was asked before it and is
//            unanswered is not repeated any more: it must not undo the stop.
// Thread     Send: any, several at once; it blocks for at most `patience`. Saw: the receiver's.
// Failure    construction throws Problem when the network cannot be reached.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/enums.hpp"
#include "transport/command_answer.hpp"
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

class Commander {
 public:
  static constexpr std::chrono::milliseconds kPatience{1500};
  static constexpr std::chrono::milliseconds kRepeat{100};

  explicit Commander(const transport::LcmNetwork& network,
                     std::chrono::milliseconds patience = kPatience);

  [[nodiscard]] CommandReply Send(const CommandRequest& request);
  /// `step_yaml`: see configuration/excitation_request.hpp.
  [[nodiscard]] CommandReply SendExcitation(const std::string& step_yaml);
  /// Every answer of the controller, to whomever.
  void Saw(const transport::CommandAnswer& answer);

 private:
  using Datagram = std::vector<std::uint8_t>;

  /// Sends what `encode(sequence)` gives until its answer is there.
  template <class Encode>
  [[nodiscard]] CommandReply Ask(OperatorCommand command, const char* channel, Encode encode);
  [[nodiscard]] CommandReply Unanswered(OperatorCommand command, bool withdrawn) const;
  void Send(const char* channel, Datagram& datagram);
  void Withdraw(std::int64_t stop);
  [[nodiscard]] bool Withdrawn(std::int64_t sequence) const noexcept {
    return sequence < newest_stop_.load();
  }
  [[nodiscard]] std::int64_t NextNumber() noexcept { return sequence_.fetch_add(1) + 1; }

  std::chrono::milliseconds patience_;
  std::mutex sending_;  ///< numbers of seals grow in the order of sending
  transport::MulticastSender sender_;
  std::atomic<std::int64_t> sequence_;
  std::atomic<std::int64_t> newest_stop_{0};  ///< its number
  std::atomic<std::uint32_t> datagrams_{0};
  std::mutex mutex_;
  std::condition_variable answered_;
  std::map<std::int64_t, std::optional<CommandReply>> waiting_;  ///< by number
};

}  // namespace levitas::dashboard
