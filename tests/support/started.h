// started.h — waiting until a program that was started handles what is sent to it.
#pragma once

#include <signal.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace kurbel::test {

// Until `child` has a handler for Ctrl-C (SigCgt of its status, proc(5)), at most 20 s: however slowly it starts.
inline void wait_for_handler(pid_t child) {
  for (int tried = 0; tried < 2000; ++tried, std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:") && (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1)) return;
  }
}

}  // namespace kurbel::test
