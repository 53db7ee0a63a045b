#include "cli/study/healthy_session.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <optional>

#include "session/exchange/rig_of_session.hpp"
#include "session/log/session_reader.hpp"
#include "session_index/catalogue.hpp"
#include "session_index/catalogue_path.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

/// Of the earliest session among the records; none where no record is one.
std::optional<std::int64_t> FirstStart(const std::vector<std::string>& records) {
  std::optional<std::int64_t> first;
  for (const std::string& path : records) {
    try {
      if (!session::RigOfSession(path)) continue;
      const std::int64_t start_ns = session::SessionReader(path).header().start_utc_ns;
      first = std::min(first.value_or(start_ns), start_ns);
    } catch (const std::exception&) {  // who loads it says what is wrong with it
    }
  }
  return first;
}

bool IsOneOf(const std::string& path, const std::vector<std::string>& records) {
  return std::any_of(records.begin(), records.end(), [&path](const std::string& record) {
    std::error_code unknown;
    return fs::equivalent(path, record, unknown);
  });
}

bool IsOfRig(const std::string& path, const configuration::RigFile& rig) {
  try {
    const auto own = session::RigOfSession(path);
    return own && own->numbers.channels == rig.numbers.channels &&
           own->numbers.period_ns == rig.numbers.period_ns;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::string LastAcceptedSession(const configuration::RigFile& rig,
                                const std::vector<std::string>& records) {
  try {
    const auto file = session_index::CataloguePath();
    if (!file || !fs::exists(*file)) return {};
    session_index::Filter filter;
    filter.rig = rig.numbers.name;
    filter.outcome = "accepted";
    filter.before_utc_ns = FirstStart(records);
    for (const auto& entry : session_index::Catalogue(*file).Find(filter)) {
      std::error_code gone;
      if (!fs::exists(entry.path, gone) || IsOneOf(entry.path, records)) continue;
      if (IsOfRig(entry.path, rig)) return entry.path;
    }
  } catch (const std::exception&) {  // a proposal is no reason to fail
  }
  return {};
}

}  // namespace levitas::cli
