// slip_recorder.h — an observer of clutches, limiters and one-way clutches: when each slips, and under which command.
#pragma once

#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// State of a joint by the command in force over a step:
//
//     open       the command is 0
//     locked     both sides turn together
//     engaging   it slips and has not locked since it was open, or the command is between 0 and 1
//     let go     it slips at full command after it had locked
class SlipRecorder final : public Observer {
 public:
  enum class State { unknown, open, locked, engaging, let_go };
  // How often and when first [s] a state was entered, and the largest slip speed in it [rad/s].
  struct Spell {
    int times = 0;
    double first = 0, fastest = 0;
    void remember(Tape& tape) { tape(times, first, fastest); }
  };
  struct Joint {
    std::string component, kind;
    std::size_t elastic = 0;
    int command = -1;        // −1: always closed
    double usual_speed = 1;  // of its driving side [rad/s]
    State state = State::unknown;
    Spell open = {}, engaging = {}, let_go = {};
    bool closed = true;                          // over the last step
    bool gripped = false, slips_closed = false;  // has ever locked; has slipped at full command since it was open
    int in_vain = 0;                             // times that it was opened again without having locked
    void remember(Tape& tape) {
      int now = static_cast<int>(state);
      tape(now, closed, gripped, slips_closed, in_vain, open, engaging, let_go);
      state = static_cast<State>(now);
    }
  };
  explicit SlipRecorder(const Model& model);
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(joints_); }
  const std::vector<Joint>& joints() const { return joints_; }

 private:
  std::vector<Joint> joints_;
};

}  // namespace kurbel
