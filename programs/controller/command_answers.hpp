#pragma once
// Answers each command of the network under its own number: what the cycle that was given it made
// of it, in the words of the event.
//
// Thread   Heard and Saw: the recorder's, in the order of the records, a record's events first.
//          Refuse: any but the loop's. given: written by the arbiter, in the loop's thread.
// Failure  a record or an answer that was lost leaves its command unanswered; it is never answered
//          by another one's outcome.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/spsc_ring.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "controller/loop/command_arbiter.hpp"
#include "session/log/session_header.hpp"
#include "transport/command_answer.hpp"

namespace levitas::controller_program {

class CommandAnswers {
 public:
  using Publish = std::function<void(const transport::CommandAnswer&)>;
  explicit CommandAnswers(Publish publish) : publish_(std::move(publish)) {}

  void Heard(const session::Event& event);
  void Saw(const cycle::CycleRecord& record);
  /// A command that no cycle was given.
  void Refuse(OperatorCommand command, const CommandOrigin& origin, std::uint64_t cycle,
              const std::string& why) const;
  [[nodiscard]] SpscRing<loop::GivenCommand>& given() noexcept { return given_; }

 private:
  static constexpr std::size_t kRoom = 256;  ///< cycles' commands that the recorder may be behind

  Publish publish_;
  SpscRing<loop::GivenCommand> given_{kRoom};
  std::optional<loop::GivenCommand> next_;
  std::string text_;  ///< the newest event about a command
};

}  // namespace levitas::controller_program
