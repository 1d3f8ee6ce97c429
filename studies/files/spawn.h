// spawn.h — starts other programs by name and arguments, without a shell.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace kurbel {

// Whether a program is found by PATH.
bool is_installed(const std::string& program);

// Starts a program found by PATH, without output and detached. −1: it could not be started.
pid_t spawn(const std::vector<std::string>& words);

// Starts and waits, for work of this program: in a folder, with `kept` left open (−1: none), killed together with
// this program. True: the program exists and ended with 0.
bool run_and_wait(const std::vector<std::string>& words, int folder, int kept = -1);

}  // namespace kurbel
