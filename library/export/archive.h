// archive.h — files as one zip archive, the same bytes from the same files; the run-time that goes into it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kurbel {

// Throws std::runtime_error if the archive cannot be made.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files);

// A shared library for Linux on x86-64 that depends on libc and libstdc++ only.
std::string_view run_time_image();

}  // namespace kurbel
