// module.cpp — kurbel._kurbel: the facade as Python's types. What is Python's own (dicts, pandas, sweeps) stands in the
// package beside it.
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

// Computes in a thread of its own, without Python's lock; the caller's thread looks for signals meanwhile, so that
// Ctrl-C ends the study and is raised once it has ended.
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

// In the memory of the run, which the array keeps; nobody may write there.
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
  py::class_<Machine>(m, "Machine", "A machine as its scene describes it, read and found to be sound. Never changes.")
      .def_static("from_file", &Machine::from_file, py::arg("path"), py::arg("settings") = Settings{},
                  "Reads a scene's file. Raises SceneError with all faults at once.")
      .def_static("from_text", &Machine::from_text, py::arg("text"), py::arg("file") = "scene.toml",
                  py::arg("settings") = Settings{}, "Reads a scene's text; data files are looked for beside `file`.")
      .def("with_settings", &Machine::with, py::arg("settings"), "The same with further settings put in.")
      .def_property_readonly("title", &Machine::title)
      .def_property_readonly("file", &Machine::file)
      .def_property_readonly("text", &Machine::text, "the scene's text with its settings put in")
      .def_property_readonly("effects", &Machine::effects, "the effects that the scene names, in words")
      .def_property_readonly("components", &Machine::components)
      .def_property_readonly("until", &Machine::until, "end of its run [s]")
      .def_property_readonly("accuracy", &Machine::accuracy, "asked of every figure, over its scale")
      .def("explain", &Machine::explain, "What is merged, the coordinates and their inertias.");
}

void bind_study(py::module_& m) {
  py::class_<Study>(m, "StudyOutput", "What a study found.")
      .def_property_readonly("conclusion", &Study::conclusion, "in one line")
      .def_property_readonly("text", &Study::text, "as the command prints it")
      .def_property_readonly("json", &Study::json, "summary.json as text")
      .def_property_readonly("html", &Study::html, "the page, whole in itself")
      .def_property_readonly("complete", &Study::complete)
      .def_property_readonly("diagnosis", &Study::diagnosis, "why it is not complete, in words")
      .def_property_readonly("unconfirmed", &Study::unconfirmed, "why the accuracy asked for is not sure; empty: it is")
      .def_property_readonly("tables", &Study::tables, "(name, text) of the CSV files")
      .def("write", &Study::write, py::arg("folder"), py::arg("formats") = "csv",
           "summary.json, report.html and tables, whole or not there. Formats of the tables: \"csv,mat,xlsx\".");
  m.def(
      "study",
      [](const std::string& name, const Machine& machine, const Options& options) {
        return computed([&](const Watcher& watcher) { return study(name, machine, options, watcher); });
      },
      py::arg("name"), py::arg("machine"), py::arg("options") = Options{});
  m.def("study_names", &study_names);
  m.def("option_names", &option_names, py::arg("study"));
}

void bind_run(py::module_& m) {
  py::class_<FigureValue>(m, "Figure", "A figure in SI units with its measured error.")
      .def_readonly("name", &FigureValue::name)
      .def_readonly("value", &FigureValue::value, "in `unit`; speeds in rad/s")
      .def_readonly("unit", &FigureValue::unit, "\"N*m\"; empty: a plain number")
      .def_readonly("error", &FigureValue::error, "measured by further runs, in `unit`; None: not measured")
      .def_readonly("at", &FigureValue::at, "the moment that it belongs to [s], or None")
      .def("__float__", [](const FigureValue& f) { return f.value; });
  py::class_<Happening>(m, "Event", "Something that happened in a run.")
      .def_readonly("t", &Happening::t, "[s]")
      .def_readonly("component", &Happening::component)
      .def_readonly("what", &Happening::what)
      .def("__repr__",
           [](const Happening& h) { return "<" + std::to_string(h.t) + " s: " + h.component + ": " + h.what + ">"; });
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
      .def_property_readonly("events", &Run::happenings)
      .def_property_readonly("measured_accuracy", &Run::measured_accuracy)
      .def_property_readonly("processor_seconds", &Run::processor_seconds)
      .def_property_readonly("study", [](const Run& run) { return run.study(); });
  m.def(
      "run",
      [](const Machine& machine, std::optional<std::string> effects, std::optional<std::string> method,
         std::optional<double> accuracy, std::optional<double> until, bool errors, bool plots) {
        return computed([&](const Watcher& watcher) {
          return run(machine, {std::move(effects), std::move(method), accuracy, until, errors, plots, watcher});
        });
      },
      py::arg("machine"), py::kw_only(), py::arg("effects") = py::none(), py::arg("method") = py::none(),
      py::arg("accuracy") = py::none(), py::arg("until") = py::none(), py::arg("errors") = true,
      py::arg("plots") = true);
}

void bind_motion(py::module_& m) {
  py::class_<SavedState>(
      m, "State",
      "A moment of a machine as a value, to compare and to keep: its text is exact, Motion.state_from reads it.")
      .def_property_readonly("time", &SavedState::time, "[s]")
      .def_property_readonly("y", &SavedState::y, "angles, twists, speeds, own states: Motion.state_names")
      .def_property_readonly("text", &SavedState::text, "JSON, exact")
      .def("__eq__", [](const SavedState& a, const SavedState& b) { return a == b; });
  py::class_<Motion>(m, "Motion", "A machine in motion under its user's hands. For one thread at a time.")
      .def(py::init<const Machine&, const std::string&, double>(), py::arg("machine"), py::arg("effects") = "",
           py::arg("tolerance") = 1e-9)
      .def_property_readonly("time", &Motion::time, "[s]")
      .def(
          "go_to",
          [](Motion& motion, double time) {
            py::gil_scoped_release released;
            motion.go_to(time);
          },
          py::arg("time"), "On to a time [s], through all events on the way.")
      .def_property_readonly("state", &Motion::state)
      .def("restore", &Motion::restore, py::arg("state"), "Back to a state of this machine.")
      .def("state_from", &Motion::state_from, py::arg("text"), "A state of this machine from its text.")
      .def_property_readonly("names", &Motion::names, "of all that can be looked at")
      .def_property_readonly("units", &Motion::units, "SI, in the order of the names")
      .def_property_readonly("state_names", &Motion::state_names)
      .def_property_readonly("values", &Motion::values, "of all names, now")
      .def("__getitem__", &Motion::operator[], py::arg("name"), "A quantity now, in SI.");
}

}  // namespace

PYBIND11_MODULE(_kurbel, m) {
  m.doc() = "kurbel's facade as Python's types; import kurbel instead";
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
