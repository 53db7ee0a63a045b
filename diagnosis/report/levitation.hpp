#pragma once
// Whether the rig files that a diagnosis writes levitate under the laws of its records.
//
// Method     closed-loop poles (analysis/poles.hpp) of the file as it is written and read back, at
//            kLevitationSpeeds speeds from the slowest to the fastest of a law's records.
// Laws       each at the speeds of its own records. Where neither record nor rig file names one,
//            that is what is said.
// Said       in sentences of the report and as comments at the head of the file concerned. A file
//            that levitates has neither.
// Left out   what the file has no key for (mode shapes); what no linear loop knows (contact, the
//            end of the magnets' force); blocks of synchronous control.
// Cost       some 10 ms per law, speed and file. Thread: any.
// Failure    none: a loop that cannot be computed is said not to be judged, with the reason.

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "controller/law/law_config.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kLevitationSpeeds = 9;

/// A law, and the records that were made with it.
struct LawOfRecords {
  std::string name;  ///< and where it is from
  law::LawConfig law;
  std::vector<std::string> records;  ///< paths
  /// Of the rotor in them; at rest until one is added.
  double slowest_rad_per_s{std::numeric_limits<double>::infinity()}, fastest_rad_per_s{};

  void Add(double speed_rad_per_s) noexcept {
    slowest_rad_per_s = std::min(slowest_rad_per_s, speed_rad_per_s);
    fastest_rad_per_s = std::max(fastest_rad_per_s, speed_rad_per_s);
  }
};

struct KnownLaws {
  std::vector<LawOfRecords> laws;
  std::vector<std::string> without;  ///< records of which no law is known
};

/// Judges `report.extended_rig` and `report.calibrated_rig`, texts of rig files made from `rig`,
/// and writes `report.levitation` and the comments.
void JudgeLevitation(const config::RigFile& rig, const KnownLaws& known, DiagnosisReport& report);

}  // namespace levitas::diagnosis
