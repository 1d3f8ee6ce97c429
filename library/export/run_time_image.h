// run_time_image.h — the run-time of exported components, as it was built with this program.
#pragma once

#include <string_view>

namespace kurbel {

// A shared library of Linux on x86-64 that needs libc and libstdc++ alone.
std::string_view run_time_image();

}  // namespace kurbel
