#include "cli/commands/what_if_csv.hpp"

#include <fmt/core.h>

#include "session/exchange/csv_export.hpp"

namespace levitas::cli {

WhatIfCsv::WhatIfCsv(const std::string& path, const session::SessionHeader& header)
    : path_(path), axes_(header.channels.size()), period_ns_(header.period_ns) {
  if (path_.empty()) return;
  file_.emplace(path_);
  file_->Write("time_s");
  for (const auto& channel : header.channels) file_->Write(fmt::format(",recorded_{}_a", channel));
  for (const auto& channel : header.channels) file_->Write(fmt::format(",other_{}_a", channel));
  file_->Write("\n");
}

void WhatIfCsv::Add(const cycle::CycleRecord& record, const cycle::CycleOutputs& other) {
  if (!file_) return;
  file_->Write(session::SecondsText(static_cast<std::int64_t>(record.in.cycle) * period_ns_));
  for (const AxisArray* currents :
       {&record.out.current.control_current_a, &other.current.control_current_a}) {
    for (std::size_t axis = 0; axis < axes_; ++axis)
      file_->Write(fmt::format(",{}", (*currents)[axis]));
  }
  file_->Write("\n");
}

void WhatIfCsv::Finish() {
  if (file_) file_->Commit();
}

}  // namespace levitas::cli
