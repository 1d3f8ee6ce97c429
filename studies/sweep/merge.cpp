// merge.cpp — shards of one sweep become one file.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "studies/sweep/store.h"

namespace kurbel {
namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Times apart.
bool same_result(const SweepRow& a, const SweepRow& b) {
  const auto same_figure = [](const RowFigure& f, const RowFigure& g) {
    return f.figure == g.figure && same(f.value, g.value) && f.error.has_value() == g.error.has_value() &&
           (!f.error || same(*f.error, *g.error));
  };
  return a.state == b.state && a.diagnosis == b.diagnosis && a.parameters == b.parameters &&
         std::equal(a.figures.begin(), a.figures.end(), b.figures.begin(), b.figures.end(), same_figure);
}

std::vector<SweepRow> rows_of_all(const std::vector<std::string>& files, SweepIdentity& identity) {
  std::vector<SweepRow> all;
  for (const std::string& file : files) {
    const SweepStore part(file);
    if (all.empty() && identity.rows == 0) identity = part.identity();
    if (const std::string differs = difference(part.identity(), identity); !differs.empty())
      throw std::invalid_argument(fmt::format("{} and {} are of two sweeps: {}", files[0], file, differs));
    std::vector<SweepRow> rows = part.read();
    all.insert(all.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
  }
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

// What a killed merge left beside `into`, of a process that is no more; one still at work keeps its file.
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
  SweepIdentity identity;
  const std::vector<SweepRow> rows = rows_of_all(files, identity);
  identity.shard = "1/1";
  // Put in place in one step; what a killed merge leaves is removed by the next one.
  clean_up(into);
  const std::filesystem::path beside = into.string() + fmt::format(".part-{}", getpid());
  try {
    SweepStore(beside, identity).write(rows);
    std::filesystem::rename(beside, into);
  } catch (...) {
    std::error_code gone;
    for (const char* tail : {"", "-wal", "-shm"}) std::filesystem::remove(beside.string() + tail, gone);
    throw;
  }
  return rows.size();
}

}  // namespace kurbel
