#include "controller/supervisor/mode_table.hpp"

#include "common/state_table_text.hpp"

namespace levitas::supervisor {
namespace {

constexpr std::array<std::string_view, kStateCount> kStateNames{"off",
                                                                "self_test",
                                                                "lift",
                                                                "levitating",
                                                                "spinning",
                                                                "coast_down",
                                                                "landing",
                                                                "tripped_stopping",
                                                                "tripped_landing",
                                                                "tripped_released"};
constexpr std::array<std::string_view, kEventCount> kEventNames{
    "command_lift", "command_spin",  "command_coast_down",
    "command_land", "command_reset", "self_test_passed",
    "lifted",       "stands",        "landed",
    "turns",        "stop_fault",    "drop_fault"};
constexpr std::array<std::string_view, 5> kGuardNames{"always", "standing", "not_turning",
                                                      "speed_valid", "cause_gone"};
constexpr std::array<std::string_view, 5> kActionNames{"none", "start_law", "take_speed", "latch",
                                                       "clear_latch"};
constexpr std::array<std::string_view, 4> kReferenceNames{"none", "ramp_to_centre", "centre",
                                                          "ramp_to_rest"};
constexpr std::array<std::string_view, 3> kDriveNames{"free", "set_point", "brake"};

std::string FaultNames(FaultSet faults) {
  std::string text;
  for (std::uint8_t i = 1; i < kFaultCount; ++i) {
    if ((faults & Bit(static_cast<Fault>(i))) == 0) continue;
    if (!text.empty()) text += ", ";
    text += levitas::Name(static_cast<Fault>(i));
  }
  return text.empty() ? "none" : text;
}

}  // namespace

std::string_view Name(State state) noexcept { return NameIn(kStateNames, state); }
std::string_view Name(Event event) noexcept { return NameIn(kEventNames, event); }
std::string_view Name(Guard guard) noexcept { return NameIn(kGuardNames, guard); }
std::string_view Name(Action action) noexcept { return NameIn(kActionNames, action); }
std::string_view Name(Reference reference) noexcept { return NameIn(kReferenceNames, reference); }
std::string_view Name(Drive drive) noexcept { return NameIn(kDriveNames, drive); }

std::string ModeTableDocument() {
  std::string text =
      "## Modes\n\n"
      "Written from the mode table in `controller/supervisor/mode_table.hpp`; a test compares the "
      "two. `LEVITAS_WRITE_DOCS=1` makes that test write this chapter anew.\n\n"
      "A command without an edge here is refused; `excite` changes no state and is refused where "
      "the "
      "excitation is not passed on, `end_excitation` and `mark` never. An emergency stop is a stop "
      "fault, "
      "whether an "
      "operator asks for it or the rig's own chain opens.\n\n### Diagram\n\n";
  text += StateDiagram(State::kOff, kEdges);
  text += "\n### States\n\n";
  text += MarkdownRow({"state", "mode shown", "magnets", "reference", "drive", "excitation",
                       "stop faults", "drop faults"});
  text += MarkdownRule(8);
  for (const StateRow& row : kStates) {
    text += MarkdownRow({Name(row.state), levitas::Name(row.mode),
                         row.energised ? "bias and law" : "no current", Name(row.reference),
                         Name(row.drive), row.excitation ? "passed on" : "none",
                         FaultNames(row.armed & ~row.drop), FaultNames(row.armed & row.drop)});
  }
  text +=
      "\nA fault that is not listed in a state is not looked for in it. orbit_exceeded as a drop "
      "fault means that the rotor stays beyond the whole clearance (tripped_stopping) or away from "
      "where it is being lowered (tripped_landing). A rotor that turns in landing has an unknown "
      "speed; under the drive's brake in off is only a rotor that is seen to turn.\n";
  text += "\n### Edges\n\n";
  text += EdgeRows(kEdges);
  return text;
}

}  // namespace levitas::supervisor
