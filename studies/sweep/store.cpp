// store.cpp — tables of a sweep, written in batches, read by row; merging of shards.
#include "studies/sweep/store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace kurbel {
namespace {

constexpr const char* schema = R"(
CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE swept(number INTEGER PRIMARY KEY, path TEXT NOT NULL, unit TEXT NOT NULL, given TEXT NOT NULL);
CREATE TABLE words(number INTEGER NOT NULL, value INTEGER NOT NULL, word TEXT NOT NULL, PRIMARY KEY(number, value)) WITHOUT ROWID;
CREATE TABLE figure_names(number INTEGER PRIMARY KEY, name TEXT NOT NULL, unit TEXT NOT NULL);
CREATE TABLE runs(row INTEGER PRIMARY KEY, state TEXT NOT NULL, seconds REAL NOT NULL, diagnosis TEXT NOT NULL);
CREATE TABLE parameters(row INTEGER NOT NULL, number INTEGER NOT NULL, value REAL NOT NULL, PRIMARY KEY(row, number)) WITHOUT ROWID;
CREATE TABLE figures(row INTEGER NOT NULL, number INTEGER NOT NULL, value REAL, error REAL, PRIMARY KEY(row, number)) WITHOUT ROWID;
CREATE VIEW all_figures AS SELECT row, name, value, error, unit FROM figures JOIN figure_names USING (number);
)";

constexpr std::array<RowState, 3> states = {RowState::done, RowState::unconfirmed, RowState::failed};

RowState state_of(const std::string& name) {
  for (const RowState state : states)
    if (name_of(state) == name) return state;
  return RowState::failed;
}

std::int64_t whole(std::size_t n) { return static_cast<std::int64_t>(n); }

bool has_tables(const Database& database) {
  Query query(database, "SELECT count(*) FROM sqlite_master");
  return query.step() && query.integer(0) > 0;
}

bool is_sweep(const Database& database) {
  Query query(database, "SELECT count(*) FROM sqlite_master WHERE name IN ('meta', 'swept', 'runs', 'figures')");
  return query.step() && query.integer(0) == 4;
}

}  // namespace

std::string difference(const SweepIdentity& there, const SweepIdentity& asked) {
  for (const auto& [key, value] : asked.meta) {
    if (key == "scene file") continue;  // wherever it lies
    const auto found = there.meta.find(key);
    const std::string other = found == there.meta.end() ? "" : found->second;
    if (other == value) continue;
    const bool is_long = value.find('\n') != std::string::npos || other.find('\n') != std::string::npos;
    return is_long ? "another " + key : fmt::format("{} \"{}\" there, \"{}\" here", key, other, value);
  }
  return "";
}

SweepStore::SweepStore(const std::filesystem::path& file, const SweepIdentity& identity)
    : database_(std::make_unique<Database>(file)) {
  if (!has_tables(*database_)) create(identity);
  if (!is_sweep(*database_))
    throw std::invalid_argument(fmt::format("--into {}: holds no sweep; take another file", file.string()));
  identity_ = read_identity();
  if (const std::string differs = difference(identity_, identity); !differs.empty())
    throw std::invalid_argument(
        fmt::format("--into {}: holds another sweep ({}); take another file", file.string(), differs));
  if (identity_.shard != identity.shard)
    throw std::invalid_argument(
        fmt::format("--into {}: holds shard {}, not {}; a file a shard, and kurbel merge at the end", file.string(),
                    identity_.shard, identity.shard));
}

SweepStore::SweepStore(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw std::invalid_argument(
        fmt::format("{}: no such file; kurbel sweep SCENE … --into {} makes one", file.string(), file.string()));
  database_ = std::make_unique<Database>(file);
  if (!is_sweep(*database_)) throw std::invalid_argument(fmt::format("{}: holds no sweep", file.string()));
  identity_ = read_identity();
}

void SweepStore::create(const SweepIdentity& identity) {
  database_->run("BEGIN IMMEDIATE");
  database_->run(schema);
  Query meta(*database_, "INSERT INTO meta VALUES(?, ?)");
  for (const auto& [key, value] : identity.meta) meta.bind(1, key).bind(2, value).done();
  meta.bind(1, "shard").bind(2, identity.shard).done();
  meta.bind(1, "rows").bind(2, std::to_string(identity.rows)).done();
  Query swept(*database_, "INSERT INTO swept VALUES(?, ?, ?, ?)");
  Query word(*database_, "INSERT INTO words VALUES(?, ?, ?)");
  for (std::size_t k = 0; k < identity.parameters.size(); ++k) {
    const SweptParameter& p = identity.parameters[k];
    swept.bind(1, whole(k)).bind(2, p.path).bind(3, p.unit).bind(4, p.given).done();
    for (std::size_t w = 0; w < p.words.size(); ++w)
      word.bind(1, whole(k)).bind(2, whole(w)).bind(3, p.words[w]).done();
  }
  Query figure(*database_, "INSERT INTO figure_names VALUES(?, ?, ?)");
  for (std::size_t k = 0; k < identity.figures.size(); ++k)
    figure.bind(1, whole(k)).bind(2, identity.figures[k].name).bind(3, identity.figures[k].unit).done();
  database_->run("COMMIT");
}

