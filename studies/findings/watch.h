// watch.h — who watches a study at work: whether it is to stop, how far it has come, what it does.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace kurbel {

struct Watch {
  const std::atomic<bool>* interrupted = nullptr;                               // set: stop, keep what there is
  std::function<void(const std::string& what, double fraction)> progress = {};  // 0 … 1 of what is said
  std::function<void(const std::string&)> log = {};                             // what was compiled, chosen, run

  bool stopped() const { return interrupted && interrupted->load(); }
  void at(const std::string& what, double fraction) const {
    if (progress) progress(what, fraction);
  }
  void say(const std::string& text) const {
    if (log) log(text);
  }
};

}  // namespace kurbel
