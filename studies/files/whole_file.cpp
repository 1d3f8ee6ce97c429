// whole_file.cpp — beside first, then in place.
#include "studies/files/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

#include "studies/files/clear_away.h"
#include "studies/files/staging.h"

namespace kurbel {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

bool put_in_place(int folder, const std::string& staged, const std::string& name, Existing existing) {
  if (existing == Existing::replace) return renameat(folder, staged.c_str(), folder, name.c_str()) == 0;
  if (renameat2(folder, staged.c_str(), folder, name.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  // For file systems without such a rename: a second name is linked if free, then the first one removed.
  if (linkat(folder, staged.c_str(), folder, name.c_str(), 0) != 0) return false;
  unlinkat(folder, staged.c_str(), 0);
  return true;
}

// Deleted at the end, unless put in place.
struct StagedFile {
  int folder;
  std::string name;
  Descriptor file = {};
  bool placed = false;
  ~StagedFile() {
    if (!placed && file) unlinkat(folder, name.c_str(), 0);
  }
};

}  // namespace

std::string why_no_file_at(const std::filesystem::path& path) {
  const std::filesystem::path folder = folder_of(path);
  const std::string name = path.filename().string();
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))
    return fmt::format("there is no folder {}; make it, or give another path", folder.string());
  if (name.empty() || name == "." || name == "..") return "is a folder; give a file in it";
  if (name.size() > longest_target) return fmt::format("the name is longer than {} bytes", longest_target);
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    return S_ISDIR(status.st_mode) ? "is a folder; give a file in it" : "is no regular file; give another path";
  return why_nothing_made_in(folder);
}

bool write_whole(const std::filesystem::path& path, std::string_view text, Existing existing) {
  if (const std::string why = why_no_file_at(path); !why.empty())
    throw std::invalid_argument(fmt::format("cannot write {}: {}", path.string(), why));
  const Descriptor folder(open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder) fail_to_write(path.string(), errno);
  clear_abandoned(folder.get());
  const std::string name = path.filename().string();
  StagedFile staged{.folder = folder.get(), .name = {}};
  do {
    staged.name = staged_name({.replaced = false, .target = name});
    staged.file = make_file(folder.get(), staged.name);
  } while (!lock_own(staged.file.get(), folder.get(), staged.name));
  append(staged.file.get(), path.string(), text);
  struct stat status {};
  if (fstatat(folder.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(status.st_mode))
    fchmod(staged.file.get(), status.st_mode & 0777);
  flush(staged.file.get(), path.string());
  staged.placed = put_in_place(folder.get(), staged.name, name, existing);
  if (!staged.placed && existing == Existing::keep && errno == EEXIST) return false;
  if (!staged.placed) fail_to_write(path.string(), errno);
  flush(folder.get(), path.string());
  return true;
}

MemoryFile::MemoryFile() : file_(memfd_create("kurbel", MFD_CLOEXEC)) {
  if (!file_) fail_to_write("a file in memory", errno);
}

std::string MemoryFile::path() const { return fmt::format("/proc/self/fd/{}", file_.get()); }

std::string MemoryFile::bytes() const {
  struct stat status {};
  if (fstat(file_.get(), &status) != 0) fail_to_write("a file in memory", errno);
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t read = pread(file_.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (read <= 0) fail_to_write("a file in memory", errno);
    done += static_cast<std::size_t>(read);
  }
  return bytes;
}

}  // namespace kurbel
