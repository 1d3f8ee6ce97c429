// program_version.h — which program computed the rows: its version and a mark of what computes.
#pragma once

#include <string>

namespace kurbel {

// "kurbel 0.1.0 (3f09c2d1a5b7)": the mark follows from the text of every source of the library and from the compiler and
// its options; what computes changes it, a folder or a copy without its history does not. Two programs of one mark
// compute the same bits on one kind of processor.
std::string program_version();

}  // namespace kurbel
