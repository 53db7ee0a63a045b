#pragma once
// --require WORD: what a script asks of a result, told by an exit status of its own.
//
// stable     margins: every loop is stable at the speeds asked. run: it was completed, no trip.
// zone-b     that, and every graded sensitivity peak in zone A or B of ISO 14839-3.
// zone-a     that, and every graded sensitivity peak in zone A.
// accepted   run alone: the verdict is ACCEPTED (verdict/verdict.hpp).
// Not met    exit status 5 and one sentence, after everything else was printed and written. A
//            command that failed for another reason keeps the status of that reason.

#include <CLI/App.hpp>
#include <span>
#include <string>

#include "analysis/sensitivity.hpp"

namespace levitas::verdict {
struct Verdict;
}  // namespace levitas::verdict

namespace levitas::cli {

/// The option for `margins`, and the one for `run`, which knows `accepted` too.
void AddLoopRequirement(CLI::App& command, std::string& word);
void AddRunRequirement(CLI::App& command, std::string& word);

/// Problem with status 5 when what `word` asks is not met; an empty word asks nothing.
void RequireLoops(const std::string& word, std::span<const analysis::SensitivityResult> loops);
void RequireRun(const std::string& word, const verdict::Verdict& verdict);

}  // namespace levitas::cli
