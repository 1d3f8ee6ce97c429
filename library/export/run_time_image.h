// run_time_image.h — the run-time of exported components, built together with this program.
#pragma once

#include <string_view>

namespace kurbel {

// A shared library for Linux on x86-64 that depends on libc and libstdc++ only.
std::string_view run_time_image();

}  // namespace kurbel
