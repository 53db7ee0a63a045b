#include "session/log/torsion_recording.hpp"

#include "configuration/rig_file.hpp"
#include "plant_sim/rotor/torsion_line.hpp"
#include "session/log/session_reader.hpp"
#include "session/log/torsion_instants.hpp"

namespace levitas::session {

// Rigs count their starts and cycles upwards, so rows are in that order.
std::optional<std::size_t> TorsionRecording::RowOf(std::uint32_t of_session,
                                                   std::uint64_t of_cycle) const noexcept {
  std::size_t first = 0;
  for (std::size_t beyond = rows(); first < beyond;) {
    const std::size_t middle = first + (beyond - first) / 2;
    const bool before = rig_session[middle] != of_session ? rig_session[middle] < of_session
                                                          : cycle[middle] < of_cycle;
    (before ? first : beyond) = before ? middle + 1 : middle;
  }
  if (first == rows() || rig_session[first] != of_session || cycle[first] != of_cycle) {
    return std::nullopt;
  }
  return first;
}

std::vector<std::string> GaugedCouplings(const SessionHeader& header) {
  // Most rigs have no gears: their text need not be read.
  if (header.rig_yaml.find("gauges:") == std::string::npos) return {};
  const configuration::RigFile rig =
      configuration::ParseRig(header.rig_yaml, "the rig of the session's header");
  return rotor::GaugedCouplings(rig.plant.shafts);
}

TorsionRecording LoadTorsion(const std::string& path) {
  SessionReader reader(path);
  TorsionRecording torsion;
  torsion.couplings = GaugedCouplings(reader.header());
  const std::size_t couplings = torsion.couplings.size();
  if (couplings == 0) return torsion;
  torsion.torque_n_m.resize(couplings);
  torsion.twist_rad.resize(couplings);
  reader.KeepTorsion();
  cycle::CycleRecord record;
  while (reader.Next(record)) {
  }
  ForEachInstant(reader.torsion(), couplings,
                 [&](std::uint32_t of_session, std::uint64_t of_cycle, auto torque, auto twist) {
                   torsion.rig_session.push_back(of_session);
                   torsion.cycle.push_back(of_cycle);
                   for (std::size_t c = 0; c < couplings; ++c) {
                     torsion.torque_n_m[c].push_back(torque[c]);
                     torsion.twist_rad[c].push_back(twist[c]);
                   }
                 });
  return torsion;
}

}  // namespace levitas::session
