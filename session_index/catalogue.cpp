#include "session_index/catalogue.hpp"

#include <fmt/core.h>
#include <sqlite3.h>

#include <filesystem>

#include "common/problem.hpp"
#include "session_index/statement.hpp"

namespace levitas::session_index {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFormat = 1;  // PRAGMA user_version; 0 is a file just made
constexpr int kPatienceMs = 5000;

constexpr const char* kTables = R"(
CREATE TABLE session (
  path TEXT PRIMARY KEY, size_byte INTEGER NOT NULL, start_utc_ns INTEGER NOT NULL,
  duration_s REAL NOT NULL, cycles INTEGER NOT NULL, rig TEXT NOT NULL, controller TEXT NOT NULL,
  scenario TEXT NOT NULL, pace TEXT NOT NULL, port TEXT NOT NULL, program_version TEXT NOT NULL,
  outcome TEXT NOT NULL, sentence TEXT NOT NULL, damage TEXT NOT NULL,
  top_speed_rad_per_s REAL NOT NULL) WITHOUT ROWID;
CREATE TABLE tag (
  path TEXT NOT NULL REFERENCES session(path) ON DELETE CASCADE, tag TEXT NOT NULL,
  PRIMARY KEY (path, tag)) WITHOUT ROWID;
CREATE INDEX by_start ON session(start_utc_ns);
PRAGMA user_version = 1;
)";

constexpr const char* kColumns =
    "path, size_byte, start_utc_ns, duration_s, cycles, rig, controller, scenario, pace, port, "
    "program_version, outcome, sentence, damage, top_speed_rad_per_s";

struct Close {
  void operator()(sqlite3* connection) const noexcept { sqlite3_close(connection); }
};

Entry EntryOf(const Statement& row) {
  Entry entry;
  entry.path = row.Text(0);
  entry.size_byte = static_cast<std::uint64_t>(row.Integer(1));
  entry.start_utc_ns = row.Integer(2);
  entry.duration_s = row.Real(3);
  entry.cycles = static_cast<std::uint64_t>(row.Integer(4));
  entry.rig = row.Text(5);
  entry.controller = row.Text(6);
  entry.scenario = row.Text(7);
  entry.pace = row.Text(8);
  entry.port = row.Text(9);
  entry.program_version = row.Text(10);
  entry.outcome = row.Text(11);
  entry.sentence = row.Text(12);
  entry.damage = row.Text(13);
  entry.top_speed_rad_per_s = row.Real(14);
  return entry;
}

void BindEntry(Statement& statement, const Entry& entry) {
  statement.Bind(entry.path)
      .Bind(static_cast<std::int64_t>(entry.size_byte))
      .Bind(entry.start_utc_ns)
      .Bind(entry.duration_s)
      .Bind(static_cast<std::int64_t>(entry.cycles))
      .Bind(entry.rig)
      .Bind(entry.controller)
      .Bind(entry.scenario)
      .Bind(entry.pace)
      .Bind(entry.port)
      .Bind(entry.program_version)
      .Bind(entry.outcome)
      .Bind(entry.sentence)
      .Bind(entry.damage)
      .Bind(entry.top_speed_rad_per_s);
}

/// The conditions of a filter and, in the same order, what they are bound to.
struct Conditions {
  explicit Conditions(const Filter& filter) {
    if (!filter.rig.empty()) Add("rig = ?", filter.rig);
    if (!filter.outcome.empty()) Add("outcome = ?", filter.outcome);
    for (const std::string& tag : filter.tags) {
      Add("EXISTS (SELECT 1 FROM tag WHERE tag.path = session.path AND tag.tag = ?)", tag);
    }
    if (!filter.text.empty()) {
      // instr, not LIKE: what a user types holds no patterns.
      Add("instr(path || char(10) || controller || char(10) || scenario || char(10) || port, ?) > "
          "0",
          filter.text);
    }
    if (filter.from_utc_ns) sql += fmt::format(" AND start_utc_ns >= {}", *filter.from_utc_ns);
    if (filter.before_utc_ns) sql += fmt::format(" AND start_utc_ns < {}", *filter.before_utc_ns);
  }
  void Add(const char* condition, const std::string& value) {
    sql += std::string(" AND ") + condition;
    values.push_back(value);
  }
  std::string sql{"1"};
  std::vector<std::string> values;
};

}  // namespace

struct Catalogue::Impl {
  explicit Impl(const std::string& file_name) : file(file_name) {
    std::error_code ignored;  // opening says it better
    if (const fs::path folder = fs::path(file).parent_path(); !folder.empty()) {
      fs::create_directories(folder, ignored);
    }
    sqlite3* opened = nullptr;
    const int status = sqlite3_open(file.c_str(), &opened);
    connection.reset(opened);
    if (status != SQLITE_OK) ThrowSqlite(opened, file);
    sqlite3_busy_timeout(opened, kPatienceMs);
    Run("PRAGMA foreign_keys = ON");
    MakeTables();
  }

