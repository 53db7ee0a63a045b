#include "controller/supervisor/mode_table.hpp"

namespace levitas::supervisor {
namespace {

template <class Enum, std::size_t kCount>
std::string_view Lookup(const std::array<std::string_view, kCount>& names, Enum value) noexcept {
  const auto index = static_cast<std::size_t>(value);
  return index < kCount ? names[index] : "invalid";
}

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

std::string Line(std::initializer_list<std::string_view> cells) {
  std::string text = "|";
  for (const std::string_view cell : cells) text.append(" ").append(cell).append(" |");
  return text + "\n";
}

std::string StateDiagram() {
  std::string text = "```mermaid\nstateDiagram-v2\n  [*] --> off\n";
  for (const Edge& edge : kEdges) {
    text.append("  ").append(Name(edge.from)).append(" --> ").append(Name(edge.to));
    text.append(" : ").append(Name(edge.event));
    if (edge.guard != Guard::kAlways) text.append(" [").append(Name(edge.guard)).append("]");
    text += "\n";
  }
  return text + "```\n";
}

}  // namespace

std::string_view Name(State state) noexcept { return Lookup(kStateNames, state); }
std::string_view Name(Event event) noexcept { return Lookup(kEventNames, event); }
std::string_view Name(Guard guard) noexcept { return Lookup(kGuardNames, guard); }
std::string_view Name(Action action) noexcept { return Lookup(kActionNames, action); }
std::string_view Name(Reference reference) noexcept { return Lookup(kReferenceNames, reference); }
std::string_view Name(Drive drive) noexcept { return Lookup(kDriveNames, drive); }

std::string ModeTableDocument() {
  std::string text =
      "## Modes\n\n"
      "Written from the mode table in `controller/supervisor/mode_table.hpp`; a test compares the "
      "two. `LEVITAS_WRITE_DOCS=1` makes that test write this chapter anew.\n\n"
      "A command without an edge here is refused; `excite` changes no state and is refused where "
      "the "
      "excitation is not passed on, `end_excitation` never. An emergency stop is a stop fault, "
      "whether an "
      "operator asks for it or the rig's own chain opens.\n\n### Diagram\n\n";
  text += StateDiagram();
  text += "\n### States\n\n";
  text += Line({"state", "mode shown", "magnets", "reference", "drive", "excitation", "stop faults",
                "drop faults"});
  text += "|---|---|---|---|---|---|---|---|\n";
  for (const StateRow& row : kStates) {
    text += Line({Name(row.state), levitas::Name(row.mode),
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
  text += Line({"from", "event", "only if", "to", "action"});
  text += "|---|---|---|---|---|\n";
  for (const Edge& edge : kEdges) {
    text += Line(
        {Name(edge.from), Name(edge.event), Name(edge.guard), Name(edge.to), Name(edge.action)});
  }
  return text;
}

}  // namespace levitas::supervisor
