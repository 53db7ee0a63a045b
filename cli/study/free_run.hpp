#pragma once
// amb simulate --free-run: model and law in closed loop beside the record, as text, JSON, CSV and a
// picture. What is computed: analysis/records/free_run.hpp.
//
// Failure  BadInput, one sentence: a record that names no law when none is given, one without a
//          test signal; a file that cannot be written. An empty path writes nothing.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "analysis/records/free_run.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::cli {

struct FreeRunContext {
  const RigNumbers& rig;
  const session::Recording& recording;
  const analysis::FreeRun& run;
  std::string law;  ///< name, and where it is from
};

/// A controller and where it is from: "name (path)" or "name (of the session)".
struct ControllerOfRecord {
  std::string name;
  configuration::ControllerFile file;
};

/// That of the option `controller_name`, else of the session; none in other records.
[[nodiscard]] std::optional<ControllerOfRecord> ControllerIfKnown(
    const std::string& record_path, const std::string& controller_name,
    const configuration::RigFile& rig);

struct LawOfRecord {
  std::string name;
  law::LawConfig law;
};

/// The law of `controller_name`, a file or shipped name, else that of the session; nothing where
/// the record names none.
[[nodiscard]] std::optional<LawOfRecord> LawIfKnown(const std::string& record_path,
                                                    const std::string& controller_name,
                                                    const configuration::RigFile& rig);
/// The same, refusing a record that names none.
[[nodiscard]] LawOfRecord FindLaw(const std::string& record_path,
                                  const std::string& controller_name,
                                  const configuration::RigFile& rig);

void PrintFreeRun(const FreeRunContext& context);
[[nodiscard]] nlohmann::ordered_json FreeRunJson(const FreeRunContext& context);
/// time_s, speed_rpm, then measured_<channel>_m and model_<channel>_m of every channel.
void WriteFreeRunCsv(const std::string& path, const FreeRunContext& context);
/// For each excited axis its first segment: that axis, and the one beside it that moves most.
void WriteFreeRunSvg(const std::string& path, const FreeRunContext& context);

}  // namespace levitas::cli
