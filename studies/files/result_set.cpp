// result_set.cpp — written next to the target, then exchanged.
#include "studies/files/result_set.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "engine/scene/messages.h"
#include "engine/scene/printable.h"
#include "studies/files/clear_away.h"

namespace kurbel {
namespace {

namespace fs = std::filesystem;

constexpr int most_attempts = 1000;  // against others that write to the same folder

// Links followed, without a slash at the end.
fs::path resolved(const fs::path& folder) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(fs::absolute(folder), error);
  if (error) path = fs::absolute(folder).lexically_normal();
  while (path.has_relative_path() && (path.filename().empty() || path.filename() == ".")) path = path.parent_path();
  return path;
}

// Why the current content of a name cannot be replaced by a result set; empty: another writer has meanwhile replaced
// it.
std::optional<std::string> why_not_replaced_now(int parent, const std::string& name, const fs::path& path) {
  struct stat status {};
  if (fstatat(parent, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return "";
  if (S_ISLNK(status.st_mode)) return fmt::format("{} is a link that leads nowhere; give a folder", path.string());
  if (!S_ISDIR(status.st_mode)) return fmt::format("{} is a file; give a folder", path.string());
  const Descriptor folder = open_folder(parent, name);
  if (!folder || faccessat(parent, name.c_str(), W_OK, 0) != 0) {
    if (errno == ENOENT) return std::nullopt;
    return fmt::format("no permission to write in {}; give another folder", path.string());
  }
  std::string found;
  for_each_name(folder.get(), [&](const std::string& entry) { found = entry; });
  if (found.empty() || files_of_set(folder.get())) return "";
  // A set that was replaced is cleared away under another name.
  if (!is_same(folder.get(), parent, name)) return std::nullopt;
  return fmt::format(
      "{} holds files that are not of a result set of kurbel ({} …), and results take their folder as a whole; give a "
      "folder of their own, e.g. {}, or move those files away",
      path.string(), in_quotes(found), (path / "results").string());
}
std::string why_not_replaced(int parent, const std::string& name, const fs::path& path) {
  for (int attempt = 0; attempt < most_attempts; ++attempt)
    if (const auto why = why_not_replaced_now(parent, name, path)) return *why;
  return fmt::format("{} is replaced all the time; give another folder", path.string());
}

// A folder that is a working directory or a mount point cannot be exchanged.
std::string why_not_moved(const fs::path& path) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (!error && std::mismatch(path.begin(), path.end(), here.begin(), here.end()).first == path.end())
    return fmt::format(
        "{} is the folder that you are in, or holds it, and results replace their folder as a whole; give one within, "
        "e.g. {}",
        path.string(), (path / "results").string());
  struct statx found {};
  if (statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &found) == 0 &&
      (found.stx_attributes_mask & found.stx_attributes & STATX_ATTR_MOUNT_ROOT))
    return fmt::format(
        "{} is where a file system is mounted, and results replace their folder as a whole; give one within, e.g. {}",
        path.string(), (path / "results").string());
  return "";
}

std::string shortened(const std::string& name) {
  const std::size_t slash = name.rfind('/') + 1;  // npos + 1 = 0
  if (name.size() - slash <= longest_target) return name;
  const std::string extension = fs::path(name).extension().string().substr(0, 16);
  return name.substr(0, slash + 150) + "-" + sha256(name).substr(0, 12) + extension;
}

}  // namespace

fs::path incomplete_place(const fs::path& folder) {
  const fs::path path = folder.has_filename() ? folder : folder.parent_path();
  return path.parent_path() / (path.filename().string() + ".incomplete");
}

std::string why_no_results_in(const fs::path& folder) {
  const fs::path path = resolved(folder);
  if (path.filename().string().size() > longest_target - 20)
    return fmt::format("the name is longer than {} bytes; give a shorter one", longest_target - 20);
  std::error_code error;
  fs::path existing = path;
  while (existing.has_relative_path() && !fs::exists(fs::symlink_status(existing, error)))
    existing = existing.parent_path();
  if (existing == path) {
    if (const std::string why = why_not_moved(path); !why.empty()) return why;
    if (const Descriptor parent = open_folder(AT_FDCWD, path.parent_path()))
      if (const std::string why = why_not_replaced(parent.get(), path.filename(), path); !why.empty()) return why;
    existing = path.parent_path();
  }
  if (!fs::is_directory(existing, error)) return fmt::format("{} is a file; give a folder", existing.string());
  return why_nothing_made_in(existing);
}

ResultSet::ResultSet(const fs::path& folder) : path_(resolved(folder)), target_(path_.filename()) {
  std::error_code error;
  fs::create_directories(path_.parent_path(), error);
  if (error) fail_to_write(path_.string(), error.value());
  parent_ = open_folder(AT_FDCWD, path_.parent_path());
  if (!parent_) fail_to_write(path_.string(), errno);
  clear_abandoned(parent_.get());
  do {
    staged_ = staged_name({.replaced = false, .target = target_});
    if (mkdirat(parent_.get(), staged_.c_str(), 0777) != 0) fail_to_write(path_.string(), errno);
    folder_ = open_folder(parent_.get(), staged_);
  } while (!folder_ || !lock_own(folder_.get(), parent_.get(), staged_));
}

