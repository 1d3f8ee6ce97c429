// instance.h — one exported machine in operation, stepped by itself (co-simulation) or by its importer (model exchange). It
// is independent of the types of the interface. Errors are exceptions that leave it as it was before the call.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "library/fmi/variables.h"

namespace kurbel {

// The complete state of an instance between two calls.
struct InstanceState {
  Checkpoint here;
  std::vector<double> parameters, inputs;
  std::vector<double> applied;  // inputs as currently applied to the machine
  std::vector<double> slopes;   // of the inputs, over the next step [1/s]
  std::vector<double> peaks;
  bool started = false, stale = true;
  double begin = 0;
  bool operator==(const InstanceState&) const = default;
};

class Instance {
 public:
  // Throws std::exception if the machine cannot be made from its data.
  Instance(ExportedMachine machine, std::string folder);

  const ExportedMachine& machine() const { return machine_; }
  const ExportedView& view() const { return *view_; }
  std::size_t state_count() { return made().state_count(); }
  std::size_t indicator_count() { return made().guard_count(); }

  // --- before it runs ---
  void set_up(double begin, std::optional<double> tolerance);
  void reset();
  // Starts the run: from here on inputs and parameters take effect.
  void begin();

  // --- variables, by value reference; std::invalid_argument for one that does not exist or cannot be set ---
  double value(std::uint32_t reference);
  // `before_start`: fixed parameters may be set as well.
  void set(std::uint32_t reference, double value, bool before_start);
  void set_slope(std::uint32_t reference, double slope);
  double time() const { return moment_ ? moment_->t : s_.here.state.t; }

  // --- co-simulation ---
  // Returns the time reached. `look` is called at the end of each integrator step and ends the call there by returning
  // false. Throws std::runtime_error with the diagnosis if the machine cannot continue; its state is then unchanged.
  double go(double step, const std::function<bool(double t)>& look);
  std::vector<Event> take_events() { return std::exchange(events_, {}); }

  // --- model exchange ---
  void set_time(double t);
  void set_states(std::span<const double> y);
  void states(std::span<double> y);
  void nominals(std::span<double> scale);
  // False: no accelerations satisfy the friction laws.
  bool derivatives(std::span<double> rate);
  void indicators(std::span<double> z);
  struct Discrete {
    bool states_changed = false;
    std::optional<double> next;  // [s]
  };
  Discrete pass_events();
  bool wants_event();  // angles are so large that whole turns must be subtracted
  // Σ_k ∂(unknown)/∂(known k) · seed_k
  std::vector<double> directional(std::span<const std::uint32_t> unknowns, std::span<const std::uint32_t> knowns,
                                  std::span<const double> seed);

  // --- all of it ---
  InstanceState state();
  void restore(const InstanceState& state);
  std::string text(const InstanceState& state);
  InstanceState state_from(const std::string& text);

 private:
  Equations& made();
  void compile();
  void start();
  void follow_parameters();
  double apply_inputs();
  void put_commands(double until);
  void check_input(std::size_t k, double value) const;
  const ExportedVariable& variable(std::uint32_t reference) const;
  void add_differences(std::span<const std::uint32_t> unknowns, double h, const std::function<void(double by)>& move,
                       std::vector<double>& result);
  const Snapshot& now();

  ExportedMachine machine_;
  std::string folder_;
  std::optional<double> tolerance_;
  InstanceState s_;
  std::vector<double> compiled_;  // parameters that the model was compiled with
  std::unique_ptr<Equations> equations_;
  std::unique_ptr<ExportedView> view_;
  std::vector<std::size_t> commands_;
  std::vector<Event> events_;
  struct Moment {
    double t = 0;
    std::vector<double> y;
  };
  std::optional<Moment> moment_;  // during a callback within a step: its time and states
};

}  // namespace kurbel
