// watch.h — observer of a running study: stop request, progress, log.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace kurbel {

struct Watch {
  const std::atomic<bool>* interrupted = nullptr;                               // set: stop and keep the results
  std::function<void(const std::string& what, double fraction)> progress = {};  // 0 … 1 of the named work
  std::function<void(const std::string&)> log = {};                             // what was compiled, selected, run

  bool stopped() const { return interrupted && interrupted->load(); }
  void at(const std::string& what, double fraction) const {
    if (progress) progress(what, fraction);
  }
  void say(const std::string& text) const {
    if (log) log(text);
  }
};

}  // namespace kurbel