ResultSet::~ResultSet() {
  if (!in_place_) delete_own(parent_.get(), staged_);
}

void ResultSet::add(const std::string& long_name, std::string_view text, const HashedBeginning& beginning) {
  const std::string name = shortened(long_name);
  const std::size_t slash = name.find('/');
  Descriptor inner;
  if (slash != std::string::npos) {
    const std::string within = name.substr(0, slash);
    if (mkdirat(folder_.get(), within.c_str(), 0777) != 0 && errno != EEXIST) fail_to_write(shown(within), errno);
    inner = open_folder(folder_.get(), within);
    if (!inner) fail_to_write(shown(within), errno);
  }
  const Descriptor file = make_file(inner ? inner.get() : folder_.get(), inner ? name.substr(slash + 1) : name);
  append(file.get(), shown(name), text);
  // Starts writing to disk; flush_all waits for it.
  sync_file_range(file.get(), 0, 0, SYNC_FILE_RANGE_WRITE);
  files_.emplace_back(name, sha256(text, beginning));
}

void ResultSet::adopt(const std::string& name) {
  constexpr std::size_t largest = 1'000'000'000;
  files_.emplace_back(name, sha256(text_of_file(folder_.get(), name, largest)));
}

void ResultSet::write_manifest(const std::string& made_by, bool complete) {
  std::string text =
      fmt::format("{}# {}; {}\n# run {}; check: sha256sum -c {}\n", manifest_begin, printable(made_by),
                  complete ? "complete" : "INCOMPLETE", staged_.substr(staged_.size() - 12), manifest_name);
  std::sort(files_.begin(), files_.end());
  for (const auto& [name, hash] : files_) text += fmt::format("{}  {}\n", hash, name);
  append(make_file(folder_.get(), manifest_name).get(), shown(manifest_name), text);
}

void ResultSet::flush_all() {
  std::vector<std::string> names = {manifest_name};
  for (const auto& [name, hash] : files_) {
    names.push_back(name);
    if (const std::size_t slash = name.find('/'); slash != std::string::npos) names.push_back(name.substr(0, slash));
  }
  for (const std::string& name : names) {
    const Descriptor file(openat(folder_.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file) fail_to_write(shown(name), errno);
    flush(file.get(), shown(name));
  }
  flush(folder_.get(), path_.string());
}

void ResultSet::put_in_place(const std::string& made_by, bool complete) {
  write_manifest(made_by, complete);
  flush_all();
  struct stat old {};
  if (fstatat(parent_.get(), target_.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0 && S_ISDIR(old.st_mode))
    fchmod(folder_.get(), old.st_mode & 07777);
  for (int attempt = 1; !placed(); ++attempt) {
    if (attempt == most_attempts) fail_to_write(path_.string(), EBUSY);
    std::this_thread::sleep_for(std::chrono::microseconds(50 * attempt));
  }
}

// In one step. False: another process interfered, try again.
bool ResultSet::placed() {
  if (!exchange_known_) return placed_by_two_moves();
  const int folder = parent_.get();
  if (renameat2(folder, staged_.c_str(), folder, target_.c_str(), RENAME_NOREPLACE) == 0) {
    in_place_ = true;
    flush(folder, path_.string());
    return true;
  }
  if (errno == EEXIST) {
    if (const std::string why = why_not_replaced(folder, target_, path_); !why.empty()) throw std::runtime_error(why);
    if (renameat2(folder, staged_.c_str(), folder, target_.c_str(), RENAME_EXCHANGE) == 0) {
      in_place_ = true;
      const std::string replaced = staged_name({.replaced = true, .target = target_});
      renameat(folder, staged_.c_str(), folder, replaced.c_str());
      clear_away(replaced);
      return true;
    }
    if (errno == ENOENT) return false;
  }
  if (errno != EINVAL && errno != ENOSYS && errno != EOPNOTSUPP) fail_to_write(path_.string(), errno);
  exchange_known_ = false;
  return false;
}

bool ResultSet::placed_by_two_moves() {
  const int folder = parent_.get();
  if (const std::string why = why_not_replaced(folder, target_, path_); !why.empty()) throw std::runtime_error(why);
  const std::string aside = staged_name({.replaced = true, .target = target_});
  const bool stood = renameat(folder, target_.c_str(), folder, aside.c_str()) == 0;
  in_place_ = renameat(folder, staged_.c_str(), folder, target_.c_str()) == 0;
  const int error = errno;
  if (in_place_ || error == ENOTEMPTY || error == EEXIST) {
    if (stood) clear_away(aside);
    if (in_place_ && !stood) flush(folder, path_.string());
    return in_place_;
  }
  if (stood) renameat(folder, aside.c_str(), folder, target_.c_str());
  fail_to_write(path_.string(), error);
}

// The new one is on the disk before the old one goes.
void ResultSet::clear_away(const std::string& replaced) {
  flush(parent_.get(), path_.string());
  clear_replaced(parent_.get(), replaced, target_);
}

}  // namespace kurbel
