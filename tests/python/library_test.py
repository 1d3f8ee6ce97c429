"""The installed Python package: what it hands out is what the program says, arrays lie in the run's memory."""

import gc
import json
import math
import os
import subprocess
import tempfile
import unittest

import numpy

import kurbel

SCENES = os.environ["KURBEL_SCENES"]
PRESS = os.path.join(SCENES, "crank_press.toml")

TWO_MASSES = {
    "title": "Step torque on two masses",
    "line": ["rotor", "coupling", "fan"],
    "rotor": {"kind": "inertia", "inertia": "0.2 kg*m2"},
    "motor": {"kind": "torque source", "torque": "50 N*m", "on": "rotor"},
    "coupling": {"kind": "coupling", "stiffness": "4 kN*m/rad", "damping": "0 N*m*s/rad"},
    "fan": {"kind": "inertia", "inertia": "1.5 kg*m2"},
    "effects": {"elasticity": True},
    "run": {"until": "0.3 s"},
}
STEP = 2 * 50 * 1.5 / 1.7  # a step on two undamped masses transmits twice what it would rigidly [N*m]


class Runs(unittest.TestCase):
    def test_a_step_rings_to_twice_the_rigid_torque(self):
        run = kurbel.run(TWO_MASSES)
        peak = run.figures["peak_torque.coupling"]
        self.assertTrue(run.complete)
        self.assertEqual(peak.unit, "N*m")
        self.assertLess(abs(peak.value - STEP), 2 * peak.error)
        # It oscillates about its mean by (1 - cos wt): at every instant.
        w = math.sqrt(4000 * (1 / 0.2 + 1 / 1.5))
        expected = STEP / 2 * (1 - numpy.cos(w * run.trajectory.time))
        self.assertLess(numpy.abs(run.trajectory["torque.coupling"] - expected).max(), 1e-4 * STEP)
        self.assertTrue(numpy.array_equal(run.trajectory["time"], run.trajectory.time))

    def test_settings_are_those_of_the_command(self):
        run = kurbel.run(TWO_MASSES, set={"motor.torque": "25 N*m"}, no_error=True)
        self.assertAlmostEqual(run.figures["peak_torque.coupling"].value, STEP / 2, delta=1e-4 * STEP)
        self.assertIsNone(run.figures["peak_torque.coupling"].error)

    def test_text_dict_and_file_are_one_machine(self):
        text = kurbel.machine(TWO_MASSES).text
        figures = kurbel.run(TWO_MASSES, no_error=True).figures["peak_torque.coupling"]
        self.assertEqual(kurbel.run(text, no_error=True).figures["peak_torque.coupling"].value, figures.value)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "two.toml")
            with open(file, "w") as out:
                out.write(text)
            self.assertEqual(kurbel.run(file, no_error=True).figures["peak_torque.coupling"].value, figures.value)

    def test_effects_are_names_by_commas_or_a_list(self):
        peaks = [kurbel.run(TWO_MASSES, effects=effects, no_error=True).figures["peak_torque.coupling"].value
                 for effects in ("elasticity:coupling", ["elasticity:coupling"], "none", ["none"])]
        self.assertEqual(peaks[0], peaks[1])
        self.assertEqual(peaks[2], peaks[3])
        self.assertAlmostEqual(peaks[0] / peaks[2], 2, delta=1e-4)
        modes = [kurbel.modes(TWO_MASSES, effects=effects).summary["modes"][0]["natural_frequency"]
                 for effects in ("elasticity,gravity", ["elasticity", "gravity"])]
        self.assertEqual(modes[0], modes[1])

    def test_what_is_handed_out_says_what_it_is(self):
        run = kurbel.run(TWO_MASSES, no_error=True)
        motion = kurbel.motion(TWO_MASSES)
        for thing, said in ((run.figures["peak_torque.coupling"], r"<Figure peak_torque.coupling = 88\.23\d+ N\*m>"),
                            (kurbel.machine(TWO_MASSES), "<Machine dict: rotor, coupling, fan, motor>"),
                            (motion, "<Motion at 0 s>"), (motion.state, "<State at 0 s>"),
                            (run.trajectory, r"<Trajectory: \d+ quantities at \d+ times>")):
            self.assertRegex(repr(thing), said)

    def test_the_page_and_the_summary_are_whole(self):
        run = kurbel.run(TWO_MASSES, no_error=True)
        self.assertIn("</html>", run.html)
        self.assertEqual(run.summary["conclusion"], run.conclusion)
        self.assertIn("srcdoc=", run._repr_html_())
        self.assertEqual([row.split(",")[0] for row in run.tables["trajectory.csv"].splitlines()[:1]], ["time [s]"])


