#include "diagnosis/records/same_rows.hpp"

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <unordered_set>

#include "common/problem.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kRun = 8;
constexpr double kShare = 0.05;

/// Fowler-Noll-Vo (FNV-1a) over words.
void Mix(std::uint64_t& hash, double value) {
  hash ^= std::bit_cast<std::uint32_t>(static_cast<float>(value));
  hash *= 0x100000001B3ULL;
}

std::uint64_t Hash(const Record& record, std::size_t from) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (std::size_t n = from; n < from + kRun; ++n) {
    for (const double value : record.rows[n].sample.position_m) Mix(hash, value);
    for (const double value : record.rows[n].sample.command.control_current_a) Mix(hash, value);
  }
  return hash;
}

bool Moves(const Record& record, std::size_t from) {
  for (std::size_t n = from + 1; n < from + kRun; ++n) {
    const auto& now = record.rows[n].sample;
    const auto& before = record.rows[n - 1].sample;
    if (!record.rows[n].levitated || now.position_m == before.position_m ||
        now.command.control_current_a == before.command.control_current_a) {
      return false;
    }
  }
  return record.rows[from].levitated;
}

std::unordered_set<std::uint64_t> Runs(const Record& record) {
  std::unordered_set<std::uint64_t> runs;
  for (std::size_t n = 0; n + kRun <= record.rows.size(); ++n) {
    if (Moves(record, n)) runs.insert(Hash(record, n));
  }
  return runs;
}

}  // namespace

void RefuseSameRows(const std::vector<Record>& data, const std::vector<Record>& others,
                    const std::string& option, const std::string& remedy) {
  if (others.empty()) return;
  for (const Record& given : data) {
    const auto runs = Runs(given);
    for (const Record& other : others) {
      std::size_t same = 0;
      std::size_t all = 0;
      for (std::size_t n = 0; n + kRun <= other.rows.size(); n += kRun) {
        if (!Moves(other, n)) continue;
        ++all;
        if (runs.contains(Hash(other, n))) ++same;
      }
      if (all == 0 || static_cast<double>(same) <= kShare * static_cast<double>(all)) continue;
      throw BadInput(fmt::format(
          "{} {}: {:.0f} % of its rows are those of {}, which is diagnosed: {}", option, other.name,
          100.0 * static_cast<double>(same) / static_cast<double>(all), given.name, remedy));
    }
  }
}

}  // namespace levitas::diagnosis
