#pragma once
// A design file: the weights that a law is made with, and those that it is judged by.
//
// Kind     design. Keys, units, defaults: as hinf_weights.hpp and analysis_weights.hpp; a group or
//          a key that is left out means the default.
// Failure  BadInput with every problem of the file: file, line, key, found, allowed.
// Thread   any.

#include <string>

#include "design/hinf/hinf_weights.hpp"
#include "design/uncertainty/analysis_weights.hpp"

namespace levitas::design {

struct DesignFile {
  hinf::HinfWeights synthesis;
  uncertainty::AnalysisWeights analysis;
};

[[nodiscard]] DesignFile LoadDesign(const std::string& path);
[[nodiscard]] DesignFile ParseDesign(const std::string& text, const std::string& file_name);

/// Complete YAML text, every default written out; parsing it gives the same values bit for bit.
[[nodiscard]] std::string WriteDesign(const DesignFile& file);

}  // namespace levitas::design
