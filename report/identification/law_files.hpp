#pragma once
// What `amb identify controller` writes beside the controller file: JSON and a picture.
// Thread   any. Failure: BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "identification/law/law_fit.hpp"

namespace levitas::report {

[[nodiscard]] nlohmann::ordered_json LawJson(const std::vector<identification::LawFit>& fits);
/// Magnitude and phase, measured and fitted, a column per controller; nothing for an empty path.
void WriteLawPicture(const std::string& path, const std::vector<identification::LawFit>& fits);

}  // namespace levitas::report
