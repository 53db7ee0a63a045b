#include "transport/statistics_json.hpp"

#include "common/output_file.hpp"

namespace levitas::transport {

void WriteJson(const nlohmann::ordered_json& value, const std::string& path) {
  try {
    const FileDescriptor pipe = RefuseDeafPipe(path);
    WriteWholeFile(path, value.dump(2) + '\n');
  } catch (const Problem& problem) {  // no fault of an input: the run was done, its report is lost
    throw Problem(ExitStatus::kOther, std::string("--json ") + problem.what());
  }
}

}  // namespace levitas::transport
