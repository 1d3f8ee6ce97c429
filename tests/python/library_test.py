"""The installed Python package: what it hands out is what the program says, arrays lie in the run's memory."""

import json
import math
import os
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
        # It swings about its mean by (1 - cos wt): at every instant.
        w = math.sqrt(4000 * (1 / 0.2 + 1 / 1.5))
        expected = STEP / 2 * (1 - numpy.cos(w * run.trajectory.time))
        self.assertLess(numpy.abs(run.trajectory["torque.coupling"] - expected).max(), 1e-4 * STEP)

    def test_settings_are_those_of_the_command(self):
        run = kurbel.run(TWO_MASSES, set={"motor.torque": "25 N*m"}, errors=False)
        self.assertAlmostEqual(run.figures["peak_torque.coupling"].value, STEP / 2, delta=1e-4 * STEP)
        self.assertIsNone(run.figures["peak_torque.coupling"].error)

    def test_text_dict_and_file_are_one_machine(self):
        text = kurbel.machine(TWO_MASSES).text
        figures = kurbel.run(TWO_MASSES, errors=False).figures["peak_torque.coupling"]
        self.assertEqual(kurbel.run(text, errors=False).figures["peak_torque.coupling"].value, figures.value)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "two.toml")
            with open(file, "w") as out:
                out.write(text)
            self.assertEqual(kurbel.run(file, errors=False).figures["peak_torque.coupling"].value, figures.value)

    def test_effects_are_names_by_commas_or_a_list(self):
        peaks = [kurbel.run(TWO_MASSES, effects=effects, errors=False).figures["peak_torque.coupling"].value
                 for effects in ("elasticity:coupling", ["elasticity:coupling"], "none", ["none"])]
        self.assertEqual(peaks[0], peaks[1])
        self.assertEqual(peaks[2], peaks[3])
        self.assertAlmostEqual(peaks[0] / peaks[2], 2, delta=1e-4)

    def test_what_is_handed_out_says_what_it_is(self):
        run = kurbel.run(TWO_MASSES, errors=False)
        motion = kurbel.motion(TWO_MASSES)
        for thing, said in ((run.figures["peak_torque.coupling"], r"<Figure peak_torque.coupling = 88\.23\d+ N\*m>"),
                            (kurbel.machine(TWO_MASSES), "<Machine dict: rotor, coupling, fan, motor>"),
                            (motion, "<Motion at 0 s>"), (motion.state, "<State at 0 s>"),
                            (run.trajectory, r"<Trajectory: \d+ quantities at \d+ times>")):
            self.assertRegex(repr(thing), said)

    def test_the_page_and_the_summary_are_whole(self):
        run = kurbel.run(TWO_MASSES, errors=False)
        self.assertIn("</html>", run.html)
        self.assertEqual(run.summary["conclusion"], run.conclusion)
        self.assertIn("srcdoc=", run._repr_html_())
        self.assertEqual([row.split(",")[0] for row in run.tables["trajectory.csv"].splitlines()[:1]], ["time [s]"])


class Memory(unittest.TestCase):
    def test_columns_share_the_runs_memory_and_outlive_it(self):
        run = kurbel.run(TWO_MASSES, errors=False)
        torque, again = run.trajectory["torque.coupling"], run.trajectory["torque.coupling"]
        self.assertTrue(numpy.shares_memory(torque, again))
        self.assertFalse(torque.flags.writeable)
        before = torque.copy()
        del run, again
        other = [kurbel.run(TWO_MASSES, errors=False) for _ in range(3)]
        self.assertTrue((torque == before).all())
        del other

    def test_csv_and_numpy_are_the_same_numbers(self):
        run = kurbel.run(TWO_MASSES, errors=False)
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
        run = kurbel.run(TWO_MASSES, errors=False)
        frame = run.trajectory.to_pandas()
        self.assertEqual(frame.attrs["units"]["torque.coupling"], "N*m")
        self.assertEqual(frame["torque.coupling"].max(), run.trajectory["torque.coupling"].max())
        self.assertEqual(run.to_pandas().loc["peak_torque.coupling", "unit"], "N*m")

    def test_a_thousand_loads_runs_and_frees_leak_nothing(self):
        def resident():
            with open("/proc/self/statm") as statm:
                return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
        scene = dict(TWO_MASSES, run={"until": "0.02 s", "samples": 100})
        for _ in range(200):
            kurbel.run(scene, errors=False, plots=False).trajectory["torque.coupling"]
        before = resident()
        for _ in range(1000):
            kurbel.run(scene, errors=False, plots=False).trajectory["torque.coupling"]
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
        run = kurbel.run(TWO_MASSES, errors=False)
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
        run = kurbel.run(PRESS, set={"run.budget": "10 ms"}, until=1e4, errors=False)
        self.assertFalse(run.complete)
        self.assertIn("budget", run.diagnosis)


class Studies(unittest.TestCase):
    def test_every_study_is_a_function(self):
        for name in kurbel.study_names():
            self.assertTrue(callable(getattr(kurbel, name)))
            self.assertIn("Options:", getattr(kurbel, name).__doc__)

    def test_natural_frequency_of_two_masses(self):
        summary = kurbel.modes(TWO_MASSES).summary
        w = math.sqrt(4000 * (1 / 0.2 + 1 / 1.5))
        self.assertIn(f"{w / 2 / math.pi:.4g}"[:4], json.dumps(summary))

    def test_comparison_and_its_files(self):
        study = kurbel.compare(TWO_MASSES, no_error=True)
        with tempfile.TemporaryDirectory() as folder:
            study.write(os.path.join(folder, "out"))
            self.assertTrue(os.path.exists(os.path.join(folder, "out", "report.html")))


class Motions(unittest.TestCase):
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
        here = kurbel.sweep(TWO_MASSES, self.vary, design="grid:3x2", figures=["peak_torque"], errors=False)
        self.check(here)
        with ProcessPoolExecutor(2) as pool:
            there = kurbel.sweep(TWO_MASSES, self.vary, design="grid:3x2", figures=["peak_torque"], errors=False,
                                 executor=pool)
        self.assertEqual(here.figures, there.figures)


if __name__ == "__main__":
    unittest.main()
