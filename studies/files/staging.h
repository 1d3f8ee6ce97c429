// staging.h — files being written, and their writer: unique names, and locks that end with their writer.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace kurbel {

// An open file or folder.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  int get() const { return descriptor_; }
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

// "cannot write NAME: No space left on device"
[[noreturn]] void fail_to_write(const std::string& name, int error);

// A folder within another one (AT_FDCWD: by its path); empty if there is none. A link to a folder does not count.
Descriptor open_folder(int within, const std::string& name);
std::string text_of_file(int folder, const std::string& name, std::size_t limit);  // empty if there is none
bool is_same(int descriptor, int folder, const std::string& name);
void for_each_name(int folder, const std::function<void(const std::string&)>& visit);  // without "." and ".."

// Creates a file in a folder; fails if the name exists, also as a link. Throws std::runtime_error.
Descriptor make_file(int folder, const std::string& name);
void append(int file, const std::string& name, std::string_view text);
// Waits until the data are on the disk, where the file system supports it.
void flush(int descriptor, const std::string& name);

// A set being written lies next to its target: .NAME.kurbel-new-0123456789ab. A replaced one not yet cleared away:
// .NAME.kurbel-old-0123456789ab.
struct Staged {
  bool replaced = false;
  std::string target;  // NAME
};
std::string staged_name(const Staged& staged);  // different at each call
std::optional<Staged> staged_of(std::string_view name);
inline constexpr std::size_t longest_target = 200;  // bytes of NAME

// A writer's lock on its own staged set; released by the system however the writer ends. False: another process has
// it, or it was cleared away meanwhile. On file systems without locks, sets older than an hour count as abandoned.
bool lock_own(int descriptor, int folder, const std::string& name);
bool lock_abandoned(int descriptor, int folder, const std::string& name);

// Why nothing can be created in a folder, with a next step; empty: it can. Tested by doing it, as permissions do not
// show everything (a read-only disk, /proc).
std::string why_nothing_made_in(const std::filesystem::path& folder);

}  // namespace kurbel
