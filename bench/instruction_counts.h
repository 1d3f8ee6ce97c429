// instruction_counts.h — instructions of right-hand sides and Jacobians, counted by callgrind.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

namespace kurbel::bench {

inline bool callgrind_is_installed() { return std::system("valgrind --version > /dev/null 2>&1") == 0; }

// Of 50 evaluations each by kurbel_count_evaluations; nothing where callgrind or the program failed.
inline std::optional<long> counted_instructions(const std::string& program, const std::string& scene,
                                                const std::string& effect, const std::string& how) {
  const std::string command =
      "valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=kurbel_counted_evaluations '" +
      program + "' '" + scene + "' " + effect + " " + how + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return {};
  std::optional<long> count;
  std::array<char, 512> line{};
  while (std::fgets(line.data(), static_cast<int>(line.size()), pipe))
    if (const char* found = std::strstr(line.data(), "Collected :")) count = std::atol(found + 11);
  if (pclose(pipe) != 0) return {};
  return count;
}

}  // namespace kurbel::bench
