// in_threads.h — processes items one after another, in one thread or several.
#pragma once

#include <cstddef>
#include <functional>

namespace kurbel {

// One thread per core, unless 1 or more are requested.
int threads_of(int asked);

// Processes an item by its index; false: interrupted, no further items are started.
using Worker = std::function<bool(std::size_t item)>;

// Items 0 … count − 1, each by the next free thread; the calling thread is one of `jobs`, so that with one job all
// items run in it, in order. `worker` creates the worker of each thread, in that thread. False: interrupted.
// Exceptions of a worker are rethrown here, once the others have finished their items.
bool in_threads(std::size_t count, int jobs, const std::function<Worker()>& worker);

}  // namespace kurbel
