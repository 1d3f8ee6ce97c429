// clear_away.cpp — works on descriptors; links within are deleted or moved, never followed.
#include "studies/files/clear_away.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

namespace kurbel {
namespace {

constexpr std::size_t longest_manifest = 4'000'000;

std::vector<std::string> names_in(int folder) {
  std::vector<std::string> names;
  for_each_name(folder, [&](const std::string& name) { names.push_back(name); });
  return names;
}

// Deletes all: the unfinished set of a killed writer contains only its own files.
void delete_all(int folder) {
  for (const std::string& name : names_in(folder)) {
    if (unlinkat(folder, name.c_str(), 0) == 0 || (errno != EISDIR && errno != EPERM)) continue;
    if (const Descriptor inner = open_folder(folder, name)) delete_all(inner.get());
    unlinkat(folder, name.c_str(), AT_REMOVEDIR);
  }
}

bool move_without_replacing(int from, const std::string& name, int to, const std::string& new_name) {
  if (renameat2(from, name.c_str(), to, new_name.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  // For file systems without this flag: check first.
  if (faccessat(to, new_name.c_str(), F_OK, AT_SYMLINK_NOFOLLOW) == 0) return (errno = EEXIST, false);
  return renameat(from, name.c_str(), to, new_name.c_str()) == 0;
}

// Under its own name or, if the new set has a file of that name, as NAME.kept-1, -2, …
void take_over(int from, const std::string& name, int to) {
  for (int n = 0; n < 1000; ++n)
    if (move_without_replacing(from, name, to, n == 0 ? name : fmt::format("{}.kept-{}", name, n)) || errno != EEXIST)
      return;
}

// Moves what `own` does not name; deletes what it names. `prefix`: "plots/" within that folder.
void part(int folder, const std::string& prefix, const std::set<std::string>& own, int target) {
  for (const std::string& name : names_in(folder)) {
    const std::string whole = prefix + name;
    const auto within = own.lower_bound(whole + "/");
    if (own.contains(whole)) {
      if (unlinkat(folder, name.c_str(), 0) != 0 && errno != ENOENT) take_over(folder, name, target);
    } else if (whole == manifest_name) {
      continue;
    } else if (within != own.end() && within->starts_with(whole + "/")) {
      const Descriptor inner = open_folder(folder, name);
      if (!inner) {  // a link of the user's in its place
        take_over(folder, name, target);
        continue;
      }
      // The folder in the new set is made only if files are moved there.
      for (const std::string& file : names_in(inner.get()))
        if (!own.contains(whole + "/" + file)) mkdirat(target, name.c_str(), 0777);
      const Descriptor there = open_folder(target, name);
      part(inner.get(), whole + "/", own, there.get());
      unlinkat(folder, name.c_str(), AT_REMOVEDIR);
    } else {
      take_over(folder, name, target);
    }
  }
}

}  // namespace

std::optional<std::set<std::string>> files_of_set(int folder) {
  const std::string text = text_of_file(folder, manifest_name, longest_manifest);
  if (!text.starts_with(manifest_begin)) return std::nullopt;
  std::set<std::string> files;
  constexpr std::size_t before_name = 64 + 2;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (!line.starts_with('#') && line.size() > before_name) files.insert(line.substr(before_name));
  }
  return files;
}

void delete_own(int parent, const std::string& name) {
  if (const Descriptor folder = open_folder(parent, name)) delete_all(folder.get());
  unlinkat(parent, name.c_str(), AT_REMOVEDIR);
}

void clear_replaced(int parent, const std::string& name, const std::string& target) {
  const Descriptor folder = open_folder(parent, name);
  if (!folder) return;
  const auto own = files_of_set(folder.get());
  const Descriptor there = open_folder(parent, target);  // without one, nothing is taken over
  part(folder.get(), "", own.value_or(std::set<std::string>{}), there.get());
  // The manifest is deleted last: it identifies the set as long as any of its files exist.
  const std::vector<std::string> left = names_in(folder.get());
  if (left.size() == 1 && left[0] == manifest_name) unlinkat(folder.get(), manifest_name, 0);
  unlinkat(parent, name.c_str(), AT_REMOVEDIR);
}

void clear_abandoned(int parent) {
  for (const std::string& name : names_in(parent)) {
    const auto staged = staged_of(name);
    struct stat status {};
    if (!staged || fstatat(parent, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 || status.st_uid != geteuid())
      continue;
    const bool is_folder = S_ISDIR(status.st_mode);
    if (!is_folder && !S_ISREG(status.st_mode)) continue;
    const Descriptor opened(
        openat(parent, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | (is_folder ? O_DIRECTORY : 0)));
    if (!opened || !lock_abandoned(opened.get(), parent, name)) continue;
    if (!is_folder) {
      unlinkat(parent, name.c_str(), 0);
    } else if (staged->replaced || files_of_set(opened.get())) {
      // A complete set: moved aside, and restored if no successor exists; or replaced, or about to replace.
      if (!staged->replaced || !move_without_replacing(parent, name, parent, staged->target))
        clear_replaced(parent, name, staged->target);
    } else {
      delete_all(opened.get());
      unlinkat(parent, name.c_str(), AT_REMOVEDIR);
    }
  }
}

}  // namespace kurbel
