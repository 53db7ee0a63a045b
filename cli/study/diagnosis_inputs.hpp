#pragma once
// Refuses records that would vouch for themselves: the same data given twice, fitted and validated
// on, or diagnosed and called healthy.
//
// Same     the same file by another path, or another file with the same bytes. A session and its
//          own CSV are known as the same by their rows (diagnosis/records/same_rows.hpp), which
//          needs them read.
// Failure  BadInput with both names.

#include <string>
#include <vector>

namespace levitas::cli {

void RefuseSameFiles(const std::vector<std::string>& data, const std::vector<std::string>& holdout,
                     const std::vector<std::string>& healthy);

}  // namespace levitas::cli
