#pragma once
// Options shared by the analysis commands: files by path or shipped name, speeds in rpm.

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::cli {

struct AnalysisOptions {
  std::string rig_name{"flexible_rotor"};
  std::string rig_named;  ///< by --rig of a command that reads records; see rig_of_records.hpp
  std::string controller_name;  ///< empty: the one that the rig names, else flexible_rotor
  std::string port{"lcm"};      ///< whose delay counts; see TakeDelayOfPort
  std::vector<double> speeds_rpm;
  std::string json_path;
};

void AddRigOption(CLI::App& command, AnalysisOptions& options);
void AddControllerOption(CLI::App& command, AnalysisOptions& options);
/// `default_rpm` are the speeds when none is given.
void AddSpeedOption(CLI::App& command, AnalysisOptions& options, std::vector<double> default_rpm);
void AddJsonOption(CLI::App& command, AnalysisOptions& options);

[[nodiscard]] configuration::RigFile LoadRig(const AnalysisOptions& options);
void AddPortOption(CLI::App& command, AnalysisOptions& options);
/// Gives the rig the delay from sample to current of the port, as `amb run --port` has it: the rig
/// file's with LCM, that of its buses with CAN where it is longer. Returns the line that says so,
/// and what the other one would be. Failure: see socketcan::PlanConnection.
[[nodiscard]] std::string TakeDelayOfPort(const AnalysisOptions& options,
                                          configuration::RigFile& rig);
/// A controller and where it was read from.
struct FoundController {
  std::string path;
  configuration::ControllerFile file;
  std::string notes;  ///< notches that stand elsewhere than given; poles that do not decay
};
[[nodiscard]] FoundController LoadController(const AnalysisOptions& options,
                                             const configuration::RigFile& rig);
/// What a command on the closed loop works with.
struct AnalysedLoop {
  configuration::RigFile rig;  ///< with the delay of the port
  FoundController controller;
  std::string delay;  ///< what TakeDelayOfPort says
};
[[nodiscard]] AnalysedLoop LoadLoop(const AnalysisOptions& options);
/// "name (file)", and a line for each notch that stands more than 1 % from the frequency given and
/// for what configuration::LawNotes says.
[[nodiscard]] std::string ControllerText(const FoundController& controller);
/// Says so when it is not the one that `amb run` would take; else empty.
[[nodiscard]] std::string GainsNote(const AnalysisOptions& options,
                                    const configuration::RigFile& rig);
/// Says so when a rotor that turns was looked at standing alone; else empty.
[[nodiscard]] std::string RestNote(const AnalysisOptions& options, const RigNumbers& rig);

}  // namespace levitas::cli
