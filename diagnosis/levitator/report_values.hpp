#pragma once
// Parameters and calibrated values of a levitator's diagnosis under the keys and in the units of
// the rig file, where it has a key for them: factors on the file's number, micrometres, bandwidths.
//
// Sum     a fit is made relative to an origin (origin.hpp); values are those of both together, as a
//         rig file would have them.
// Thread  any; pure.

#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/levitator/search.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::levitator {

/// Of the causes, in the order of selection.
[[nodiscard]] std::vector<diagnosis::NamedParameter> ReportParameters(
    const configuration::RigFile& rig, const Theta& origin, const Found& found);
/// Of all parameters with a tolerance that are no cause; furthest out of the tolerance first.
[[nodiscard]] std::vector<diagnosis::CalibratedValue> ReportCalibration(
    const configuration::RigFile& rig, const Theta& origin, const Found& found);

}  // namespace levitas::levitator
