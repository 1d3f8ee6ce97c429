// staging.cpp — folders and files by descriptors, so that no link can be inserted in between.
#include "studies/files/staging.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace kurbel {
namespace {

constexpr std::string_view fresh_mark = ".kurbel-new-", replaced_mark = ".kurbel-old-";
constexpr std::size_t random_digits = 12;
constexpr std::time_t abandoned_after = 3600;  // s, where there are no locks

bool knows_no_locks(int error) { return error == EBADF || error == ENOLCK || error == EOPNOTSUPP || error == EINVAL; }

std::string random_text() {
  std::array<unsigned char, random_digits / 2> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers");
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) close(descriptor_);
}

void fail_to_write(const std::string& name, int error) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", name, std::generic_category().message(error)));
}

Descriptor open_folder(int within, const std::string& name) {
  return Descriptor(openat(within, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

std::string text_of_file(int folder, const std::string& name, std::size_t limit) {
  const Descriptor file(openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return "";
  std::string text;
  char piece[1 << 14];
  for (ssize_t n; text.size() < limit && (n = read(file.get(), piece, sizeof piece)) != 0;) {
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return "";
    text.append(piece, static_cast<std::size_t>(n));
  }
  return text;
}

bool is_same(int descriptor, int folder, const std::string& name) {
  struct stat own {
  }, named{};
  return fstat(descriptor, &own) == 0 && fstatat(folder, name.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 &&
         own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

void for_each_name(int folder, const std::function<void(const std::string&)>& visit) {
  // A separate descriptor: it has its own position within the folder.
  const int own = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (own < 0) return;
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(fdopendir(own), closedir);
  if (!entries) return;
  while (const dirent* entry = readdir(entries.get())) {
    const std::string name = entry->d_name;
    if (name != "." && name != "..") visit(name);
  }
}

Descriptor make_file(int folder, const std::string& name) {
  Descriptor file(openat(folder, name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!file) fail_to_write(name, errno);
  return file;
}

void append(int file, const std::string& name, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = write(file, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail_to_write(name, n < 0 ? errno : ENOSPC);
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

void flush(int descriptor, const std::string& name) {
  while (fsync(descriptor) != 0) {
    if (errno == EINTR) continue;
    if (errno == EINVAL || errno == EROFS || errno == ENOSYS) return;  // a file system that keeps nothing on a disk
    fail_to_write(name, errno);
  }
}

std::string staged_name(const Staged& staged) {
  return fmt::format(".{}{}{}", staged.target, staged.replaced ? replaced_mark : fresh_mark, random_text());
}

std::optional<Staged> staged_of(std::string_view name) {
  constexpr std::size_t tail = fresh_mark.size() + random_digits;
  if (name.size() < tail + 2 || name[0] != '.') return std::nullopt;
  const std::string_view end = name.substr(name.size() - tail);
  const bool replaced = end.starts_with(replaced_mark);
  if (!(replaced || end.starts_with(fresh_mark)) ||
      end.find_first_not_of("0123456789abcdef", fresh_mark.size()) != std::string_view::npos)
    return std::nullopt;
  return Staged{replaced, std::string(name.substr(1, name.size() - tail - 1))};
}

// Between creation and locking another process may have treated it as abandoned and removed it: the name is then gone.
bool lock_own(int descriptor, int folder, const std::string& name) {
  if (flock(descriptor, LOCK_EX) != 0 && !knows_no_locks(errno)) return false;
  return is_same(descriptor, folder, name);
}

// The name is checked again under the lock: its writer may have put it in place and ended meanwhile; it is then the
// result itself.
bool lock_abandoned(int descriptor, int folder, const std::string& name) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    struct stat status {};
    if (!knows_no_locks(errno) || fstat(descriptor, &status) != 0) return false;
    if (std::time(nullptr) - status.st_mtime < abandoned_after) return false;
  }
  return is_same(descriptor, folder, name);
}

std::string why_nothing_made_in(const std::filesystem::path& folder) {
  const std::string name = (folder / staged_name({.replaced = false, .target = "trial"})).string();
  if (mkdir(name.c_str(), 0700) == 0) {
    rmdir(name.c_str());
    return "";
  }
  if (errno == EACCES || errno == EPERM || errno == EROFS)
    return fmt::format("no permission to write in {}; give another place", folder.string());
  return fmt::format("cannot write in {}: {}; give another place", folder.string(),
                     std::generic_category().message(errno));
}

}  // namespace kurbel