class Memory(unittest.TestCase):
    def test_columns_share_the_runs_memory_and_outlive_it(self):
        run = kurbel.run(TWO_MASSES, no_error=True)
        torque, again = run.trajectory["torque.coupling"], run.trajectory["torque.coupling"]
        self.assertTrue(numpy.shares_memory(torque, again))
        self.assertFalse(torque.flags.writeable)
        before = torque.copy()
        del run, again
        gc.collect()
        other = [kurbel.run(TWO_MASSES, no_error=True) for _ in range(3)]
        self.assertTrue((torque == before).all())
        del other

    def test_csv_and_numpy_are_the_same_numbers(self):
        run = kurbel.run(TWO_MASSES, no_error=True)
        rows = run.tables["trajectory.csv"].splitlines()
        column = [name.split(" ")[0] for name in rows[0].split(",")].index("torque.coupling")
        csv = {row.split(",")[0]: float(row.split(",")[column]) for row in rows[1:]}  # rows of peaks among them
        held = {repr(float(t)): value for t, value in zip(run.trajectory.time, run.trajectory["torque.coupling"])}
        csv = {repr(float(t)): value for t, value in csv.items()}
        self.assertLess(len(csv) - len(held), 5)
        self.assertEqual(held.keys() - csv.keys(), set())
        for time, value in held.items():
            self.assertAlmostEqual(csv[time], value, delta=1e-11 * STEP)

    def test_pandas_takes_figures_and_trajectory(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("no pandas")
        run = kurbel.run(TWO_MASSES, no_error=True)
        frame = run.trajectory.to_pandas()
        self.assertEqual(frame.attrs["units"]["torque.coupling"], "N*m")
        self.assertTrue(numpy.shares_memory(frame["torque.coupling"].to_numpy(), run.trajectory["torque.coupling"]))
        self.assertEqual(run.to_pandas().loc["peak_torque.coupling", "unit"], "N*m")

    def test_a_thousand_loads_runs_and_frees_leak_nothing(self):
        def resident():
            with open("/proc/self/statm") as statm:
                return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
        scene = dict(TWO_MASSES, run={"until": "0.02 s", "samples": 100})
        for _ in range(200):
            kurbel.run(scene, no_error=True, page=False).trajectory["torque.coupling"]
        before = resident()
        for _ in range(1000):
            kurbel.run(scene, no_error=True, page=False).trajectory["torque.coupling"]
        self.assertLess(resident() - before, 2)  # MB


class Faults(unittest.TestCase):
    def test_a_fault_of_a_scene_is_a_value_error_with_its_place(self):
        with self.assertRaises(kurbel.SceneError) as raised:
            kurbel.machine('title = "x"\nline = ["a"]\na = { kind = "inertia", inertia = "-1 kg*m2" }\n')
        self.assertIsInstance(raised.exception, ValueError)
        file, line, column, text = raised.exception.places[0]
        self.assertEqual((file, line), ("text", 3))
        self.assertGreater(column, 1)
        self.assertIn("inertia", text)

    def test_names_that_are_none_are_refused_with_those_that_are(self):
        run = kurbel.run(TWO_MASSES, no_error=True)
        with self.assertRaisesRegex(KeyError, "torque.coupling"):
            run.trajectory["torque.couplin"]
        with self.assertRaisesRegex(KeyError, "peak_torque.coupling"):
            run.figures["peak_torque.couplin"]
        self.assertIsNone(run.figures.get("peak_torque.couplin"))
        with self.assertRaisesRegex(ValueError, "mid_speed"):
            kurbel.steady(TWO_MASSES, mid_sped="60 rpm")
        with self.assertRaisesRegex(ValueError, "steady"):
            kurbel.study("stedy", TWO_MASSES)
        for wrong in ({"title": object()}, 42, None):
            with self.assertRaisesRegex(TypeError, "scene"):
                kurbel.machine(wrong)
        with self.assertRaisesRegex(TypeError, "run.until"):
            kurbel.run(TWO_MASSES, until="1 s")

    def test_a_path_that_leads_nowhere_is_no_file(self):
        with self.assertRaises(FileNotFoundError) as raised:
            kurbel.run("nowhere/press.toml")
        self.assertEqual(raised.exception.filename, "nowhere/press.toml")
        with self.assertRaisesRegex(kurbel.SceneError, "folder"):
            kurbel.machine(SCENES)

    def test_a_run_that_breaks_off_says_why_and_raises_nothing(self):
        run = kurbel.run(PRESS, set={"run.budget": "10 ms"}, until=1e4, no_error=True)
        self.assertFalse(run.complete)
        self.assertIn("budget", run.diagnosis)


def public_names(module):
    """(where, thing) of all that a user may name: functions, classes, what these have."""
    for name in module.__all__:
        thing = getattr(module, name)
        yield name, thing
        if isinstance(thing, type):
            for own, member in vars(thing).items():
                if not own.startswith("_") or own in ("__getitem__",):
                    yield f"{name}.{own}", member


class Words(unittest.TestCase):
    def test_every_command_is_a_function(self):
        commands = subprocess.run([os.environ["KURBEL_PROGRAM"], "commands"], capture_output=True, text=True,
                                  check=True).stdout.split()
        self.assertGreater(len(commands), 20)
        for name in commands:
            if name != "commands":  # study_names(), option_names()
                self.assertTrue(callable(getattr(kurbel, name)), name)
                self.assertIn(name, kurbel.__all__)

    def test_every_public_name_says_what_it_is(self):
        for name, thing in public_names(kurbel):
            with self.subTest(name):
                if not isinstance(thing, type) or not issubclass(thing, Exception):
                    self.assertTrue((getattr(thing, "__doc__", None) or "").strip())

    def test_what_may_stand_in_a_scene(self):
        self.assertIn("damping_ratio", kurbel.keys("coupling"))
        self.assertIn("coupling", kurbel.kinds())
        with self.assertRaisesRegex(ValueError, 'did you mean "coupling"'):
            kurbel.keys("couplin")
        self.assertIn("$schema", kurbel.schema())
        self.assertEqual(kurbel.figures(TWO_MASSES)["peak_torque.coupling"], "N*m")
        self.assertEqual(kurbel.check(TWO_MASSES).title, TWO_MASSES["title"])
        with self.assertRaises(kurbel.SceneError):
            kurbel.check(TWO_MASSES, set={"fan.inertia": "-1 kg*m2"})

    def test_the_module_shows_its_own_names_alone(self):
        self.assertEqual([name for name in dir(kurbel) if not name.startswith("_")], sorted(kurbel.__all__))

    def test_a_scene_to_start_from(self):
        self.assertIn("press", kurbel.example_scenes())
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "mine.toml")
            text = kurbel.new("press", file)
            self.assertEqual(kurbel.machine(file).text, kurbel.machine(text).text)
            with self.assertRaises(FileExistsError):
                kurbel.new("pump", file)

    def test_what_a_figure_means(self):
        self.assertIn("N·m", kurbel.explain("peak_torque.coupling"))
        self.assertIn("delta", kurbel.explained_figures())
        with self.assertRaisesRegex(ValueError, "did you mean"):
            kurbel.explain("detla")


