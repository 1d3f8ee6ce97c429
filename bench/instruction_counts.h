// instruction_counts.h — instructions of right-hand sides and Jacobians, and of whole runs, counted by callgrind.
#pragma once

#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif

namespace kurbel::bench {

// What callgrind looks at begins here: reading and compiling a scene under its eyes takes longer than all that is counted.
// Where its header was missing when this was compiled, it looks at all from the start.
#ifdef CALLGRIND_START_INSTRUMENTATION
inline void start_instrumentation() { CALLGRIND_START_INSTRUMENTATION; }
inline constexpr const char* instrumented_from = "--instr-atstart=no";
#else
inline void start_instrumentation() {}
inline constexpr const char* instrumented_from = "";
#endif

inline bool callgrind_is_installed() { return std::system("valgrind --version > /dev/null 2>&1") == 0; }

// Sum over the functions of one program in a callgrind file. The C library's part is omitted: what it takes to clear
// memory depends on where that memory lies.
inline long own_instructions(const std::filesystem::path& file, const std::string& program) {
  std::ifstream in(file);
  std::map<std::string, std::string> objects;  // "(3)": path
  long sum = 0;
  bool own = false, after_call = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("ob=", 0) == 0 || line.rfind("cob=", 0) == 0) {
      const std::size_t begin = line.find('(');
      const std::string number = line.substr(begin, line.find(')') - begin + 1);
      if (const std::size_t path = line.find(") "); path != std::string::npos) objects[number] = line.substr(path + 2);
      if (line[0] == 'o') own = objects[number].find(program) != std::string::npos;
    } else if (line.rfind("calls=", 0) == 0) {
      after_call = true;  // the next line is the callee's inclusive cost
    } else if (!line.empty() && (std::isdigit(line[0]) || line[0] == '+' || line[0] == '-' || line[0] == '*')) {
      if (own && !after_call) sum += std::atol(line.substr(line.find(' ') + 1).c_str());
      after_call = false;
    }
  }
  return sum;
}

// Of what kurbel_count_evaluations does in that way: 50 evaluations each, or a run; nothing where callgrind or the
// program failed.
inline std::optional<long> counted_instructions(const std::string& program, const std::string& scene,
                                                const std::string& effect, const std::string& how) {
  const auto file =
      std::filesystem::temp_directory_path() / ("kurbel_counts_" + std::to_string(getpid()) + "_" + how + ".out");
  const std::string command = std::string("valgrind --tool=callgrind ") + instrumented_from +
                              " '--callgrind-out-file=" + file.string() +
                              "' --toggle-collect=kurbel_counted_evaluations --toggle-collect=kurbel_counted_run '" +
                              program + "' '" + scene + "' " + effect + " " + how + " > /dev/null 2>&1";
  const bool ran = std::system(command.c_str()) == 0;
  std::optional<long> count;
  if (ran) count = own_instructions(file, std::filesystem::path(program).filename().string());
  std::filesystem::remove(file);
  return count;
}

// Steps that the run of kurbel_count_evaluations takes; 1 where it failed.
inline double steps_of_run(const std::string& program, const std::string& scene, const std::string& how) {
  const auto file = std::filesystem::temp_directory_path() / ("kurbel_steps_" + std::to_string(getpid()) + ".out");
  double steps = 1;
  if (std::system(("'" + program + "' '" + scene + "' - " + how + " > '" + file.string() + "' 2> /dev/null").c_str()) ==
      0)
    std::ifstream(file) >> steps;
  std::filesystem::remove(file);
  return steps;
}

}  // namespace kurbel::bench
