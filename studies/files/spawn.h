// spawn.h — other programs, started by name and arguments; no shell reads them.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace kurbel {

// Whether PATH leads to a program.
bool is_installed(const std::string& program);

// Starts a program found by PATH, silent, to go on by itself. −1: it could not be started.
pid_t spawn(const std::vector<std::string>& words);

// The same for work of this program: in a folder, with `kept` left open for it (−1: nothing), and killed with this
// program. True: there is such a program, and it ended with 0.
bool run_and_wait(const std::vector<std::string>& words, int folder, int kept = -1);

}  // namespace kurbel
