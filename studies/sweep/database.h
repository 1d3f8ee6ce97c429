// database.h — SQLite behind two small classes: what a sweep has computed lies in one file that explains itself.
//
// A statement that fails throws std::runtime_error with the file's name and SQLite's words.
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
  // Opened for this process alone; made if it is not there. Throws std::invalid_argument where it cannot be: no such
  // folder, no database, another process at work on it.
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

// A prepared statement: bind, step, read, again.
class Query {
 public:
  Query(const Database& database, const std::string& sql);
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  Query& bind(int at, double value);  // from 1; what is not a number is NULL
  Query& bind(int at, std::int64_t value);
  Query& bind(int at, std::string_view value);
  bool step();  // true: a row is there
  void done();  // runs to the end, and begins anew
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
