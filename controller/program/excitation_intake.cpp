#include "controller/program/excitation_intake.hpp"

#include <exception>
#include <utility>

#include "config/excitation_request.hpp"

namespace levitas::controller_program {

ExcitationIntake::ExcitationIntake(const RigNumbers& rig, SpscRing<loop::RemoteCommand>& commands,
                                   std::function<void(const std::string&)> refused)
    : rig_(rig), commands_(commands), refused_(std::move(refused)) {}

void ExcitationIntake::Take(const std::string& step_yaml) {
  std::string why;
  try {
    why = Try(step_yaml);
  } catch (const std::exception& problem) {  // a stranger's text: whatever is wrong with it
    why = problem.what();
  }
  if (!why.empty()) refused_("command excite refused: " + why);
}

/// Empty when the desk has it.
std::string ExcitationIntake::Try(const std::string& step_yaml) {
  const scenario::Step step = config::ParseExcitation(step_yaml, "request", rig_);
  loop::ExcitationShelf::Place* place = shelf_.Put(step, rig_.period_s());
  if (place == nullptr) return "too many at once";
  if (commands_.Post({.command = OperatorCommand::kExcite, .excitation = place})) return {};
  loop::ExcitationShelf::GiveBack(place);
  return "too many commands at once";
}

}  // namespace levitas::controller_program
