#include "transport/statistics_json.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "common/problem.hpp"

namespace levitas::transport {

void WriteJson(const nlohmann::ordered_json& value, const std::string& path) {
  std::ofstream file(path);
  file << value.dump(2) << '\n';
  file.flush();
  if (!file) {
    throw Problem(ExitStatus::kOther,
                  "--json " + path + ": cannot be written: " + std::strerror(errno));
  }
}

}  // namespace levitas::transport
