#pragma once
// Refuses a record that holds rows of another one, whatever file they came from: a session and its
// CSV, a compressed copy, a piece that was cut out.
//
// Same     a run of kRun rows with the same positions and currents, to single precision. Runs in
//          which nothing moves are alike by themselves and do not count. More than kShare of them:
//          the same data.
// Failure  BadInput with both names. Thread: any; pure.

#include <string>
#include <vector>

#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

/// `option` and `remedy` appear in the message.
void RefuseSameRows(const std::vector<Record>& data, const std::vector<Record>& others,
                    const std::string& option, const std::string& remedy);

}  // namespace levitas::diagnosis
