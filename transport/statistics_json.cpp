#include "transport/statistics_json.hpp"

#include "common/output_file.hpp"
#include "levitas_version.hpp"

namespace levitas::transport {

void WriteJson(const std::string& kind, const nlohmann::ordered_json& value,
               const std::string& path) {
  nlohmann::ordered_json whole{{"schema", "levitas_" + kind + "_1"}, {"version", LEVITAS_VERSION}};
  whole.update(value);
  try {
    const FileDescriptor pipe = RefuseDeafPipe(path);
    WriteWholeFile(path, whole.dump(2) + '\n', Earlier::kReplaced);
  } catch (const Problem& problem) {  // no fault of an input: the run was done, its report is lost
    throw Problem(ExitStatus::kOther, std::string("--json ") + problem.what());
  }
}

}  // namespace levitas::transport
