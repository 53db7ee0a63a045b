#pragma once
// What to type after a run.
//
// Said     of a run with test signals, what its record is for, whatever its verdict; where a run is
//          not accepted for |S| or an orbit, the commands that show the loop as it was run and make
//          a law for the rig, under a file name that is free.
// Silent   after a run with another bias current than the file's or with added effects: the file's
//          loop is another one.
// Thread   any. Failure: none.

#include <string>

namespace levitas::verdict {
struct Verdict;
}

namespace levitas::cli {

/// The run as it was asked for, in words that a command takes.
struct RunAsAsked {
  std::string rig{};
  std::string controller{};  ///< empty: the rig's own
  std::string record{};      ///< the kept session, or empty
  bool other_rig{};          ///< another bias current, or effects added
};

/// One line without its end; empty where there is nothing to advise.
[[nodiscard]] std::string NextStep(const verdict::Verdict& verdict, const RunAsAsked& run);

}  // namespace levitas::cli