SweepIdentity SweepStore::read_identity() const {
  SweepIdentity identity;
  Query meta(*database_, "SELECT key, value FROM meta");
  while (meta.step()) {
    if (meta.text(0) == "shard")
      identity.shard = meta.text(1);
    else if (meta.text(0) == "rows")
      identity.rows = std::stoul(meta.text(1));
    else
      identity.meta[meta.text(0)] = meta.text(1);
  }
  Query swept(*database_, "SELECT path, unit, given FROM swept ORDER BY number");
  while (swept.step())
    identity.parameters.push_back({.path = swept.text(0), .unit = swept.text(1), .given = swept.text(2)});
  Query word(*database_, "SELECT number, word FROM words ORDER BY number, value");
  while (word.step()) {
    SweptParameter& p = identity.parameters.at(static_cast<std::size_t>(word.integer(0)));
    p.values.push_back(static_cast<double>(p.words.size()));
    p.words.push_back(word.text(1));
  }
  Query figure(*database_, "SELECT name, unit FROM figure_names ORDER BY number");
  while (figure.step()) identity.figures.push_back({figure.text(0), figure.text(1)});
  return identity;
}

std::vector<bool> SweepStore::rows_there() const {
  std::vector<bool> there(identity_.rows, false);
  Query query(*database_, "SELECT row FROM runs");
  while (query.step()) there.at(static_cast<std::size_t>(query.integer(0))) = true;
  return there;
}

void SweepStore::write(const std::vector<SweepRow>& rows) {
  if (rows.empty()) return;
  if (!put_run_) {
    put_run_ = std::make_unique<Query>(*database_, "INSERT INTO runs VALUES(?, ?, ?, ?)");
    put_parameter_ = std::make_unique<Query>(*database_, "INSERT INTO parameters VALUES(?, ?, ?)");
    put_figure_ = std::make_unique<Query>(*database_, "INSERT INTO figures VALUES(?, ?, ?, ?)");
  }
  database_->run("BEGIN IMMEDIATE");
  for (const SweepRow& r : rows) {
    put_run_->bind(1, whole(r.row)).bind(2, name_of(r.state)).bind(3, r.seconds).bind(4, r.diagnosis).done();
    for (std::size_t k = 0; k < r.parameters.size(); ++k)
      put_parameter_->bind(1, whole(r.row)).bind(2, whole(k)).bind(3, r.parameters[k]).done();
    for (const RowFigure& f : r.figures)
      put_figure_->bind(1, whole(r.row))
          .bind(2, whole(f.figure))
          .bind(3, f.value)
          .bind(4, f.error.value_or(std::numeric_limits<double>::quiet_NaN()))
          .done();
  }
  database_->run("COMMIT");
}

std::size_t SweepStore::count() const {
  Query query(*database_, "SELECT count(*) FROM runs");
  return query.step() ? static_cast<std::size_t>(query.integer(0)) : 0;
}

void SweepStore::each(const Visit& visit, std::size_t from, std::size_t to) const {
  const auto within = [&](const char* what, const char* order) {
    auto query = std::make_unique<Query>(*database_,
                                         fmt::format("SELECT {} WHERE row >= ? AND row < ? ORDER BY {}", what, order));
    query->bind(1, whole(from)).bind(2, whole(to));
    return query;
  };
  const auto runs = within("row, state, seconds, diagnosis FROM runs", "row"),
             parameters = within("row, value FROM parameters", "row, number"),
             figures = within("row, number, value, error FROM figures", "row, number");
  bool more_parameters = parameters->step(), more_figures = figures->step();
  while (runs->step()) {
    SweepRow r{.row = static_cast<std::size_t>(runs->integer(0)),
               .state = state_of(runs->text(1)),
               .seconds = runs->number(2),
               .diagnosis = runs->text(3)};
    for (; more_parameters && parameters->integer(0) == whole(r.row); more_parameters = parameters->step())
      r.parameters.push_back(parameters->number(1));
    for (; more_figures && figures->integer(0) == whole(r.row); more_figures = figures->step())
      r.figures.push_back({{figures->number(2), figures->is_null(3) ? std::nullopt : std::optional(figures->number(3))},
                           static_cast<std::size_t>(figures->integer(1))});
    visit(std::move(r));
  }
}