class Studies(unittest.TestCase):
    def test_every_study_is_a_function(self):
        for name in kurbel.study_names():
            self.assertTrue(callable(getattr(kurbel, name)))
            self.assertIn("Options:", getattr(kurbel, name).__doc__)

    def test_natural_frequency_of_two_masses(self):
        first = kurbel.modes(TWO_MASSES).figures_of()["natural_frequency.1"]
        w = math.sqrt(4000 * (1 / 0.2 + 1 / 1.5))
        self.assertAlmostEqual(first.value, w / 2 / math.pi, delta=1e-12 * w)
        self.assertEqual(first.unit, "Hz")

    def test_comparison_and_its_files(self):
        study = kurbel.compare(TWO_MASSES, no_error=True, no_trials=True)
        # A step rings to twice what is transmitted rigidly.
        rigid, elastic = (study.figures_of(model)["peak_torque.coupling"].value for model in ("rigid", "elastic"))
        self.assertAlmostEqual(elastic / rigid, 2, delta=1e-4)
        with self.assertRaisesRegex(KeyError, "'elastic', 'rigid'"):
            study.figures_of("elastik")
        frame = study.to_pandas().loc["peak_torque.coupling"].set_index("model")
        self.assertEqual(frame.loc["elastic", "value"], elastic)
        with tempfile.TemporaryDirectory() as folder:
            study.write(os.path.join(folder, "out"))
            self.assertTrue(os.path.exists(os.path.join(folder, "out", "report.html")))


    def test_two_machines_figure_by_figure(self):
        study = kurbel.diff(TWO_MASSES, TWO_MASSES, other_set={"coupling.stiffness": "16 kN*m/rad"}, of="modes")
        self.assertIn("coupling.stiffness", json.dumps(study.summary))
        self.assertIn("natural_frequency", study.text)

    def test_a_pair_of_gears_needs_no_scene(self):
        pair = kurbel.gears(teeth=[31, 30], module="3.5 mm", shift=0.291)
        self.assertEqual(pair.summary["pairs"][0]["wheels"][0]["teeth"], 31)
        self.assertIn("elasticity — ", kurbel.effects().text)
        self.assertEqual(kurbel.effects().summary["effects"][0]["effect"], "elasticity")
        with self.assertRaisesRegex(ValueError, "modes needs a machine"):
            kurbel.study("modes")

    def test_a_list_is_an_option_given_again(self):
        spots = kurbel.study("modes", PRESS, spot_checks=0, spot=["50 rpm", "55 rpm"], range=["20 rpm", "80 rpm"])
        self.assertIn("55 rpm", spots.text)
        with self.assertRaisesRegex(ValueError, "at is given 2 times"):
            kurbel.modes(TWO_MASSES, at=["1 s", "2 s"])

    def test_an_option_may_be_called_name(self):
        study = kurbel.export(TWO_MASSES, fmi=2, kind="cs", name="two")
        self.assertIn("two.fmu holds the machine for co-simulation by FMI 2.0", study.conclusion)
        with tempfile.TemporaryDirectory() as folder:
            study.write(folder)
            self.assertTrue(os.path.exists(os.path.join(folder, "two.fmu")))

    def test_a_sheet_to_be_printed_is_among_the_files(self):
        study = kurbel.forces(PRESS, sheet=True, no_run=True)
        self.assertIn("</html>", study.tables["sheet.html"])
        with tempfile.TemporaryDirectory() as folder:
            study.write(os.path.join(folder, "out"), formats="xlsx")
            self.assertTrue(os.path.exists(os.path.join(folder, "out", "sheet.html")))

    def test_a_record_is_laid_over_run_and_cycle(self):
        run = kurbel.run(PRESS, until=1.0, no_error=True, page=False)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "test.csv")
            with open(file, "w") as out:
                out.write("time [s],T1 [kN*m]\n")
                for t, torque in zip(run.trajectory.time, run.trajectory["torque.main_coupling"]):
                    out.write(f"{float(t)!r},{torque / 1000 + 0.5!r}\n")
            over = kurbel.run(PRESS, until=1.0, no_error=True, measured=file, map={"T1": "torque.main_coupling"},
                              offset="fit")
            self.assertAlmostEqual(over.figures["measured_offset.torque.main_coupling"].value, 500, delta=1e-6)
            self.assertLess(over.figures["residual_rms.torque.main_coupling"].value, 1e-6)
            self.assertIn("measured", over.summary)
            with self.assertRaises(kurbel.SceneError) as raised:
                kurbel.steady(PRESS, measured=file, map={"T2": "torque.main_coupling"})
            self.assertIn("T1", raised.exception.places[0][3])


