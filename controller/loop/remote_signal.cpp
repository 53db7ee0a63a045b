#include "controller/loop/remote_signal.hpp"

#include "controller/supervisor/mode_table.hpp"

namespace levitas::loop {

void RemoteSignal::Excite(ExcitationPool::Slot* place) noexcept {
  (void)Take(place != nullptr ? SignalEvent::kCommandExcite : SignalEvent::kCommandEnd, place);
}

void RemoteSignal::End() noexcept { (void)Take(SignalEvent::kCommandEnd); }

bool RemoteSignal::AddTo(cycle::OperatorInput& input, const OperatorView& view,
                         bool run_ends) noexcept {
  if (input.command == OperatorCommand::kExcite) return false;  // it is answered in the next cycle
  bool reduced = false;
  (void)Take(view.command_refused ? SignalEvent::kRefused : SignalEvent::kAgreed);
  if (Row(state_).adds) {
    if (run_ends || !supervisor::PassesExcitation(view.mode)) {
      (void)Take(SignalEvent::kCutOff);
    } else if (!place_->AddTo(input, view)) {
      (void)Take(SignalEvent::kOver);
    } else {
      reduced = place_->reduced();
    }
  }
  if (input.command == OperatorCommand::kNone &&
      Take(SignalEvent::kFreeCycle) == SignalAction::kTellEnd) {
    input.command = OperatorCommand::kEndExcitation;
  }
  return reduced;
}

SignalAction RemoteSignal::Take(SignalEvent event, ExcitationPool::Slot* place) noexcept {
  const SignalStep step = Advance(state_, event);
  state_ = step.to;
  switch (step.action) {
    case SignalAction::kNone:
    case SignalAction::kTellEnd:
      break;
    case SignalAction::kTake:
      place_ = place;
      break;
    case SignalAction::kReplace:
      ExcitationPool::GiveBack(place_);
      place_ = place;
      break;
    case SignalAction::kGiveBack:
      ExcitationPool::GiveBack(place_);
      break;
  }
  return step.action;
}

}  // namespace levitas::loop
