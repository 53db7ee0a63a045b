#include "dashboard/spectrum_range.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "dashboard/request_fields.hpp"

namespace levitas::dashboard {

HttpAnswer SpectrumRange::Ask(const std::string& body) {
  try {
    const nlohmann::json request = ParseRequest(body);
    RefuseUnknownKeys(request, {"highest_hz"});
    highest_hz_.store(NumberIn(request, "highest_hz", kLeastHz, kMostHz));
  } catch (const std::invalid_argument& problem) {
    return Answer(kHttpBadRequest, "not understood", problem.what());
  }
  return Answer(kHttpOk, "accepted", fmt::format("spectra up to {:g} Hz", highest_hz()));
}

}  // namespace levitas::dashboard
