#include "doctor/finding.hpp"

#include <algorithm>

namespace levitas::doctor {

State Worst(const std::vector<Finding>& findings, Area area) noexcept {
  State worst = State::kOk;
  for (const Finding& finding : findings) {
    if (finding.area == area) worst = std::max(worst, finding.state);
  }
  return worst;
}

std::vector<std::string> ChecksIn(const std::vector<Finding>& findings, Area area, State state) {
  std::vector<std::string> names;
  for (const Finding& finding : findings) {
    if (finding.area == area && finding.state == state) names.push_back(finding.check);
  }
  return names;
}

bool FitForLockstep(const std::vector<Finding>& findings) noexcept {
  return Worst(findings, Area::kLcm) != State::kMissing &&
         Worst(findings, Area::kStorage) != State::kMissing;
}

}  // namespace levitas::doctor
