#include "programs/controller/command_answers.hpp"

namespace levitas::controller_program {

void CommandAnswers::Heard(const session::Event& event) {
  if (event.text.starts_with("command ")) text_ = event.text;
}

void CommandAnswers::Saw(const cycle::CycleRecord& record) {
  if (record.in.op.command == OperatorCommand::kNone) return;
  for (;;) {
    loop::GivenCommand taken;
    if (!next_ && given_.Take(taken)) next_ = taken;
    if (!next_ || next_->cycle > record.in.cycle) return;
    if (next_->cycle == record.in.cycle) {
      transport::CommandAnswer answer{.command = record.in.op.command,
                                      .refused = record.out.command_refused,
                                      .cycle = record.in.cycle,
                                      .text = text_};
      transport::SetSender(answer, next_->origin);
      publish_(answer);
    }
    next_.reset();
  }
}

void CommandAnswers::Refuse(OperatorCommand command, const CommandOrigin& origin,
                            std::uint64_t cycle, const std::string& why) const {
  transport::CommandAnswer answer{.command = command, .refused = true, .cycle = cycle, .text = why};
  transport::SetSender(answer, origin);
  publish_(answer);
}

}  // namespace levitas::controller_program