class Motions(unittest.TestCase):
    def test_a_run_goes_on_from_a_state(self):
        motion = kurbel.motion(TWO_MASSES)
        motion.go_to(0.1)
        run = kurbel.run(TWO_MASSES, from_state=motion.state, no_error=True, page=False)
        self.assertEqual(run.trajectory.time[0], 0.1)
        w = math.sqrt(4000 * (1 / 0.2 + 1 / 1.5))
        expected = STEP / 2 * (1 - numpy.cos(w * run.trajectory.time))
        self.assertLess(numpy.abs(run.trajectory["torque.coupling"] - expected).max(), 1e-4 * STEP)

    def test_a_state_is_gone_back_to_and_on_from_as_text(self):
        motion = kurbel.motion(TWO_MASSES)
        motion.go_to(0.1)
        kept = motion.state
        motion.go_to(0.2)
        end = motion.state
        other = kurbel.motion(TWO_MASSES)
        other.restore(other.state_from(kept.text))
        self.assertEqual(other.time, 0.1)
        other.go_to(0.2)
        self.assertTrue(other.state == end)
        self.assertEqual(other["torque.coupling"], motion["torque.coupling"])
        w = math.sqrt(4000 * (1 / 0.2 + 1 / 1.5))
        self.assertAlmostEqual(motion["torque.coupling"], STEP / 2 * (1 - math.cos(0.2 * w)), delta=1e-5 * STEP)


