// database.cpp — SQLite's C interface with its guarantees: WAL, one writer, committed data are on disk.
#include "studies/sweep/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace kurbel {

Database::Database(const std::filesystem::path& file) : file_(file) {
  const auto refuse = [&](const std::string& why) {
    sqlite3_close(handle_);
    throw std::invalid_argument(fmt::format("{}: {}", file_.string(), why));
  };
  if (sqlite3_open_v2(file.c_str(), &handle_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr) != SQLITE_OK)
    refuse(fmt::format("cannot be opened ({}); give a file in a folder that is there and may be written",
                       sqlite3_errmsg(handle_)));
  sqlite3_busy_timeout(handle_, 500);
  // The lock belongs to the process and ends with it in any case. FULL: committed data are on disk.
  const int code = sqlite3_exec(handle_,
                                "PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL;"
                                "BEGIN IMMEDIATE; COMMIT;",
                                nullptr, nullptr, nullptr);
  if (code == SQLITE_BUSY) refuse("another process is at work on it; wait for its end, or take another file");
  if (code == SQLITE_NOTADB) refuse("is no database; take another file");
  if (code != SQLITE_OK) refuse(fmt::format("cannot be written ({})", sqlite3_errmsg(handle_)));
}

Database::~Database() { sqlite3_close(handle_); }

void Database::fail(const std::string& doing) const {
  throw std::runtime_error(fmt::format("{}: {}: {}", file_.string(), doing, sqlite3_errmsg(handle_)));
}

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(sql.substr(0, 60));
}

Query::Query(const Database& database, const std::string& sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
    database.fail(sql.substr(0, 60));
}
Query::~Query() { sqlite3_finalize(statement_); }

Query& Query::bind(int at, double value) {
  if (std::isnan(value))
    sqlite3_bind_null(statement_, at);
  else
    sqlite3_bind_double(statement_, at, value);
  return *this;
}
Query& Query::bind(int at, std::int64_t value) {
  sqlite3_bind_int64(statement_, at, value);
  return *this;
}
Query& Query::bind(int at, std::string_view value) {
  sqlite3_bind_text(statement_, at, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
  return *this;
}
bool Query::step() {
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail("reading or writing");
  return code == SQLITE_ROW;
}
void Query::done() {
  while (step()) {
  }
  reset();
}
void Query::reset() { sqlite3_reset(statement_); }

bool Query::is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
double Query::number(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_, column);
}
std::int64_t Query::integer(int column) const { return sqlite3_column_int64(statement_, column); }
std::string Query::text(int column) const {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : std::string();
}

}  // namespace kurbel