  void Run(const char* sql) const {
    if (sqlite3_exec(connection.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
      ThrowSqlite(connection.get(), file);
    }
  }

  [[nodiscard]] Statement Prepare(const std::string& sql) const {
    return {connection.get(), file, sql};
  }

  [[nodiscard]] std::int64_t Format() const {
    Statement version = Prepare("PRAGMA user_version");
    return version.Step() ? version.Integer(0) : 0;
  }

  void MakeTables() const {
    if (Format() == 0) {
      Run("BEGIN IMMEDIATE");
      if (Format() == 0) Run(kTables);  // unless another program was quicker
      Run("COMMIT");
    }
    if (const std::int64_t format = Format(); format != kFormat) {
      throw BadInput(
          fmt::format("{}: a catalogue of format {}; this program knows {}: use the "
                      "newer program, or another file (LEVITAS_CATALOGUE)",
                      file, format, kFormat));
    }
  }

  /// Whether a statement with these two parameters changed something.
  bool Changes(const std::string& sql, const std::string& first, const std::string& second) const {
    Statement statement = Prepare(sql);
    statement.Bind(first);
    if (!second.empty()) statement.Bind(second);
    statement.Step();
    return sqlite3_changes(connection.get()) > 0;
  }

  [[nodiscard]] bool Has(const std::string& path) const {
    Statement found = Prepare("SELECT 1 FROM session WHERE path = ?");
    return found.Bind(path).Step();
  }

  [[nodiscard]] std::vector<std::string> TagsOf(const std::string& path) const {
    Statement rows = Prepare("SELECT tag FROM tag WHERE path = ? ORDER BY tag");
    rows.Bind(path);
    std::vector<std::string> tags;
    while (rows.Step()) tags.push_back(rows.Text(0));
    return tags;
  }

  std::string file;
  std::unique_ptr<sqlite3, Close> connection;
};

Catalogue::Catalogue(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
Catalogue::~Catalogue() = default;
Catalogue::Catalogue(Catalogue&&) noexcept = default;
Catalogue& Catalogue::operator=(Catalogue&&) noexcept = default;

void Catalogue::Put(const Entry& entry) {
  impl_->Run("BEGIN IMMEDIATE");
  try {
    // An update in place, since a replaced row would take its tags with it.
    Statement put = impl_->Prepare(fmt::format(
        "INSERT INTO session ({}) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?) ON CONFLICT (path) DO "
        "UPDATE SET size_byte = excluded.size_byte, start_utc_ns = excluded.start_utc_ns, "
        "duration_s = excluded.duration_s, cycles = excluded.cycles, rig = excluded.rig, "
        "controller = excluded.controller, scenario = excluded.scenario, pace = excluded.pace, "
        "port = excluded.port, program_version = excluded.program_version, "
        "outcome = excluded.outcome, sentence = excluded.sentence, damage = excluded.damage, "
        "top_speed_rad_per_s = excluded.top_speed_rad_per_s",
        kColumns));
    BindEntry(put, entry);
    put.Step();
    for (const std::string& tag : entry.tags) AddTag(entry.path, tag);
  } catch (...) {
    sqlite3_exec(impl_->connection.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
  impl_->Run("COMMIT");
}

std::vector<Entry> Catalogue::Find(const Filter& filter) const {
  const Conditions conditions(filter);
  Statement rows =
      impl_->Prepare(fmt::format("SELECT {} FROM session WHERE {} ORDER BY start_utc_ns DESC, path",
                                 kColumns, conditions.sql));
  for (const std::string& value : conditions.values) rows.Bind(value);
  std::vector<Entry> found;
  while (rows.Step()) found.push_back(EntryOf(rows));
  for (Entry& entry : found) entry.tags = impl_->TagsOf(entry.path);
  return found;
}

bool Catalogue::AddTag(const std::string& path, const std::string& tag) {
  if (!impl_->Has(path)) return false;
  impl_->Changes("INSERT OR IGNORE INTO tag (path, tag) VALUES (?, ?)", path, tag);
  return true;
}

bool Catalogue::RemoveTag(const std::string& path, const std::string& tag) {
  return impl_->Changes("DELETE FROM tag WHERE path = ? AND tag = ?", path, tag);
}

bool Catalogue::Forget(const std::string& path) {
  return impl_->Changes("DELETE FROM session WHERE path = ?", path, {});
}

}  // namespace levitas::session_index
