#pragma once
// One SQL statement with its parameters bound by position, and the row it stands on.
//
// Failure   BadInput with the file's name and what SQLite says; a Problem of status 1 when the disk
//           is full or fails.
// Thread    that of its connection.

#include <cstdint>
#include <memory>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace levitas::session_index {

/// Throws what SQLite says of the connection's last failure.
[[noreturn]] void ThrowSqlite(sqlite3* connection, const std::string& file);

class Statement {
 public:
  Statement(sqlite3* connection, const std::string& file, const std::string& sql);

  /// The next parameter, from the first on.
  Statement& Bind(const std::string& text);
  Statement& Bind(std::int64_t number);
  Statement& Bind(double number);

  /// False at the end.
  bool Step();

  [[nodiscard]] std::string Text(int column) const;
  [[nodiscard]] std::int64_t Integer(int column) const;
  [[nodiscard]] double Real(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };
  void Check(int status) const;

  sqlite3* connection_;
  std::string file_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int bound_{};
};

}  // namespace levitas::session_index
