#include "controller/loop/arbiter_document.hpp"

#include <array>
#include <string_view>

#include "common/state_table_text.hpp"
#include "controller/loop/end_table.hpp"
#include "controller/loop/signal_table.hpp"

namespace levitas::loop {
namespace {

constexpr std::array<std::string_view, kEndStateCount> kEndStateNames{
    "serving", "ending", "braking", "awaiting_standstill", "done"};
constexpr std::array<std::string_view, kEndEventCount> kEndEventNames{
    "scenario_over", "duration_over", "stop_requested", "released", "held",  "stops",
    "overdue",       "lands",         "stands",         "spins",    "turns", "brake_fails"};
constexpr std::array<std::string_view, kEndGuardCount> kEndGuardNames{"always", "request_due",
                                                                      "recorded"};
constexpr std::array<std::string_view, kEndActionCount> kEndActionNames{
    "none", "begin", "ask_brake", "ask_landing", "ask_stop", "time_release"};
constexpr std::array<std::string_view, kEndWatchCount> kEndWatchNames{"nothing", "landing",
                                                                      "brake"};
constexpr std::array<std::string_view, kSignalStateCount> kSignalStateNames{
    "none", "asked", "playing", "ended_untold"};
constexpr std::array<std::string_view, kSignalEventCount> kSignalEventNames{
    "command_excite", "command_end", "refused", "agreed", "cut_off", "over", "free_cycle"};
constexpr std::array<std::string_view, kSignalActionCount> kSignalActionNames{
    "none", "take", "replace", "give_back", "tell_end"};

std::string EndStateRows() {
  std::string text = MarkdownRow({"state", "remote commands and scenario", "looked for"});
  text += MarkdownRule(3);
  for (const EndRow& row : kEndStates) {
    text += MarkdownRow({Name(row.state), row.serves ? "given" : "dropped", Name(row.watch)});
  }
  return text;
}

std::string SignalStateRows() {
  std::string text = MarkdownRow({"state", "place in the pool", "currents and positions"});
  text += MarkdownRule(3);
  for (const SignalRow& row : kSignalStates) {
    text += MarkdownRow(
        {Name(row.state), row.holds_place ? "held" : "free", row.adds ? "added" : "unchanged"});
  }
  return text;
}

}  // namespace

std::string_view Name(EndState state) noexcept { return NameIn(kEndStateNames, state); }
std::string_view Name(EndEvent event) noexcept { return NameIn(kEndEventNames, event); }
std::string_view Name(EndGuard guard) noexcept { return NameIn(kEndGuardNames, guard); }
std::string_view Name(EndAction action) noexcept { return NameIn(kEndActionNames, action); }
std::string_view Name(EndWatch watch) noexcept { return NameIn(kEndWatchNames, watch); }
std::string_view Name(SignalState state) noexcept { return NameIn(kSignalStateNames, state); }
std::string_view Name(SignalEvent event) noexcept { return NameIn(kSignalEventNames, event); }
std::string_view Name(SignalAction action) noexcept { return NameIn(kSignalActionNames, action); }

std::string ArbiterDocument() {
  std::string text =
      "## Commands and the end of a run\n\n"
      "Written from `controller/loop/end_table.hpp` and `controller/loop/signal_table.hpp`; a test "
      "compares them. `LEVITAS_WRITE_DOCS=1` makes that test write this chapter anew.\n\n"
      "Each cycle has one command. An emergency stop is given before everything, in every state; "
      "then comes the end of the run, then a remote command, then the scenario.\n\n"
      "### The end of a run\n\n"
      "A cycle asks whether the run is to end, whether the magnets hold the rotor, and what the "
      "rotor does; each answer is an event. A rotor that is held `stops` (a levitated stop, which "
      "lands by itself), is `overdue`, `lands`, `stands`, `spins` (under the drive) or `turns` (in "
      "another mode); the first that holds counts. Requests that are not followed are made again "
      "after 0.1 s. A landing is overdue, and a brake fails, as described "
      "[above](#what-comes-from-outside); what is found of what is looked for is said once.\n\n";
  text += StateDiagram(EndState::kServing, kEndEdges);
  text.append("\n").append(EndStateRows()).append("\n").append(EdgeRows(kEndEdges));
  text +=
      "\n### A test signal of the network\n\n"
      "It begins in the cycle after its command, so that a refusal comes before its first current; "
      "an end that nobody commanded is written into the record as the command of a cycle that has "
      "no other.\n\n";
  text += StateDiagram(SignalState::kNone, kSignalEdges);
  text.append("\n").append(SignalStateRows()).append("\n").append(EdgeRows(kSignalEdges));
  return text + "\n";
}

}  // namespace levitas::loop
