// memory_file.h — a file in memory, for libraries that can only write to a path; its bytes are then stored elsewhere.
#pragma once

#include <string>

#include "studies/files/staging.h"

namespace kurbel {

class MemoryFile {
 public:
  MemoryFile();              // throws std::runtime_error if memory is insufficient
  std::string path() const;  // valid as long as this object
  std::string bytes() const;

 private:
  Descriptor file_;
};

}  // namespace kurbel
