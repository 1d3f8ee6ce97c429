// result_set.h — the files of one run as a unit: all of them are there, or none.
//
//   ResultSet set("results/press/run");                 // a new hidden folder next to the target
//   set.add("summary.json", text);
//   set.put_in_place("kurbel run press.toml", true);    // flushed, then exchanged in one step
//
// The previous contents stay complete until then and are deleted afterwards; files that were not kurbel's are kept.
// The manifest set.sha256 names all files with their SHA-256 (`sha256sum -c set.sha256` checks them) and the run that
// made them; it marks a folder as kurbel's. A non-empty folder without it is never replaced.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/files/sha256.h"
#include "studies/files/staging.h"

namespace kurbel {

// Where a run that was interrupted or failed stores its partial results: FOLDER.incomplete.
std::filesystem::path incomplete_place(const std::filesystem::path& folder);

// Why no result set can be put into a folder, with a next step; empty: it can. To be checked before any run.
std::string why_no_results_in(const std::filesystem::path& folder);

class ResultSet {
 public:
  // First removes what killed writers have left there. Throws std::runtime_error if the folder cannot be written.
  explicit ResultSet(const std::filesystem::path& folder);
  ~ResultSet();  // deletes what was not put in place
  ResultSet(const ResultSet&) = delete;
  ResultSet& operator=(const ResultSet&) = delete;

  // "report.html" or "plots/torque.svg"; a name too long for a file system is shortened. Throws std::runtime_error.
  void add(const std::string& name, std::string_view text, const HashedBeginning& beginning = {});
  // Another program may write into the set's folder; adopt() adds its file. As long as it holds this descriptor, the
  // folder does not count as abandoned.
  int folder() const { return folder_.get(); }
  void adopt(const std::string& name);

  // Throws std::runtime_error; then nothing has changed.
  void put_in_place(const std::string& made_by, bool complete);

  // For file systems without atomic exchange: the old set is moved aside, then the new one in. If killed in between,
  // the next run moves the old one back.
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
