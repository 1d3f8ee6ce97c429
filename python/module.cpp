// module.cpp — kurbel._kurbel: the library as Python types. What is specific to Python (dicts, pandas, sweeps) is in
// the package beside it.
#include <fmt/format.h>
#include <kurbel/kurbel.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>

namespace py = pybind11;
using namespace kurbel;  // NOLINT: this file is their rendering

namespace {

// Computes in a separate thread without Python's lock; the calling thread checks for signals, so that Ctrl-C ends the
// study and is raised afterwards.
template <class Ask>
auto computed(const Ask& ask) {
  std::atomic<bool> interrupted{false};
  Watcher watcher;
  watcher.interrupted = &interrupted;
  const auto get = [&] {
    py::gil_scoped_release released;
    auto answer = std::async(std::launch::async, [&] { return ask(watcher); });
    bool raised = false;
    while (answer.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
      if (raised) continue;
      py::gil_scoped_acquire held;
      raised = PyErr_CheckSignals() != 0;
      if (raised) interrupted = true;
    }
    if (raised) {
      answer.wait();
      py::gil_scoped_acquire held;
      throw py::error_already_set();
    }
    return answer.get();
  };
  return get();
}

// For short calls that read and compile: other Python threads continue meanwhile.
constexpr py::call_guard<py::gil_scoped_release> without_lock;

// Read-only array on the memory of the run, which it keeps alive.
py::array_t<double> array_of(const TimeSeries& series) {
  auto* const kept = new std::shared_ptr<const void>(series.kept());
  const py::capsule owner(kept, [](void* held) { delete static_cast<std::shared_ptr<const void>*>(held); });
  py::array_t<double> array({static_cast<py::ssize_t>(series.size())},
                            {static_cast<py::ssize_t>(series.stride() * sizeof(double))}, series.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// SceneError(ValueError) with the places of all faults.
py::object& scene_error() {
  static py::object* const type = new py::object;  // never destroyed: the interpreter goes first
  return *type;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const BadScene& bad) {
    py::list places;
    for (const Fault& f : bad.faults()) places.append(py::make_tuple(f.file, f.line, f.column, f.text));
    py::object error = scene_error()(bad.what());
    error.attr("places") = places;
    PyErr_SetObject(scene_error().ptr(), error.ptr());
  } catch (const std::out_of_range& missing) {
    PyErr_SetString(PyExc_KeyError, missing.what());
  }
}

void bind_machine(py::module_& m) {
  py::class_<Machine>(m, "Machine", "A machine as its scene describes it, read and checked. Never changes.")
      .def_static("from_file", &Machine::from_file, without_lock, py::arg("path"), py::arg("settings") = Settings{},
                  "Reads a scene's file. Raises SceneError with all faults at once.")
      .def_static("from_text", &Machine::from_text, without_lock, py::arg("text"), py::arg("file") = "text",
                  py::arg("settings") = Settings{}, "Reads a scene's text; data files are looked for beside `file`.")
      .def("with_settings", &Machine::with, without_lock, py::arg("settings"), "The same with further settings put in.")
      .def_property_readonly("title", &Machine::title, "as the scene says")
      .def_property_readonly("file", &Machine::file, "its name in messages")
      .def_property_readonly("text", &Machine::text, "the scene's text with its settings put in")
      .def_property_readonly("effects", &Machine::effects, "the effects that the scene names, in words")
      .def_property_readonly("components", &Machine::components, "along the lines, then by name")
      .def_property_readonly("until", &Machine::until, "end of its run [s]")
      .def_property_readonly("accuracy", &Machine::accuracy, "requested for every figure, over its scale")
      .def("figures", &Machine::figures, without_lock, "(name, unit) of the figures that its runs may yield.")
      .def("explain", &Machine::explain, without_lock, "What is merged, the coordinates and their inertias.")
      .def("__repr__",
           [](const Machine& m) { return fmt::format("<Machine {}: {}>", m.file(), fmt::join(m.components(), ", ")); });
}

void bind_study(py::module_& m) {
  py::class_<Study>(m, "StudyOutput", "What a study found.")
      .def_property_readonly("conclusion", &Study::conclusion, "in one line")
      .def_property_readonly("text", &Study::text, "all of it, for a terminal")
      .def_property_readonly("json", &Study::json, "summary.json as text")
      .def_property_readonly("html", &Study::html, "the page, whole in itself")
      .def_property_readonly("complete", &Study::complete, "it came to its end")
      .def_property_readonly("diagnosis", &Study::diagnosis, "why it is not complete, in words")
      .def_property_readonly("unconfirmed", &Study::unconfirmed,
                             "why the requested accuracy is not confirmed; empty: it is")
      .def_property_readonly("figures", &Study::figures, "of all models, in the order of the summary")
      .def_property_readonly("tables", &Study::tables, "(name, text) of the CSV files")
      .def("write", &Study::write, without_lock, py::arg("folder"), py::arg("formats") = "csv",
           "summary.json, report.html and tables, whole or not there. Formats of the tables: \"csv,mat,xlsx\".");
  m.def(
      "study",
      [](const std::string& name, const Machine* machine, const Options& options) {
        return computed([&](const Watcher& watcher) {
          return machine ? study(name, *machine, options, watcher) : study(name, options, watcher);
        });
      },
      py::arg("name"), py::arg("machine"), py::arg("options") = Options{});
  m.def(
      "diff",
      [](const Machine& a, const Machine& b, const Options& options) {
        return computed([&](const Watcher& watcher) { return diff(a, b, options, watcher); });
      },
      py::arg("a"), py::arg("b"), py::arg("options") = Options{});
  m.def("study_names", &study_names, "What study() may be asked: \"compare\", \"steady\", …");
  m.def("needs_machine", &needs_machine, py::arg("study"));
  m.def("option_names", &option_names, py::arg("study"), "The options of one of study_names().");
}

void bind_words(py::module_& m) {
  m.def(
      "explain", &explain, py::arg("figure"),
      "What figures of this name mean: definition, formula, unit, what it is not. Raises ValueError with the nearest.");
  m.def("explained_figures", &explained_figures, "The names that explain() knows: \"delta\", \"peak_torque\", …");
  m.def("kinds", &kinds, "What may stand in a scene: \"coupling\", \"induction motor\", \"run\", …");
  m.def("keys", &keys, py::arg("kind"), "The keys of one of kinds(), a line each: unit, default, domain.");
  m.def("schema_text", &schema);
  m.def("example_scenes", &example_scenes, "Machines that new() has a scene of: \"press\", \"pump\", …");
  m.def("example_scene", &example_scene, py::arg("name"));
}

// Rows for the package: varied parameters, their values per row, and each row's figures and reason of failure.
py::tuple as_python(const SweepRows& rows) {
  py::list parameters, results;
  for (const SweepLine& line : rows.lines) {
    py::dict figures;
    for (std::size_t k = 0; k < rows.columns.size(); ++k)
      if (line.figures[k])
        figures[py::str(rows.columns[k].name)] = py::make_tuple(*line.figures[k], line.errors[k], rows.columns[k].unit);
    parameters.append(line.parameters);
    results.append(py::make_tuple(figures, line.state == "failed" ? py::object(py::str(line.diagnosis)) : py::none()));
  }
  return py::make_tuple(rows.vary, parameters, results);
}

void bind_sweep(py::module_& m) {
  m.def(
      "sweep",
      [](const Machine& machine, const std::vector<std::string>& vary, const std::string& design, std::uint64_t seed,
         const std::vector<std::string>& figures, const std::string& of, const std::string& into, int jobs) {
        return as_python(computed([&](const Watcher& watcher) {
          return sweep(machine, {vary, design, seed}, figures, {.into = into, .jobs = jobs, .watcher = watcher}, of);
        }));
      },
      py::arg("machine"), py::arg("vary"), py::arg("design"), py::arg("seed"), py::arg("figures"), py::arg("of"),
      py::arg("into"), py::arg("jobs"));
  m.def(
      "rows_in", [](const std::string& file) { return as_python(rows_in(file)); }, py::arg("file"));
  m.def("sweep_report", &sweep_report, without_lock, py::arg("file"), py::arg("limits"));
  m.def("merge", &merge, without_lock, py::arg("files"), py::arg("into"),
        "Shards of one sweep into one file; how many rows it has.");
  m.def(
      "answer",
      [](const Machine& machine, const std::string& of, bool no_error) {
        const SweepAnswer found =
            computed([&](const Watcher& watcher) { return answer(machine, of, no_error, watcher); });
        py::dict figures;
        for (const FigureValue& f : found.figures) figures[py::str(f.name)] = f;
        return py::make_tuple(found.state, found.diagnosis, figures);
      },
      py::arg("machine"), py::arg("of"), py::arg("no_error"));
}

void bind_run(py::module_& m) {
  py::class_<FigureValue>(m, "Figure", "A figure in SI units with its measured error.")
      .def_readonly("name", &FigureValue::name, "\"peak_torque.main_coupling\"; explain() says what it means")
      .def_readonly("value", &FigureValue::value, "in `unit`; speeds in rad/s")
      .def_readonly("unit", &FigureValue::unit, "\"N*m\"; empty: a plain number")
      .def_readonly("error", &FigureValue::error, "measured by further runs, in `unit`; None: not measured")
      .def_readonly("at", &FigureValue::at, "the moment that it belongs to [s], or None")
      .def_readonly("of", &FigureValue::of, "the model, where a study has several: \"rigid\"; empty: the only one")
      .def("__float__", [](const FigureValue& f) { return f.value; })
      .def("__repr__", [](const FigureValue& f) {
        const std::string error = f.error ? fmt::format(" ± {:.2g}", *f.error) : "";
        return fmt::format("<Figure {} = {:.10g}{}{}{}>", f.name, f.value, error, f.unit.empty() ? "" : " ", f.unit);
      });
  py::class_<RunEvent>(m, "Event", "Something that happened in a run.")
      .def_readonly("t", &RunEvent::t, "[s]")
      .def_readonly("component", &RunEvent::component, "where; empty: the machine as a whole")
      .def_readonly("what", &RunEvent::what, "in words: \"sticks\"")
      .def("__repr__",
           [](const RunEvent& h) { return fmt::format("<Event at {:.6g} s: {}: {}>", h.t, h.component, h.what); });
  py::class_<Run>(m, "RunOutput")
      .def_property_readonly("complete", &Run::complete)
      .def_property_readonly("diagnosis", &Run::diagnosis)
      .def_property_readonly("figures",
                             [](const Run& run) {
                               py::dict figures;
                               for (const FigureValue& f : run.figures()) figures[py::str(f.name)] = f;
                               return figures;
                             })
      .def_property_readonly("names", [](const Run& run) { return run.trajectory().names(); })
      .def_property_readonly("units", [](const Run& run) { return run.trajectory().units(); })
      .def_property_readonly("time", [](const Run& run) { return array_of(run.trajectory().time()); })
      .def("series", [](const Run& run, const std::string& name) { return array_of(run.trajectory()[name]); })
      .def_property_readonly("events", &Run::events)
      .def_property_readonly("measured_accuracy", &Run::measured_accuracy)
      .def_property_readonly("processor_seconds", &Run::processor_seconds)
      .def_property_readonly("study", [](const Run& run) { return run.study(); });
  m.def(
      "run",
      [](const Machine& machine, std::optional<std::string> effects, std::optional<std::string> method,
         std::optional<double> accuracy, std::optional<double> until, bool no_error, bool page, bool no_trials,
         const std::string& measured, const std::vector<std::string>& map, const std::string& shift,
         const std::vector<std::string>& offset, const std::string& from_state) {
        return computed([&](const Watcher& watcher) {
          return run(machine, {.effects = effects,
                               .method = method,
                               .accuracy = accuracy,
                               .until = until,
                               .no_error = no_error,
                               .page = page,
                               .no_trials = no_trials,
                               .measured = measured,
                               .map = map,
                               .shift = shift,
                               .offset = offset,
                               .from_state = from_state,
                               .watcher = watcher});
        });
      },
      py::arg("machine"), py::kw_only(), py::arg("effects") = py::none(), py::arg("method") = py::none(),
      py::arg("accuracy") = py::none(), py::arg("until") = py::none(), py::arg("no_error") = false,
      py::arg("page") = true, py::arg("no_trials") = true, py::arg("measured") = "",
      py::arg("map") = std::vector<std::string>{}, py::arg("shift") = "",
      py::arg("offset") = std::vector<std::string>{}, py::arg("from_state") = "");
}

// A motion with the mark that a thread is in a call of it: calls that compute go without Python's lock.
struct SharedMotion {
  SharedMotion(const Machine& machine, const std::string& effects, double tolerance)
      : motion(machine, effects, tolerance) {}
  Motion motion;
  std::atomic<bool> busy{false};
};

// A motion for the length of one call, for nobody else meanwhile.
class Use {
 public:
  explicit Use(SharedMotion& shared) : shared_(shared) {
    if (shared.busy.exchange(true)) throw std::runtime_error("this Motion is in use by another thread");
  }
  ~Use() { shared_.busy = false; }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  Motion& operator*() const { return shared_.motion; }
  Motion* operator->() const { return &shared_.motion; }

 private:
  SharedMotion& shared_;
};

// A member of Motion as a call that refuses to be made beside another one.
template <class Answer, class... Given>
auto alone(Answer (Motion::*member)(Given...) const) {
  return [member](SharedMotion& shared, Given... given) { return ((*Use(shared)).*member)(given...); };
}
template <class Answer, class... Given>
auto alone(Answer (Motion::*member)(Given...)) {
  return [member](SharedMotion& shared, Given... given) { return ((*Use(shared)).*member)(given...); };
}

void bind_motion(py::module_& m) {
  py::class_<SavedState>(
      m, "State",
      "A moment of a machine as a value, to compare and to keep: its text is exact, Motion.state_from reads it.")
      .def_property_readonly("time", &SavedState::time, "[s]")
      .def_property_readonly("y", &SavedState::y, "angles, twists, speeds, internal states: Motion.state_names")
      .def_property_readonly("text", &SavedState::text, "JSON, exact")
      .def("__repr__", [](const SavedState& s) { return fmt::format("<State at {:.10g} s>", s.time()); })
      .def(
          "__eq__", [](const SavedState& a, const SavedState& b) { return a == b; }, py::arg("other"),
          py::is_operator());
  py::class_<SharedMotion>(m, "Motion",
                           "A machine in motion under its user's hands. For one thread at a time: while one is in a "
                           "call, those of the others raise RuntimeError.")
      .def(py::init<const Machine&, const std::string&, double>(), without_lock, py::arg("machine"),
           py::arg("effects") = "", py::arg("tolerance") = 1e-9)
      .def_property_readonly("time", alone(&Motion::time), "[s]")
      .def(
          "go_to",
          [](SharedMotion& motion, double time) {
            const Use use(motion);
            computed([&](const Watcher& watcher) { use->go_to(time, watcher); });
          },
          py::arg("time"), "On to a time [s], through all events on the way. Interrupted, it stands where it stood.")
      .def_property_readonly("state", alone(&Motion::state), "this moment, to come back to")
      .def("restore", alone(&Motion::restore), without_lock, py::arg("state"), "Back to a state of this machine.")
      .def("state_from", alone(&Motion::state_from), py::arg("text"), "A state of this machine from its text.")
      .def_property_readonly("names", alone(&Motion::names), "of all that can be read")
      .def_property_readonly("units", alone(&Motion::units), "SI, in the order of the names")
      .def_property_readonly("state_names", alone(&Motion::state_names), "what the entries of State.y are")
      .def_property_readonly("values", alone(&Motion::values), "of all names, now")
      .def("__getitem__", alone(&Motion::operator[]), py::arg("name"), "A quantity now, in SI.")
      .def("__repr__", [](SharedMotion& shared) {
        if (shared.busy) return std::string("<Motion in use by another thread>");
        return fmt::format("<Motion at {:.10g} s>", Use(shared)->time());
      });
}

}  // namespace

PYBIND11_MODULE(_kurbel, m) {
  m.doc() = "kurbel's facade as Python's types; import kurbel instead";
  m.attr("__version__") = KURBEL_VERSION;
  scene_error() = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "kurbel.SceneError",
      "A scene that cannot be read or makes no machine. places: (file, line, column, text) of every fault.",
      PyExc_ValueError, nullptr));
  m.attr("SceneError") = scene_error();
  py::register_exception_translator(translate);
  bind_machine(m);
  bind_study(m);
  bind_run(m);
  bind_motion(m);
  bind_words(m);
  bind_sweep(m);
  m.def(
      "rows_of",
      [](const std::vector<std::string>& vary, const std::string& design, std::uint64_t seed) {
        return rows_of({vary, design, seed});
      },
      py::arg("vary"), py::arg("design"), py::arg("seed"));
  m.def(
      "settings_of",
      [](const std::vector<std::string>& vary, const std::string& design, std::uint64_t seed) {
        return settings_of({vary, design, seed});
      },
      py::arg("vary"), py::arg("design"), py::arg("seed"));
}
