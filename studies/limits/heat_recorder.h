// heat_recorder.h — an observer of slipping components: heat per engagement, and slip time.
#pragma once

#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// An engagement lasts from the start of heat generation in a component to its end by locking, standstill or release.
// Its heat is the component's harmful work, with no separate model. Only for named components.
class HeatRecorder final : public Observer {
 public:
  struct Heated {
    std::string component;
    std::vector<std::size_t> accounts = {};             // its harmful works
    double total = 0, largest = 0;                      // heat of the run, of the hottest engagement [J]
    double slips = 0;                                   // time in which it made heat [s]
    double before = 0, engagement = 0, hottest_at = 0;  // heat so far, of the current engagement [J]; hottest: end [s]
    void remember(Tape& tape) { tape(total, largest, slips, before, engagement, hottest_at); }
  };
  explicit HeatRecorder(const std::vector<std::string>& components);
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(heated_); }
  const std::vector<Heated>& heated() const { return heated_; }

 private:
  std::vector<Heated> heated_;
};

}  // namespace kurbel
