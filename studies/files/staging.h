// staging.h — what is being put together, and by whom: names that nobody else takes, locks that end with their writer.
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

// A folder within another one (AT_FDCWD: by its path); empty where there is none. A link to a folder is none.
Descriptor open_folder(int within, const std::string& name);
std::string text_of_file(int folder, const std::string& name, std::size_t limit);  // empty where there is none
bool is_same(int descriptor, int folder, const std::string& name);
void for_each_name(int folder, const std::function<void(const std::string&)>& visit);  // without "." and ".."

// A new file in a folder, neither over what is there nor through a link. Throws std::runtime_error.
Descriptor make_file(int folder, const std::string& name);
void append(int file, const std::string& name, std::string_view text);
// Waits until it is on the disk, where the file system can tell.
void flush(int descriptor, const std::string& name);

// What is being put together stands beside what it is to become: .NAME.kurbel-new-0123456789ab. What it replaced, and
// is not yet cleared away: .NAME.kurbel-old-0123456789ab.
struct Staged {
  bool replaced = false;
  std::string target;  // NAME
};
std::string staged_name(const Staged& staged);  // another one at each call
std::optional<Staged> staged_of(std::string_view name);
inline constexpr std::size_t longest_target = 200;  // bytes of NAME

// The lock of a writer on what it puts together; the system takes it back, however the writer ends. False: somebody
// else has it, or it was cleared away under this name meanwhile. Where the file system knows no locks, what is older
// than an hour counts as abandoned.
bool lock_own(int descriptor, int folder, const std::string& name);
bool lock_abandoned(int descriptor, int folder, const std::string& name);

// Why nothing can be made in a folder, with a next step; empty: it can. Asked by doing it: what the system allows is
// more than modes (a read-only disk, /proc).
std::string why_nothing_made_in(const std::filesystem::path& folder);

}  // namespace kurbel
