// A session file: read, exported row by row, and its law tried anew. Nearly all mutations get their
// checksums repaired, or the fuzzer would never come behind them.

#include <algorithm>

#include "common/crc32.hpp"
#include "common/enums.hpp"
#include "common/problem.hpp"
#include "session/exchange/export_rows.hpp"
#include "session/log/log_format.hpp"
#include "session/log/session_reader.hpp"
#include "session/log/session_writer.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/verify.hpp"

// NOLINTBEGIN(readability-identifier-naming): the names that libFuzzer calls
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

namespace levitas::fuzz {
namespace {

using session::EventHeader;

/// Makes lengths and checksums of all events from the first on true, as far as events follow.
void Repair(std::span<std::uint8_t> file) {
  for (std::size_t at = 0; at + session::kEventHeaderBytes <= file.size();) {
    const EventHeader header = session::GetEventHeader(file.data() + at);
    if (header.sync != session::kSyncWord || header.channel_bytes < 0 || header.data_bytes < 0) {
      ++at;
      continue;
    }
    const std::uint64_t data_at =
        at + session::kEventHeaderBytes + static_cast<std::uint64_t>(header.channel_bytes);
    const std::uint64_t end = data_at + static_cast<std::uint64_t>(header.data_bytes);
    if (end > file.size() || header.data_bytes < 4) return;
    std::uint8_t* const crc = file.data() + end - 4;
    std::fill_n(crc, 4, std::uint8_t{0});
    const std::uint32_t sum =
        Crc32(file.data() + data_at, static_cast<std::size_t>(header.data_bytes));
    const void* name = file.data() + at + session::kEventHeaderBytes;
    const std::string_view channel(static_cast<const char*>(name),
                                   static_cast<std::size_t>(header.channel_bytes));
    if (channel != session::kEventChannel) session::PutBigEndian(crc, sum);
    at = end;
  }
}

void Read(const std::string& path) {
  session::SessionReader reader(path);
  session::ExportRows rows(reader.header());
  std::vector<double> values;
  cycle::CycleRecord record;
  while (reader.Next(record)) {
    rows.Next(record, values);
    Verify(values.size() + 1 == rows.names().size(), "a row has a value for every name");
    Verify(Name(record.out.mode) != "invalid" && Name(record.out.fault) != "invalid" &&
               Name(record.in.op.command) != "invalid",
           "every word of a record has a name");
    Verify(record.in.coils <= record.in.coil_current_a.size(), "coil currents have room");
  }
  (void)reader.damage().Text();
}

std::string Seed(const std::string& name) {
  const std::string path = ScratchFolder() + name;
  {
    session::SessionHeader header;
    header.rig_yaml = "name: test\n";
    header.pace = "lockstep";
    header.period_ns = 100'000;
    header.channels = {"de_x", "de_y"};
    session::SessionWriter writer(path, header);
    for (std::uint64_t cycle = 0; cycle < 3; ++cycle) {
      cycle::CycleRecord record;
      record.in.cycle = cycle;
      record.in.frame_present = true;
      record.in.frame.axes = record.out.current.axes = 2;
      record.in.coils = cycle == 1 ? 4 : 0;
      writer.Write(record);
    }
    writer.Write(session::Event{.cycle = 2, .text = "off -> lift"});
  }
  return Content(path);
}

}  // namespace

/// Plain, and packed by zstd.
std::vector<std::string> Seeds() { return {Seed("/seed.lcm"), Seed("/seed.lcm.zst")}; }

}  // namespace levitas::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t room, unsigned int seed) {
  const std::size_t now = LLVMFuzzerMutate(data, size, room);
  constexpr unsigned int kLeftDamagedOneIn = 10;
  if (seed % kLeftDamagedOneIn != 0) levitas::fuzz::Repair({data, now});
  return now;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    levitas::fuzz::Read(levitas::fuzz::AsFile("run.lcm", {data, size}));
  } catch (const levitas::BadInput&) {
    return 0;  // said in one sentence: what is asked for
  }
  return 0;
}
// NOLINTEND(readability-identifier-naming)
