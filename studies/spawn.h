// spawn.h — other programs, started by name and arguments; no shell reads them.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace kurbel {

// Starts a program found by PATH, silent, in a folder (−1: here) with `kept` left open for it (−1: nothing). Returns
// its process, or −1 where there is no such program.
pid_t spawn(const std::vector<std::string>& words, int folder = -1, int kept = -1);
// True: it ended with 0.
bool ended_well(pid_t process);

}  // namespace kurbel
