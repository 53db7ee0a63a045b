#include "session_index/describe_session.hpp"

#include <cmath>
#include <filesystem>

#include "configuration/rig_file.hpp"
#include "session/log/session_reader.hpp"
#include "verdict/commission.hpp"

namespace levitas::session_index {
namespace {

namespace fs = std::filesystem;

void PlaceOf(const std::string& path, Entry& entry) {
  entry.path = fs::absolute(path).lexically_normal().string();
  entry.size_byte = fs::file_size(path);
}

void FromHeader(const session::SessionHeader& header, Entry& entry) {
  entry.start_utc_ns = header.start_utc_ns;
  entry.pace = header.pace;
  entry.port = header.source;
  entry.program_version = header.program_version;
}

/// What a record without a judgement holds: length and top speed.
void FromRecords(session::SessionReader& reader, Entry& entry) {
  cycle::CycleRecord record;
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  while (reader.Next(record)) {
    if (entry.cycles == 0) first = record.in.cycle;
    last = record.in.cycle;
    ++entry.cycles;
    entry.top_speed_rad_per_s =
        std::fmax(entry.top_speed_rad_per_s, std::abs(record.in.frame.speed_rad_per_s));
  }
  entry.duration_s =
      static_cast<double>(last - first) * static_cast<double>(reader.header().period_ns) * 1e-9;
  entry.damage = reader.damage().Text();
}

}  // namespace

Entry DescribeRun(const std::string& path, const verdict::Verdict& verdict) {
  Entry entry;
  PlaceOf(path, entry);
  const verdict::Inputs& in = verdict.inputs;
  entry.start_utc_ns = in.provenance.start_utc_ns;
  entry.pace = in.provenance.pace;
  entry.port = in.provenance.port;
  entry.program_version = in.provenance.program_version;
  entry.rig = in.provenance.rig;
  entry.controller = in.provenance.controller;
  entry.scenario = in.provenance.scenario;
  entry.cycles = in.session.cycles;
  entry.duration_s = in.session.duration_s;
  entry.top_speed_rad_per_s = in.session.top_speed_rad_per_s;
  entry.outcome = verdict::Name(verdict.outcome);
  entry.sentence = verdict.sentence;
  entry.damage = in.damage;
  return entry;
}

Entry DescribeSession(const std::string& path) {
  session::SessionReader reader(path);
  const session::SessionHeader& header = reader.header();
  if (!header.controller_yaml.empty() && header.excerpt_of.empty()) {
    verdict::CommissionOptions judge;
    judge.session_path = path;
    return DescribeRun(path, verdict::Commission(judge));
  }
  const std::string within = path + " (header)";
  const RigNumbers rig = configuration::ParseRig(header.rig_yaml, within).numbers;
  Entry entry;
  PlaceOf(path, entry);
  FromHeader(header, entry);
  entry.rig = rig.name;
  if (!header.scenario_yaml.empty()) {
    entry.scenario = configuration::ParseScenario(header.scenario_yaml, within, rig).name;
  }
  entry.outcome = kNotJudged;
  entry.sentence = header.excerpt_of.empty() ? "imported measurements, without a controller"
                                             : "excerpt around a trip of " + header.excerpt_of;
  FromRecords(reader, entry);
  return entry;
}

}  // namespace levitas::session_index
