#include "session/log/trip_freezer.hpp"

#include <fcntl.h>
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <utility>

#include "common/file_descriptor.hpp"
#include "common/output_file.hpp"

namespace levitas::session {
namespace {

std::uint64_t Cycles(double window_s, std::int64_t period_ns) {
  const double period_s = static_cast<double>(std::max<std::int64_t>(period_ns, 1)) * 1e-9;
  return static_cast<std::uint64_t>(std::llround(std::max(window_s, 0.0) / period_s));
}

/// Makes the file empty, or says that the name is taken: by whatever it is, a link to nothing too.
bool MakesNew(const std::string& path) {
  const FileDescriptor file(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
  if (file.is_open()) return true;
  if (errno != EEXIST) CannotWrite(path, errno);
  return false;
}

/// The path of a file that did not exist and is ours now: two trips in one millisecond get numbers.
std::string NewFile(const std::string& folder, const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path base = fs::path(folder.empty() ? "." : folder) / name;
  fs::path path = base;
  for (int copy = 2; !MakesNew(path.string()); ++copy) {
    path = base;
    path.replace_filename(
        fmt::format("{}-{}{}", base.stem().string(), copy, base.extension().string()));
  }
  return path.string();
}

}  // namespace

std::string TripFileName(std::int64_t utc_ns, Fault fault) {
  const auto seconds = static_cast<std::time_t>(utc_ns / 1'000'000'000);
  const auto milliseconds = utc_ns / 1'000'000 % 1000;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("trip-{:04}{:02}{:02}T{:02}{:02}{:02}.{:03}Z-{}.lcmlog", utc.tm_year + 1900,
                     utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, milliseconds,
                     Name(fault));
}

TripFreezer::TripFreezer(std::string folder, SessionHeader header, double window_s,
                         TripBudget budget)
    : folder_(std::move(folder)),
      header_(std::move(header)),
      window_cycles_(Cycles(window_s, header_.period_ns)),
      before_(std::max<std::uint64_t>(window_cycles_, 1)),
      budget_(budget) {}

void TripFreezer::Open(const cycle::CycleRecord& record) {
  const auto utc_ns = [this](std::uint64_t cycle) {
    return header_.start_utc_ns +
           static_cast<std::int64_t>(cycle - first_cycle_) * header_.period_ns;
  };
  const std::size_t oldest = (next_ + before_.size() - filled_) % before_.size();
  SessionHeader header = header_;
  if (filled_ > 0) header.start_utc_ns = utc_ns(before_[oldest].in.cycle);
  if (header.excerpt_of.empty()) header.excerpt_of = "an unrecorded run";
  if (!folder_.empty()) std::filesystem::create_directories(folder_);
  if (!looked_) older_ = OlderTripFiles(folder_, written_);
  looked_ = true;
  path_ = NewFile(folder_, TripFileName(utc_ns(record.in.cycle), record.out.fault));
  written_.push_back(std::filesystem::path(path_).filename().string());
  file_ = std::make_unique<SessionWriter>(path_, header);
  for (std::size_t i = 0; i < filled_; ++i) {
    const cycle::CycleRecord& kept = before_[(oldest + i) % before_.size()];
    if (kept.in.cycle + window_cycles_ >= record.in.cycle) file_->Write(kept);
  }
  last_cycle_ = record.in.cycle + window_cycles_;
}

void TripFreezer::Take(const cycle::CycleRecord& record, const std::vector<Event>& events) {
  if (!first_known_) first_cycle_ = record.in.cycle;
  first_known_ = true;
  // Whatever becomes of the file: the next one needs the record.
  struct Keep {
    ~Keep() {
      freezer.before_[freezer.next_] = record;
      freezer.next_ = (freezer.next_ + 1) % freezer.before_.size();
      freezer.filled_ = std::min(freezer.filled_ + 1, freezer.before_.size());
    }
    TripFreezer& freezer;
    const cycle::CycleRecord& record;
  };
  const Keep keep{*this, record};
  Write(record, events);
}

void TripFreezer::Write(const cycle::CycleRecord& record, const std::vector<Event>& events) {
  const auto tripped = [](const Event& event) { return event.severity == Event::Severity::kTrip; };
  if (std::any_of(events.begin(), events.end(), tripped)) {
    Finish();
    Open(record);
  }
  if (!file_) return;
  if (record.in.cycle <= last_cycle_) {
    file_->Write(record);
    for (const Event& event : events) file_->Write(event);
  }
  if (record.in.cycle >= last_cycle_) Finish();
}

void TripFreezer::Finish() {
  if (!file_) return;
  file_->Flush();
  file_.reset();
  newest_ = path_;
  MakeRoom();
}

void TripFreezer::Abandon() {
  file_.reset();
  MakeRoom();
}

void TripFreezer::MakeRoom() {
  for (std::string& name : KeepWithin(budget_, folder_, written_)) {
    removed_.push_back(std::move(name));
  }
}

void TripFreezer::Flush() {
  if (file_) file_->Flush();
}

}  // namespace levitas::session
