// machine_info.h — the machine that times belong to: processor, compiler, versions of the libraries that count, date.
#pragma once

#include <string>

namespace kurbel {

std::string machine_info();

}  // namespace kurbel
