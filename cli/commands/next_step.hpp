#pragma once
// What to type after a run that its verdict did not accept.
//
// Said     where |S| or an orbit was too large: the commands that show the loop and make a law for
//          the rig; of a run with test signals, what its record is for.
// Thread   any. Failure: none.

#include <string>

namespace levitas::verdict {
struct Verdict;
}

namespace levitas::cli {

/// One line without its end; empty where there is nothing to advise. `rig_name` as a command takes
/// it; `record` the kept session, or empty.
[[nodiscard]] std::string NextStep(const verdict::Verdict& verdict, const std::string& rig_name,
                                   const std::string& record);

}  // namespace levitas::cli