class Sweeps(unittest.TestCase):
    vary = ["coupling.stiffness=2..10 kN*m/rad", "motor.torque=20,50 N*m"]

    def check(self, rows):
        self.assertEqual(len(rows), 6)
        self.assertEqual(rows.failures, {})
        peaks = rows["peak_torque.coupling"]
        for (stiffness, torque), peak in zip(rows.parameters, peaks):
            self.assertAlmostEqual(peak / (2 * torque * 1.5 / 1.7), 1, delta=1e-5)

    def test_here_and_in_processes_the_rows_are_the_same(self):
        from concurrent.futures import ProcessPoolExecutor
        here = kurbel.sweep(TWO_MASSES, self.vary, design="grid:3x2", figures=["peak_torque"], no_error=True)
        self.check(here)
        with ProcessPoolExecutor(2) as pool:
            there = kurbel.sweep(TWO_MASSES, self.vary, design="grid:3x2", figures=["peak_torque"], no_error=True,
                                 executor=pool)
        self.assertEqual(here.figures, there.figures)

    def test_whatever_maps_or_submits_computes_the_same_rows(self):
        from concurrent.futures import ThreadPoolExecutor
        from multiprocessing.pool import ThreadPool
        asked = dict(design="grid:3x2", figures="peak_torque", no_error=True)
        here = kurbel.sweep(TWO_MASSES, self.vary, **asked)
        with ThreadPoolExecutor(2) as threads, ThreadPool(2) as pool:
            for executor in (threads, pool):
                self.assertEqual(kurbel.sweep(TWO_MASSES, self.vary, executor=executor, **asked).figures, here.figures)

    def test_a_file_keeps_the_rows_and_makes_their_report(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "r.db")
            rows = kurbel.sweep(TWO_MASSES, self.vary, design="grid:3x2", figures=["peak_torque"], into=file)
            self.check(rows)
            value, error, unit = rows.figures[0]["peak_torque.coupling"]
            self.assertEqual(unit, "N*m")
            self.assertLess(error, 1e-3 * value)
            self.assertIn("coupling.stiffness", rows.report().text)
            self.assertEqual(kurbel.rows_in(file).figures, rows.figures)
            self.assertEqual(kurbel.rows_in(file).vary, self.vary)
            with self.assertRaisesRegex(ValueError, "another sweep|differs"):
                kurbel.sweep(TWO_MASSES, self.vary, design="grid:2x2", figures=["peak_torque"], into=file)
            with self.assertRaisesRegex(TypeError, "no_error"):
                kurbel.sweep(TWO_MASSES, self.vary, into=file, no_error=True)

    def test_rows_of_other_questions(self):
        rows = kurbel.sweep(TWO_MASSES, self.vary[:1], design="grid:3", of="modes", figures="natural_frequency")
        for (stiffness,), frequency in zip(rows.parameters, rows["natural_frequency.1"]):
            w = math.sqrt(1000 * stiffness * (1 / 0.2 + 1 / 1.5))
            self.assertAlmostEqual(frequency, w / (2 * math.pi), delta=1e-6)
        self.assertEqual(list(rows.to_pandas().columns), ["coupling.stiffness", "natural_frequency.1"])
        with self.assertRaisesRegex(TypeError, "until"):
            kurbel.sweep(TWO_MASSES, self.vary, of="modes", until=1.0)
        with self.assertRaisesRegex(KeyError, "natural_frequency.1"):
            rows["natural_frequenc.1"]


if __name__ == "__main__":
    unittest.main()
