// machine_info.cpp — from the operating system; "unknown processor" if it gives none.
#include "studies/accuracy/machine_info.h"

#include <fmt/format.h>
#include <sundials/sundials_config.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace kurbel {

std::string machine_info() {
  std::ifstream file("/proc/cpuinfo");
  std::string processor = "unknown processor";
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      processor = line.substr(line.find(':') + 2);
      break;
    }
  const std::time_t now = std::time(nullptr);
  char date[16];
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
#ifdef NDEBUG
  const char* build = "release";
#else
  const char* build = "with assertions";
#endif
  return fmt::format("{}, {} threads · g++ {}, {} · SUNDIALS {} · Simbody {} · {}", processor,
                     std::thread::hardware_concurrency(), __VERSION__, build, SUNDIALS_VERSION, KURBEL_SIMBODY_VERSION,
                     date);
}

}  // namespace kurbel
