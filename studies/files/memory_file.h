// memory_file.h — a file in memory, for libraries that write to a path alone; its bytes are then put where they belong.
#pragma once

#include <string>

#include "studies/files/staging.h"

namespace kurbel {

class MemoryFile {
 public:
  MemoryFile();              // throws std::runtime_error where there is no memory for it
  std::string path() const;  // as long as this stands
  std::string bytes() const;

 private:
  Descriptor file_;
};

}  // namespace kurbel
