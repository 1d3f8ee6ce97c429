// archive.h — files as one zip archive; the same files give the same bytes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kurbel {

// Throws std::runtime_error if the archive cannot be made.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace kurbel
