// machine_info.h — the computer that times were measured on: processor, compiler, versions of relevant libraries, date.
#pragma once

#include <string>

namespace kurbel {

std::string machine_info();

}  // namespace kurbel
