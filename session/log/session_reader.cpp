#include "session/log/session_reader.hpp"

#include <fmt/core.h>

#include <utility>

#include "common/problem.hpp"
#include "lcmtypes/torsion/torsion_codec.hpp"
#include "session/log/log_format.hpp"
#include "session/log/log_scanner.hpp"
#include "session/log/packed_log.hpp"
#include "session/log/record_codec.hpp"

namespace levitas::session {
namespace {

using Look = LogScanner::Look;

}  // namespace

struct SessionReader::Impl {
  explicit Impl(const std::string& file_path) : path(file_path), scanner(file_path) {
    FindHeader();
    scanner.MoveTo(0);
    damage.packed = scanner.packed() != nullptr;
  }

  /// The first sound header event: normally the first event, after damage one of the copies.
  void FindHeader() {
    bool any_event = false;
    bool header_channel = false;
    RawEvent event;
    for (Look look = scanner.At(event); look != Look::kEnd; look = scanner.At(event)) {
      if (look != Look::kEvent) {
        scanner.SkipToSync();
        continue;
      }
      any_event = true;
      if (event.channel != kHeaderChannel) {  // its length may lie: nothing behind it is skipped
        scanner.SkipToSync();
        continue;
      }
      header_channel = true;
      int version = 0;
      switch (Judge(event, header, version)) {
        case HeaderResult::kGood:
          CheckPeriod();
          return;
        case HeaderResult::kOtherVersion:
          throw BadInput(
              fmt::format("{}: session format version {}, this program reads version {}. "
                          "Read it with the program version that recorded it.",
                          path, version, kFormatVersion));
        case HeaderResult::kDamaged:
          scanner.SkipToSync();
      }
    }
    throw BadInput(MissingHeader(any_event, header_channel));
  }

  /// Of another version only the checksum can be judged; of headers that overlap it would be
  /// computed over the same bytes again and again: after so many, what calls itself a header is not
  /// looked at.
  HeaderResult Judge(const RawEvent& event, SessionHeader& to, int& version) {
    constexpr std::uint64_t kMostInVain = std::uint64_t{256} << 20;
    if (header_bytes_in_vain > kMostInVain) return HeaderResult::kDamaged;
    const HeaderResult result = DecodeHeader(event.data, to, version);
    // What is of our version is walked along its layout first, which ends at the first lie.
    const bool checksum_alone = version > 0 && version != kFormatVersion;
    if (result != HeaderResult::kGood && checksum_alone) header_bytes_in_vain += event.data.size();
    return result;
  }

  void CheckPeriod() const {
    if (header.period_ns > 0) return;
    throw BadInput(
        fmt::format("{}: the header names a sampling period of {} ns; it must be above 0", path,
                    header.period_ns));
  }

  [[nodiscard]] std::string MissingHeader(bool any_event, bool header_channel) const {
    if (scanner.file_bytes() == 0) return fmt::format("{}: the file is empty, not a session", path);
    if (!any_event) {
      return fmt::format(
          "{}: not a session: there is no LCM log event in its {} bytes. CSV (.csv, .csv.xz) and "
          "MAT (.mat) become a session by amb import; amb diagnose takes them as they are",
          path, scanner.file_bytes());
    }
    if (header_channel) {
      return fmt::format("{}: the session's header is damaged and no sound copy of it follows",
                         path);
    }
    return fmt::format(
        "{}: an LCM log without a {} event, so not a session. Record with --record, "
        "or use amb import for other data.",
        path, kHeaderChannel);
  }

  void Bad(std::uint64_t offset) noexcept {
    if (!bad_known) damage.first_bad_offset = offset;
    bad_known = true;
  }

  /// Leaves a place where no sound event stands.
  void SkipDamage(Look look, const RawEvent& event) {
    const std::uint64_t from = scanner.offset();
    Bad(from);
    const bool found = scanner.SkipToSync();
    if (look == Look::kEvent && scanner.offset() == event.end) {
      ++damage.corrupt_records;  // its frame is sound: exactly one event is lost
    } else if (look == Look::kCutOff && !found) {
      damage.truncated = true;
    } else {
      damage.corrupt_bytes += scanner.offset() - from;
    }
  }

