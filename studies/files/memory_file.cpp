// memory_file.cpp — memfd_create(2), reached by its path in /proc.
#include "studies/files/memory_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace kurbel {

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
