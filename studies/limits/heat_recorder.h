// heat_recorder.h — an observer of what slips: its heat by engagements, and how long it slips.
#pragma once

#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// An engagement lasts from where a component begins to turn work into heat to where it ends that: by locking, by rest,
// by its release. Its heat is what the component's harmful work says, no second physics. Of named components only.
class HeatRecorder final : public Observer {
 public:
  struct Heated {
    std::string component;
    std::vector<std::size_t> accounts = {};             // its harmful works
    double total = 0, largest = 0;                      // heat of the run, of the hottest engagement [J]
    double slips = 0;                                   // time in which it made heat [s]
    double before = 0, engagement = 0, hottest_at = 0;  // heat seen [J], of the engagement under way [J]; its end [s]
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