  /// Takes an event with a sound frame; false when its content is damaged.
  bool Take(const RawEvent& event, cycle::CycleRecord& record, bool& is_record) {
    is_record = false;
    if (event.channel == kCycleChannel) {
      cycle::CycleRecord read;
      if (!codec.Decode(event.data, read)) return false;
      if (have_record && read.in.cycle <= last_cycle) return false;  // an older block in the way
      if (have_record && read.in.cycle > last_cycle + 1) {
        Bad(event.offset);
        damage.missing_cycles += read.in.cycle - last_cycle - 1;
      }
      have_record = true;
      last_cycle = read.in.cycle;
      record = read;
      is_record = true;
      return true;
    }
    if (event.channel == kEventChannel) {
      Event read;
      if (!DecodeEvent(event.data, read)) return false;
      events.push_back(std::move(read));
      return true;
    }
    if (event.channel == kTorsionChannel) {
      TorsionBatch read;
      if (!torsion_codec.Decode(event.data, read)) return false;
      if (keep_torsion) torsion.push_back(read);
      return true;
    }
    if (event.channel == kHeaderChannel) {
      SessionHeader copy;
      int version = 0;
      return Judge(event, copy, version) == HeaderResult::kGood;
    }
    return false;  // nothing else is ever written: a damaged channel name
  }

  bool Next(cycle::CycleRecord& record) {
    RawEvent event;
    for (Look look = scanner.At(event); look != Look::kEnd; look = scanner.At(event)) {
      bool is_record = false;
      if (look == Look::kEvent && Take(event, record, is_record)) {
        scanner.MoveTo(event.end);
        if (is_record) return true;
      } else {
        SkipDamage(look, event);
      }
    }
    if (scanner.packed() != nullptr) CountPacked(*scanner.packed());
    return false;
  }

  /// What of the damage only unpacking can tell.
  void CountPacked(const PackedReader& packed) noexcept {
    damage.corrupt_blocks = packed.bad_frames();
    const std::uint64_t offset =
        packed.bad_frames() > 0 ? packed.first_bad_offset() : scanner.offset();
    if (packed.cut_off()) damage.truncated = true;
    if (!packed.cut_off() && packed.bad_frames() == 0) return;
    if (!bad_known || offset < damage.first_bad_offset) damage.first_bad_offset = offset;
    bad_known = true;
  }

  std::string path;
  LogScanner scanner;
  SessionHeader header;
  RecordCodec codec{0};
  TorsionCodec torsion_codec;
  std::vector<TorsionBatch> torsion;
  bool keep_torsion{false};
  std::vector<Event> events;
  Damage damage;
  bool bad_known{false};
  bool have_record{false};
  std::uint64_t last_cycle{0};
  std::uint64_t header_bytes_in_vain{0};
};

SessionReader::SessionReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
SessionReader::~SessionReader() = default;
SessionReader::SessionReader(SessionReader&&) noexcept = default;

const SessionHeader& SessionReader::header() const noexcept { return impl_->header; }
const std::string& SessionReader::path() const noexcept { return impl_->path; }
bool SessionReader::Next(cycle::CycleRecord& record) { return impl_->Next(record); }
void SessionReader::KeepTorsion() noexcept { impl_->keep_torsion = true; }
const std::vector<TorsionBatch>& SessionReader::torsion() const noexcept { return impl_->torsion; }
const std::vector<Event>& SessionReader::events() const noexcept { return impl_->events; }
const Damage& SessionReader::damage() const noexcept { return impl_->damage; }

std::string Damage::Text() const {
  if (!any()) return {};
  std::string lost;
  const auto add = [&lost](const std::string& part) {
    lost += lost.empty() ? "" : ", ";
    lost += part;
  };
  if (corrupt_records > 0) add(fmt::format("{} damaged record(s)", corrupt_records));
  if (corrupt_bytes > 0) add(fmt::format("{} unreadable byte(s)", corrupt_bytes));
  if (missing_cycles > 0) add(fmt::format("{} cycle(s) missing", missing_cycles));
  if (corrupt_blocks > 0) add(fmt::format("{} damaged packed block(s)", corrupt_blocks));
  if (truncated) {
    add(packed ? "the file ends inside a packed block and is read up to its last complete one"
               : "the file ends inside a record");
  }
  return fmt::format("{}; first at byte {}{}; everything else was read", lost, first_bad_offset,
                     packed ? " of the unpacked log" : "");
}

}  // namespace levitas::session
