// database.h — SQLite behind two small classes: results of a sweep in one self-describing file.
//
// A failing statement throws std::runtime_error with the file's name and SQLite's message.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace kurbel {

class Database {
 public:
  // Opens the file for this process alone; creates it if missing. Throws std::invalid_argument if it cannot: no such
  // folder, no database, in use by another process.
  explicit Database(const std::filesystem::path& file);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const std::string& sql);
  const std::filesystem::path& file() const { return file_; }
  sqlite3* handle() const { return handle_; }
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

// A prepared statement: bind, step, read, repeat.
class Query {
 public:
  Query(const Database& database, const std::string& sql);
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  Query& bind(int at, double value);  // from 1; NaN is stored as NULL
  Query& bind(int at, std::int64_t value);
  Query& bind(int at, std::string_view value);
  bool step();  // true: a row is available
  void done();  // runs to the end, and resets
  void reset();

  bool is_null(int column) const;
  double number(int column) const;
  std::int64_t integer(int column) const;
  std::string text(int column) const;

 private:
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace kurbel
