#pragma once
// Sends an operator's command to the controller and waits for the controller's own word on it.
//
// Confirmed  by the answer that the controller publishes under the command's number and the port it
//            came from (transport/command_answer.hpp): what others ask, or a scenario does,
//            confirms nothing here. Nothing is assumed: without an answer within `patience` the
//            reply is "unanswered", and the page says so.
// Repetition the same message goes out every kRepeat until it is answered; the controller takes a
//            number once, and none below the largest (transport/operator_receiver.hpp).
// Stop       an emergency stop leaves in the thread that asks for it, before any lock but that of
//            the socket; however many wait for their answers, one thread of ours says the newest
//            again. An answer to it answers those before it. What was asked before a stop and is
//            unanswered is not repeated any more: it must not undo the stop.
// Key        on a network with one a command carries the controller's newest challenge, for which
//            SayHello asks; a stop needs none (transport/seal.hpp).
// Thread     Send: any, several at once; it blocks for at most `patience`. Stop: any, it does not
//            wait; `told` is called once in another thread, or before the destructor returns. Saw,
//            Heard and SayHello: the receiver's.
// Failure    construction throws Problem when the network cannot be reached.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/enums.hpp"
#include "transport/command_answer.hpp"
#include "transport/multicast_socket.hpp"
#include "transport/operator_message.hpp"

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
  using Clock = std::chrono::steady_clock;
  using Told = std::function<void(const CommandReply&)>;
  static constexpr std::chrono::milliseconds kPatience{1500};
  static constexpr std::chrono::milliseconds kRepeat{100};
  /// Of a challenge; the controller takes it for half a second longer (transport/seal.hpp).
  static constexpr std::chrono::milliseconds kChallengeServes{2000};

  explicit Commander(const transport::LcmNetwork& network,
                     std::chrono::milliseconds patience = kPatience);
  ~Commander();
  Commander(const Commander&) = delete;
  Commander& operator=(const Commander&) = delete;

  /// A stop as well, for those who have the time.
  [[nodiscard]] CommandReply Send(const CommandRequest& request);
  /// Sends an emergency stop; `told` hears what became of it.
  void Stop(Told told);
  /// `step_yaml`: see configuration/excitation_request.hpp.
  [[nodiscard]] CommandReply SendExcitation(const std::string& step_yaml);
  /// Every answer of the controller, to whomever.
  void Saw(const transport::CommandAnswer& answer);

  /// Asks for a challenge; nothing without a key.
  void SayHello();
  /// Whether this one answers our own question, which no record can.
  [[nodiscard]] bool Asked(const transport::Challenge& challenge) const noexcept;
  /// A challenge of the controller that we listen to, to whomever.
  void Heard(const transport::Challenge& challenge);

 private:
  using Datagram = std::vector<std::uint8_t>;
  struct WaitingStop {
    std::int64_t sequence{};  ///< of its first message
    Clock::time_point end;
    Told told;
  };

  /// Sends what `encode(sequence)` gives until its answer is there.
  template <class Encode>
  [[nodiscard]] CommandReply Ask(OperatorCommand command, const char* channel, Encode encode);
  [[nodiscard]] CommandReply Unanswered(OperatorCommand command, bool withdrawn) const;
  void Send(const char* channel, Datagram& datagram);
  /// Sends one more emergency stop; its number.
  std::int64_t SendStop();
  void RepeatStops();
  void SawOfStop(const transport::CommandAnswer& answer);
  /// False while a key is asked for and no fresh challenge is there.
  [[nodiscard]] bool MayBeTaken() const;
  void Withdraw(std::int64_t stop);
  [[nodiscard]] bool Withdrawn(std::int64_t sequence) const noexcept {
    return sequence < newest_stop_.load();
  }
  [[nodiscard]] std::int64_t NextNumber() noexcept { return sequence_.fetch_add(1) + 1; }

  std::chrono::milliseconds patience_;
  std::mutex sending_;  ///< numbers of seals grow in the order of sending
  transport::MulticastSender sender_;
  const std::uint64_t identity_;  ///< 0: no key
  std::atomic<std::int64_t> sequence_;
  std::atomic<std::int64_t> newest_stop_{0};  ///< its number
  std::atomic<std::uint32_t> datagrams_{0};
  std::mutex mutex_;
  std::condition_variable answered_;
  std::map<std::int64_t, std::optional<CommandReply>> waiting_;  ///< by number
  std::optional<Clock::time_point> challenged_;                  ///< the newest came

  std::mutex stops_mutex_;
  std::condition_variable stops_changed_;
  std::vector<WaitingStop> stops_;
  bool ending_{false};
  std::thread repeater_;
};

}  // namespace levitas::dashboard
