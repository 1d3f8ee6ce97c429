// importer.h — a strict importer of components: it shares no code with what exports them. It unpacks, reads the description
// against the rules of the standard (docs/fmi_rules.md), loads the library, and drives it in both versions and kinds.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace importer {

struct Variable {
  std::string name, causality, variability, initial, unit;
  unsigned reference = 0;
  std::optional<double> start;
  std::optional<unsigned> derivative_of;  // value reference of the state
};

// A new one among the system's temporary folders, that whoever asks removes. Throws std::runtime_error.
std::string folder_of_its_own();

// What stands in a component's archive.
class Unpacked {
 public:
  explicit Unpacked(const std::filesystem::path& archive);
  ~Unpacked();
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;

  int fmi = 0;
  std::string token, identifier, folder;
  bool model_exchange = false, co_simulation = false;
  std::vector<Variable> variables;
  std::vector<unsigned> states, derivatives, outputs;  // value references; states in the order of their derivatives
  std::map<unsigned, std::vector<unsigned>>
      dependencies;  // of derivatives and outputs; of what is missing none are said
  std::map<std::string, std::map<std::string, int>> units;  // by their exponents of base units
  std::size_t indicators = 0;
  std::vector<std::string> complaints;  // rules that are broken, with their clauses
  std::string library() const;
  const Variable& operator[](const std::string& name) const;

 private:
  void read_description();
  void complain_unless(bool kept, const std::string& rule) {
    if (!kept) complaints.push_back(rule);
  }
};

// The library, loaded once for all of its instances.
class Library {
 public:
  explicit Library(const std::string& path);
  ~Library();
  void* find(const std::string& function) const;  // null: missing
 private:
  void* handle_;
};
const std::vector<std::string>& functions_of(int fmi);

enum class Kind { co_simulation, model_exchange };

// One instance in either version. Statuses other than OK are thrown as std::runtime_error with what was logged last.
class Slave {
 public:
  Slave(const Unpacked& unpacked, const Library& library, Kind kind, const std::string& name = "one");
  ~Slave();
  Slave(const Slave&) = delete;

  void initialise(double start);
  double get(unsigned reference);
  void set(unsigned reference, double value);
  double operator[](const std::string& name) { return get(unpacked_[name].reference); }
  void set(const std::string& name, double value) { set(unpacked_[name].reference, value); }
  void slope(const std::string& name, double value);  // FMI 2: of an input over the next step
  double step(double t, double h);                    // the time that was reached
  // FMI 3: what the callback sees; FMI 2 has none.
  std::function<bool(double t)> onlooker;

  void* keep();  // state
  void restore(void* state);
  void free_state(void* state);
  std::string serialise(void* state);
  void* deserialise(const std::string& bytes);

  struct Event {
    bool states_changed = false;
    std::optional<double> next;
  };
  Event discrete();  // event mode until nothing more is needed, then continuous time
  void enter_events();
  void time(double t);
  void states(const std::vector<double>& x);
  std::vector<double> states();
  std::vector<double> rates();
  std::vector<double> indicators();
  std::vector<double> nominals();
  bool completed();
  double directional(unsigned unknown, unsigned known);
  double adjoint(const std::vector<unsigned>& unknowns, const std::vector<double>& seeds, unsigned known);  // FMI 3
  void terminate();
  void reset();
  int raw_step_in_wrong_state();  // the status of a step that must be refused
  std::vector<std::string> logged;

 private:
  template <class F>
  F function(const char* after_prefix) const;
  void expect(int status, const char* what) const;
  const Unpacked& unpacked_;
  const Library& library_;
  Kind kind_;
  void* instance_ = nullptr;
  struct Callbacks;
  std::unique_ptr<Callbacks> callbacks_;
};

// Model exchange by an integrator of its own (Dormand and Prince's 5(4) pair) that finds crossings of indicators by
// bisection. Calls `seen` at each of the given times.
struct Crossings {
  std::vector<double> times;
};
Crossings integrate(Slave& slave, double start, const std::vector<double>& times, double tolerance,
                    const std::function<void(std::size_t k)>& seen);

}  // namespace importer
