#pragma once
// Lines of the mains, 50 and 60 Hz and their harmonics, that stand out of their neighbourhood, and
// those that the rig file knows of.
//
// Where      in the readings, and in what a fast observer of the nominal model leaves of them: a
//            test signal hides in the readings what is a tenth of it.
// Line       kTimes the mean power of six neighbouring lines, Hann window over the whole record.
// Thread     blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

[[nodiscard]] std::vector<double> MainsLines(const RigView& rig,
                                             const std::vector<Record>& records);

}  // namespace levitas::diagnosis
