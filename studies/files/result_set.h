// result_set.h — the files of one run as one thing: there together, or not at all.
//
//   ResultSet set("results/press/run");                 // a fresh folder beside, which nobody sees
//   set.add("summary.json", text);
//   set.put_in_place("kurbel run press.toml", true);    // flushed, then exchanged in one step
//
// What stood there is whole until then and gone afterwards; files in it that were not kurbel's are taken over. The
// manifest set.sha256 names all files with their SHA-256 (`sha256sum -c set.sha256` checks them) and the run that they
// are of; by it a folder is known as kurbel's. A folder without it that holds anything is never replaced.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/files/staging.h"

namespace kurbel {

// Where a run that was interrupted or failed leaves what it has: FOLDER.incomplete.
std::filesystem::path incomplete_place(const std::filesystem::path& folder);

// Why no result set can be put into a folder, with a next step; empty: it can. To be asked before anything runs.
std::string why_no_results_in(const std::filesystem::path& folder);

class ResultSet {
 public:
  // Clears away first what killed writers have left there. Throws std::runtime_error where nothing can be written.
  explicit ResultSet(const std::filesystem::path& folder);
  ~ResultSet();  // what was not put in place is gone
  ResultSet(const ResultSet&) = delete;
  ResultSet& operator=(const ResultSet&) = delete;

  // "report.html" or "plots/torque.svg"; a name too long for a file system is shortened. Throws std::runtime_error.
  void add(const std::string& name, std::string_view text);
  // Another program may write into the set's folder, and is named what it wrote. As long as it holds this descriptor,
  // nobody takes the folder for abandoned.
  int folder() const { return folder_.get(); }
  void adopt(const std::string& name);

  // Throws std::runtime_error; then all is as it was.
  void put_in_place(const std::string& made_by, bool complete);

  // As on a file system that knows no exchange: the old set is moved aside, then the new one in. Killed in between, the
  // next run moves the old one back.
  void do_without_exchange() { exchange_known_ = false; }

 private:
  std::string shown(const std::string& name) const { return (path_ / name).string(); }
  void write_manifest(const std::string& made_by, bool complete);
  void flush_all();
  bool placed();
  bool placed_by_two_moves();
  void clear_away(const std::string& replaced);

  std::filesystem::path path_;
  std::string target_, staged_;
  Descriptor parent_, folder_;
  std::vector<std::pair<std::string, std::string>> files_;  // name, SHA-256
  bool exchange_known_ = true, in_place_ = false;
};

}  // namespace kurbel