// --- merge: shards of one sweep become one file ---

namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Equal except for times.
bool same_result(const SweepRow& a, const SweepRow& b) {
  const auto same_figure = [](const RowFigure& f, const RowFigure& g) {
    return f.figure == g.figure && same(f.value, g.value) && f.error.has_value() == g.error.has_value() &&
           (!f.error || same(*f.error, *g.error));
  };
  return a.state == b.state && a.diagnosis == b.diagnosis && a.parameters == b.parameters &&
         std::equal(a.figures.begin(), a.figures.end(), b.figures.begin(), b.figures.end(), same_figure);
}

constexpr std::size_t rows_at_a_time = 100'000;

// Identity common to all files, which must be of one sweep.
SweepIdentity identity_of_all(const std::vector<std::string>& files) {
  SweepIdentity identity;
  for (const std::string& file : files) {
    const SweepStore part(file);
    if (identity.rows == 0) identity = part.identity();
    if (const std::string differs = difference(part.identity(), identity); !differs.empty())
      throw std::invalid_argument(fmt::format("{} and {} are of two sweeps: {}", files[0], file, differs));
  }
  return identity;
}

// Rows of all files from `from` to below `to`; a row in two of them must be the same.
std::vector<SweepRow> rows_of_all(const std::vector<std::string>& files, std::size_t from, std::size_t to) {
  std::vector<SweepRow> all;
  for (const std::string& file : files)
    SweepStore(file).each([&](SweepRow&& row) { all.push_back(std::move(row)); }, from, to);
  std::stable_sort(all.begin(), all.end(), [](const SweepRow& a, const SweepRow& b) { return a.row < b.row; });
  const auto other = std::adjacent_find(all.begin(), all.end(), [](const SweepRow& a, const SweepRow& b) {
    return a.row == b.row && !same_result(a, b);
  });
  if (other != all.end())
    throw std::invalid_argument(
        fmt::format("row {} has two different results in these files; compute it again", other->row));
  all.erase(std::unique(all.begin(), all.end(), [](const SweepRow& a, const SweepRow& b) { return a.row == b.row; }),
            all.end());
  return all;
}

// Remains of a killed merge beside `into`; a process still running keeps its file.
void clean_up(const std::filesystem::path& into) {
  const std::string begins = into.filename().string() + ".part-";
  const std::filesystem::path folder = into.has_parent_path() ? into.parent_path() : ".";
  std::error_code gone;
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder, gone)) {
    const std::string name = entry.path().filename().string();
    pid_t process = 0;
    if (!name.starts_with(begins)) continue;
    const char* const end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + begins.size(), end, process);
    const std::string_view tail(read.ptr, end);
    if (read.ec != std::errc{} || process <= 0 || (tail != "" && !tail.starts_with("-"))) continue;
    if (process == getpid() || (kill(process, 0) != 0 && errno == ESRCH)) left.push_back(entry.path());
  }
  for (const std::filesystem::path& file : left) std::filesystem::remove(file, gone);
}

}  // namespace

std::size_t merge_sweeps(const std::vector<std::string>& files, const std::filesystem::path& into) {
  if (std::filesystem::exists(into))
    throw std::invalid_argument(
        fmt::format("--into {}: is there already; take another name, or remove it", into.string()));
  SweepIdentity identity = identity_of_all(files);
  identity.shard = "1/1";
  // Put in place in one step; remains of a killed merge are removed by the next one.
  clean_up(into);
  const std::filesystem::path beside = into.string() + fmt::format(".part-{}", getpid());
  std::size_t merged = 0;
  try {
    {
      SweepStore put_together(beside, identity);
      for (std::size_t from = 0; from < identity.rows; from += rows_at_a_time) {
        const std::vector<SweepRow> rows = rows_of_all(files, from, from + rows_at_a_time);
        put_together.write(rows);
        merged += rows.size();
      }
    }
    std::filesystem::rename(beside, into);
  } catch (...) {
    std::error_code gone;
    for (const char* tail : {"", "-wal", "-shm"}) std::filesystem::remove(beside.string() + tail, gone);
    throw;
  }
  return merged;
}

}  // namespace kurbel
