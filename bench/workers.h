// workers.h — tasks in processes of their own: what one breaks or spends, the others do not feel.
#pragma once

#include <functional>
#include <string>

namespace kurbel::bench {

struct TaskEnd {
  std::size_t task = 0;
  bool whole = false;
  std::string text;   // what the task returned
  std::string words;  // why it did not
};

// Tasks 0 … count − 1, at most `jobs` at once; each may take so much processor time. `take` is called in this process,
// in the order of their ends. `go_on` is asked before each task.
void run_tasks(std::size_t count, int jobs, int seconds_each, const std::function<std::string(std::size_t)>& task,
               const std::function<void(const TaskEnd&)>& take, const std::function<bool()>& go_on);

}  // namespace kurbel::bench
