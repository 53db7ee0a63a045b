#include "cli/what_if_csv.hpp"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include "common/problem.hpp"
#include "session/csv_export.hpp"

namespace levitas::cli {

WhatIfCsv::WhatIfCsv(const std::string& path, const session::SessionHeader& header)
    : path_(path), axes_(header.channels.size()), period_ns_(header.period_ns) {
  if (path_.empty()) return;
  part_.emplace(path_);
  file_.open(part_->part_path());
  if (!file_) {
    throw BadInput(
        fmt::format("{}: cannot be written; check that the folder exists and is yours", path_));
  }
  file_ << "time_s";
  for (const auto& channel : header.channels) fmt::print(file_, ",recorded_{}_a", channel);
  for (const auto& channel : header.channels) fmt::print(file_, ",other_{}_a", channel);
  file_ << '\n';
}

void WhatIfCsv::Add(const cycle::CycleRecord& record, const cycle::CycleOutputs& other) {
  if (path_.empty()) return;
  file_ << session::SecondsText(static_cast<std::int64_t>(record.in.cycle) * period_ns_);
  for (const AxisArray* currents :
       {&record.out.current.control_current_a, &other.current.control_current_a}) {
    for (std::size_t axis = 0; axis < axes_; ++axis) fmt::print(file_, ",{}", (*currents)[axis]);
  }
  file_ << '\n';
}

void WhatIfCsv::Finish() {
  if (path_.empty()) return;
  file_.close();
  if (!file_) throw Problem(ExitStatus::kOther, fmt::format("{}: writing failed", path_));
  part_->Commit();
}

}  // namespace levitas::cli
