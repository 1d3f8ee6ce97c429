// in_threads.cpp — threads take items by a counter.
#include "studies/variants/in_threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace kurbel {

int threads_of(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

bool in_threads(std::size_t count, int jobs, const std::function<Worker()>& worker) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> ended = false;
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&] {
    try {
      const Worker compute = worker();
      for (std::size_t i = next++; i < count && !ended; i = next++)
        if (!compute(i)) ended = true;
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!thrown) thrown = std::current_exception();
      ended = true;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 1; k < count && k < static_cast<std::size_t>(jobs); ++k) threads.emplace_back(work);
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
  return !ended;
}

}  // namespace kurbel
