#include "session_index/statement.hpp"

#include <sqlite3.h>

#include "common/problem.hpp"

namespace levitas::session_index {

void ThrowSqlite(sqlite3* connection, const std::string& file) {
  const char* why = connection != nullptr ? sqlite3_errmsg(connection) : "out of memory";
  const int code = connection != nullptr ? sqlite3_errcode(connection) : SQLITE_NOMEM;
  if (code == SQLITE_FULL || code == SQLITE_IOERR) {
    throw Problem(ExitStatus::kOther,
                  file + ": the catalogue of sessions: writing failed: " + why +
                      ". Make room, or name a file on another disk with LEVITAS_CATALOGUE or "
                      "--catalogue.");
  }
  throw BadInput(file + ": the catalogue of sessions cannot be used (" + why +
                 "); name another with LEVITAS_CATALOGUE or --catalogue");
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const noexcept {
  sqlite3_finalize(statement);
}

Statement::Statement(sqlite3* connection, const std::string& file, const std::string& sql)
    : connection_(connection), file_(file) {
  sqlite3_stmt* made = nullptr;
  const int status = sqlite3_prepare_v2(connection, sql.c_str(), -1, &made, nullptr);
  statement_.reset(made);
  Check(status);
}

void Statement::Check(int status) const {
  if (status != SQLITE_OK) ThrowSqlite(connection_, file_);
}

Statement& Statement::Bind(const std::string& text) {
  Check(sqlite3_bind_text(statement_.get(), ++bound_, text.data(), static_cast<int>(text.size()),
                          SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::Bind(std::int64_t number) {
  Check(sqlite3_bind_int64(statement_.get(), ++bound_, number));
  return *this;
}

Statement& Statement::Bind(double number) {
  Check(sqlite3_bind_double(statement_.get(), ++bound_, number));
  return *this;
}

bool Statement::Step() {
  const int status = sqlite3_step(statement_.get());
  if (status != SQLITE_ROW && status != SQLITE_DONE) ThrowSqlite(connection_, file_);
  return status == SQLITE_ROW;
}

std::string Statement::Text(int column) const {
  const auto* text = sqlite3_column_text(statement_.get(), column);
  const int bytes = sqlite3_column_bytes(statement_.get(), column);
  return text == nullptr ? std::string() : std::string(text, text + bytes);
}

std::int64_t Statement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::Real(int column) const { return sqlite3_column_double(statement_.get(), column); }

}  // namespace levitas::session_index
