// in_threads.h — items computed one after the other, by one thread or by several.
#pragma once

#include <cstddef>
#include <functional>

namespace kurbel {

// One for each core, unless 1 or more are asked for.
int threads_of(int asked);

// Computes an item by its number; false: it was interrupted, and no thread takes a further one.
using Worker = std::function<bool(std::size_t item)>;

// Items 0 … count − 1, each by the thread that is free next; the calling thread is one of `jobs`, so that with one job
// the items follow one another in it. `worker` makes one for each thread, in that thread. False: one was interrupted.
// What a worker throws is thrown here, once the others have ended their items.
bool in_threads(std::size_t count, int jobs, const std::function<Worker()>& worker);

}  // namespace kurbel
