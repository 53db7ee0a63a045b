#pragma once
// The report of a session as one HTML page that needs nothing beside it: no network, no other file.
// Every picture is inside, as SVG with a caption that a screen reader reads. It opens with the
// verdict as tables.
//
// Script   of the page itself: cursor and zoom of the pictures (page_parts.hpp). Without it nothing
//          else is missing.
// Colours  Okabe & Ito (2008); no meaning rests on a colour alone.
// Thread   any. Failure: none; text of the session is escaped.

#include <optional>
#include <string>
#include <vector>

#include "analysis/critical_speeds.hpp"
#include "report/session/pictures.hpp"
#include "report/session/recording.hpp"
#include "verdict/verdict.hpp"

namespace levitas::report {

struct PageInput {
  std::string session_path;
  std::vector<NamedPicture> pictures;
  std::optional<verdict::Verdict> verdict;          ///< absent: the record names no controller
  std::optional<analysis::Campbell> levitated;      ///< with it the critical speeds
  std::vector<verdict::DurationFigures> durations;  ///< of the loop, as the run reported them
};

[[nodiscard]] std::string Page(const Recording& recording, const PageInput& input);

}  // namespace levitas::report
