#pragma once
// --svg FILE of the commands that draw a rig or its loop.
//
// Failure  as of --json: refused before anything is computed when the file cannot be written, or is
//          one that is read (output_clash.hpp; here of the controller file that a rig file names).

#include <CLI/App.hpp>
#include <string>

#include "session/log/output_path.hpp"

namespace levitas::cli {

/// `what` is drawn.
inline void AddSvgOption(CLI::App& command, std::string& path, const std::string& what) {
  command.add_option("--svg", path, "Also draw it into this file: " + what);
}

/// Of the controller that was found.
inline void KeepController(const std::string& svg_path, const std::string& controller_path) {
  session::RefuseClash({{"--svg", svg_path}}, {{"the controller file", controller_path}});
}

}  // namespace levitas::cli
