"""scripts/golden --self-check: does the comparison see what it should, and nothing else?"""
import copy
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import cells as golden  # noqa: E402
import digest  # noqa: E402
from compare import compare_cells, leaves, numbers_agree  # noqa: E402

CELL = {
    "exit": 0, "stdout": "δ = 0.0412 ± 0.0001\n  dop853; 812 steps, 3.1 ms of processor time a run, 3 runs\n", "stderr": "",
    "summary": {
        "version": "0.1.0", "scene": "/a/press.toml", "conclusion": "The press runs; δ is 0.04123; it costs 36 × the time.",
        "figures": [{"name": "delta", "value": 0.04123, "unit": "", "error": 1e-5, "at": 1.25, "at_error": 1e-6},
                    {"name": "peak_torque.coupling", "value": 1234.5, "unit": "N*m", "error": 0.2, "at": None, "at_error": None}],
        "events": [{"t": 0.5, "component": "clutch", "kind": "sticks", "what": "holds", "value": 3.25, "error": 1e-7},
                   {"t": 0.9, "component": "clutch", "kind": "slips", "what": "slips", "error": 1e-7}],
        "modes": [{"number": 1, "frequency": 12.0, "omega": 75.398, "error": 1e-6, "shape": [1.0, 1e-17, -0.5]}],
        "pairs": [{"angles": [0.1, 0.2], "angles_error": [1e-4, 1e-9], "ratio": 5.0}],
        "energy_balance": {"kinetic_end": 5000.0, "residual": 1e-9, "relative": 2e-13},
        "accuracy": {"asked": 1e-3, "measured": 2e-5, "confirmed": True},
        "statistics": {"steps": 812, "cpu_seconds": 0.0031}},
    "csv": {"trajectory.csv": "# remark\ntime [s],torque [N*m],sign\n0,0,up\n0.5,1200,up\n1,-400,down\n"}}


def changed(*path, to):
    cell = copy.deepcopy(CELL)
    node = cell
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = to(node[path[-1]]) if callable(to) else to
    return cell


def removed(*path):
    cell = copy.deepcopy(CELL)
    node = cell
    for step in path[:-1]:
        node = node[step]
    del node[path[-1]]
    return cell


class Comparison(unittest.TestCase):
    def judged(self, verdict, other, one=CELL):
        for a, b in ((one, other), (other, one)):
            outcome = compare_cells(a, b)
            self.assertEqual(outcome.verdict(), verdict, f"{outcome}")
        return outcome

    def test_the_same_is_identical(self):
        self.judged("identical", copy.deepcopy(CELL))
        self.assertGreater(compare_cells(CELL, CELL).values, 25)

    def test_times_paths_and_versions_are_no_results(self):
        self.judged("identical", changed("summary", "version", to="0.2.0"))
        self.judged("identical", changed("summary", "scene", to="/b/press.toml"))
        self.judged("identical", changed("summary", "statistics", "cpu_seconds", to=9.0))
        self.judged("identical", changed("stdout", to=lambda s: s.replace("3.1 ms of", "1.04 s of")))
        self.judged("identical", changed("summary", "conclusion", to=lambda s: s.replace("costs 36 ×", "costs 1.5 ×")))
        # Which effect costs most is a time, too, and may be none.
        dear = {"exit": 0, "summary": {"conclusion": "The strongest effect is gravity, 33 % off; most time is due to backlash, 1.5 × the time without it."}}
        for other in ("; most time is due to gravity, 1.6 × the time without it.", "."):
            self.judged("identical", {"exit": 0, "summary": {"conclusion": "The strongest effect is gravity, 33 % off" + other}}, dear)

    def test_numbers_of_steps_are_told_apart(self):
        outcome = self.judged("identical", changed("summary", "statistics", "steps", to=813))
        self.assertEqual([d.path for d in outcome.effort], ["statistics.steps"])

    def test_a_value_within_both_errors_and_one_beyond(self):
        value = ("summary", "figures", 0, "value")
        self.judged("within", changed(*value, to=0.04123 + 1.9e-5))
        outcome = self.judged("different", changed(*value, to=0.04123 + 2.1e-5))
        self.assertEqual([d.path for d in outcome.different], ["figures[delta].value"])
        self.assertAlmostEqual(outcome.different[0].times, 1.05, places=6)
        self.judged("within", changed("summary", "figures", 0, "at", to=1.25 + 1.9e-6))
        self.judged("different", changed("summary", "figures", 0, "at", to=1.25 + 2.1e-6))

    def test_errors_of_lists_angular_frequencies_and_events(self):
        self.judged("within", changed("summary", "pairs", 0, "angles", 0, to=0.1 + 1.9e-4))
        self.judged("different", changed("summary", "pairs", 0, "angles", 1, to=0.2 + 1.9e-4))
        self.judged("within", changed("summary", "modes", 0, "omega", to=75.398 + 1.2e-5))
        self.judged("different", changed("summary", "modes", 0, "omega", to=75.398 + 1.3e-5))
        self.judged("within", changed("summary", "events", 0, "t", to=0.5 + 1.9e-7))
        self.judged("different", changed("summary", "events", 0, "t", to=0.5 + 2.1e-7))

    def test_without_an_error_the_accuracy_of_the_run_holds_else_last_bits(self):
        kinetic = ("summary", "energy_balance", "kinetic_end")
        self.judged("within", changed(*kinetic, to=5000 * (1 + 1.9e-5)))
        self.judged("different", changed(*kinetic, to=5000 * (1 + 2.1e-5)))
        without = removed("summary", "accuracy")
        other = copy.deepcopy(without)
        other["summary"]["pairs"][0]["ratio"] = 5 * (1 + 1e-10)
        self.judged("within", other, without)
        other["summary"]["pairs"][0]["ratio"] = 5 * (1 + 1e-8)
        self.judged("different", other, without)

    def test_zeros_but_for_rounding_and_residuals_are_noise(self):
        self.judged("within", changed("summary", "modes", 0, "shape", 1, to=-3e-17))
        self.judged("within", changed("summary", "energy_balance", "residual", to=-4e-9))
        self.judged("different", changed("summary", "energy_balance", "residual", to=1e-3))

    def test_an_error_that_grew_hides_nothing(self):
        self.judged("within", changed("summary", "figures", 0, "error", to=9e-5))
        self.judged("different", changed("summary", "figures", 0, "error", to=1.1e-4))
        self.judged("different", changed("summary", "figures", 0, "error", to=1.0))
        self.judged("different", changed("summary", "figures", 0, "error", to=None))

    def test_what_is_missing_or_new(self):
        self.judged("different", removed("summary", "figures", 1))
        self.judged("different", removed("summary", "figures", 0, "at_error"))
        self.judged("different", removed("summary", "energy_balance"))
        self.judged("different", changed("summary", to=None))
        self.judged("different", removed("csv", "trajectory.csv"))
        # By name: a figure before it shifts none.
        more = changed("summary", "figures", to=lambda f: [{"name": "new", "value": 1.0}, *f])
        self.assertEqual({d.path for d in compare_cells(CELL, more).different}, {"figures[new].name", "figures[new].value"})

    def test_no_number_is_no_value(self):
        value = ("summary", "figures", 1, "value")
        self.judged("different", changed(*value, to=math.nan))
        self.judged("different", changed(*value, to=math.inf))
        self.judged("different", changed(*value, to=None))
        self.judged("different", changed(*value, to="1234.5"))
        self.judged("identical", changed(*value, to=math.nan), changed(*value, to=math.nan))
        self.judged("different", changed("summary", "accuracy", "confirmed", to=False))

    def test_exit_codes(self):
        outcome = self.judged("different", changed("exit", to=3))
        self.assertEqual([d.path for d in outcome.different], ["exit code"])

    def test_words(self):
        conclusion = ("summary", "conclusion")
        outcome = self.judged("different", changed(*conclusion, to=lambda s: s.replace("runs", "stalls")))
        self.assertFalse(outcome.different)
        self.assertEqual(outcome.words[0][0], "conclusion")
        self.judged("within", changed(*conclusion, to=lambda s: s.replace("0.04123", "0.04124")))
        self.judged("different", changed(*conclusion, to=lambda s: s.replace("0.04123", "0.04128")))
        # What is said beside a summary has its numbers; alone it is compared to the last digit, or its ±.
        self.judged("identical", changed("stdout", to=lambda s: s.replace("0.0412 ", "0.0421 ")))
        alone, said = {"exit": 0, "stdout": "δ = 0.0412 ± 0.0001", "stderr": ""}, "δ = 0.0414 ± 0.0001"
        self.judged("within", {**alone, "stdout": said}, alone)
        self.judged("different", {**alone, "stdout": said.replace("14", "16")}, alone)
        self.judged("different", changed("stderr", to="kurbel: not confirmed\n"))
        self.assertTrue(numbers_agree("at −1.5e3 N*m", "at −1.6e3 N*m"))
        self.assertFalse(numbers_agree("at −1.5e3 N*m", "at −1.7e3 N*m"))

    def test_tables(self):
        table = ("csv", "trajectory.csv")
        self.judged("within", changed(*table, to=lambda s: s.replace("1200", "1200.02")))
        outcome = self.judged("different", changed(*table, to=lambda s: s.replace("1200", "1201")))
        self.assertEqual(outcome.different[0].path, "trajectory.csv:torque (N*m)[2]")
        sweep = changed(*table, to="x [m],error of x [m]\n1,0.1\n2,0.001\n")
        self.judged("within", changed(*table, to="x [m],error of x [m]\n1.19,0.1\n2,0.001\n"), sweep)
        self.judged("different", changed(*table, to="x [m],error of x [m]\n1,0.1\n2.19,0.001\n"), sweep)
        self.judged("different", changed(*table, to=lambda s: s.replace("down", "up")))
        self.judged("different", changed(*table, to=lambda s: s + "2,0,up\n"))
        self.judged("different", changed(*table, to=lambda s: s.replace("torque", "force")))

    def test_every_value_is_looked_at(self):
        for path, leaf in leaves(CELL["summary"]).items():
            self.assertIsNotNone(leaf, path)
        self.assertEqual(leaves(CELL["summary"])["events[clutch#2].t"].error, 1e-7)


FAKE = """#!PYTHON
import json, os, sys, time
place = sys.argv[sys.argv.index("--out") + 1] if "--out" in sys.argv else None
if place:
    os.makedirs(place)
    json.dump({"conclusion": "It runs.", "figures": [{"name": "delta", "value": VALUE, "error": 1e-6}], "scene": sys.argv[2]},
              open(place + "/summary.json", "w"))
    open(place + "/t.csv", "w").write("time [s]\\n0\\n")
print("results:", place)
open(CALLS, "a").write("x")
while BUSY: pass
sys.exit(ENDING)
"""


class Passes(unittest.TestCase):
    """With a program that is none."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.place = Path(self.folder.name)
        self.cells = golden.cells_of(["steady", "check"], ["crank_press"])

    def tearDown(self):
        self.folder.cleanup()

    def program(self, name, value=0.05, busy=False, ending=0):
        file = self.place / name
        file.write_text(FAKE.replace("PYTHON", sys.executable).replace("VALUE", repr(value)).replace("BUSY", repr(busy)).replace("ENDING", repr(ending)).replace("CALLS", repr(str(self.place / "calls"))))
        file.chmod(0o755)
        return file

    def calls(self):
        file = self.place / "calls"
        return len(file.read_text()) if file.exists() else 0

    def test_what_is_there_is_not_computed_again(self):
        answers = golden.Answers(self.place / "answers")
        for _ in range(2):
            golden.compute(self.program("a"), answers, self.cells, 100, 2, lambda text: None)
        self.assertEqual(self.calls(), len(self.cells))
        self.assertEqual({c.command for c in self.cells}, {"check", "steady"})
        steady = answers.load(next(c for c in self.cells if c.command == "steady"))
        self.assertEqual((steady["exit"], steady["stdout"], steady["csv"]), (0, "results: OUT\n", {"t.csv": "time [s]\n0\n"}))
        # Half a file, as an old disk may leave it, is no answer.
        file = answers.file(self.cells[0])
        file.write_bytes(file.read_bytes()[:40])
        golden.compute(self.program("a"), answers, self.cells, 100, 2, lambda text: None)
        self.assertEqual(self.calls(), len(self.cells) + 1)

    def test_what_was_interrupted_is_no_answer(self):
        answers = golden.Answers(self.place / "answers")
        golden.compute(self.program("a", ending=130), answers, self.cells, 100, 1, lambda text: None)
        self.assertIsNone(answers.load(self.cells[0]))
        golden.compute(self.program("a", ending=3), answers, self.cells, 100, 1, lambda text: None)
        self.assertEqual(answers.load(self.cells[0])["exit"], 3)

    def test_what_takes_too_long_is_cut_and_computed_where_more_is_allowed(self):
        answers, cell = golden.Answers(self.place / "answers"), self.cells[:1]
        golden.compute(self.program("a", busy=True), answers, cell, 1, 1, lambda text: None)
        self.assertEqual(answers.load(cell[0])["cut"], 1)
        self.assertTrue(golden.is_dear(answers.load(cell[0]), 1))
        golden.compute(self.program("a"), answers, cell, 1, 1, lambda text: None)
        self.assertEqual(self.calls(), 1)
        golden.compute(self.program("a"), answers, cell, 2, 1, lambda text: None)
        self.assertEqual((self.calls(), answers.load(cell[0])["exit"]), (2, 0))

    def golden(self, *words):
        return subprocess.run([sys.executable, golden.ROOT / "scripts" / "golden", *words], capture_output=True, text=True,
                              env={**os.environ, "XDG_CACHE_HOME": str(self.place / "cache")})

    def test_exit_codes_of_the_script(self):
        a, near, far = self.program("a"), self.program("b", 0.0500015), self.program("c", 0.06)
        ask = ["--only", "steady", "check", "--scenes", "crank_press", "--reference-program"]
        self.assertEqual(self.golden(*ask, a, "--program", a).returncode, 0)
        within = self.golden(*ask, a, "--program", near)
        self.assertEqual(within.returncode, 0, within.stdout)
        self.assertIn("equal within stated errors", within.stdout)
        beyond = self.golden(*ask, a, "--program", far)
        self.assertEqual(beyond.returncode, 1)
        self.assertIn("figures[delta].value: 0.05 ± 1e-06 → 0.06 ± 1e-06", beyond.stdout)
        self.assertEqual(self.golden().returncode, 2)
        self.assertEqual(self.golden("no-such-revision").returncode, 2)
        self.assertEqual(self.golden("--reference-program", "/no/such/program").returncode, 2)
        self.assertEqual(self.golden(*ask, a, "--program", a, "--only", "nothing").returncode, 2)

    def test_a_digest_sees_a_value_beyond_its_error(self):
        digest_of, digest.CHOSEN = digest.CHOSEN, {"steady": ["crank_press"]}
        self.addCleanup(setattr, digest, "CHOSEN", digest_of)
        file = self.place / "digest.json"
        digest.write(file, self.program("a"), 1, lambda text: None)
        self.assertEqual(self.golden("--digest", file, "--program", self.program("b", 0.0500015)).returncode, 0)
        found = self.golden("--digest", file, "--program", self.program("c", 0.0500025))
        self.assertEqual(found.returncode, 1)
        self.assertIn("figures[delta].value", found.stdout)

    def test_a_digest_keeps_the_length_of_what_it_shortens(self):
        self.assertEqual(digest.shortened([0.1] * 99), [0.1] * digest.LONG + ["99 items"])
        self.assertEqual(len(digest.shortened([{"name": str(i)} for i in range(99)])), 99)


class TheCommittedDigest(unittest.TestCase):
    def test_an_altered_value_is_seen_in_every_cell(self):
        file = golden.ROOT / "tests" / "golden" / "digest.json"
        self.assertLess(file.stat().st_size, 1_000_000)
        for name, cell in json.loads(file.read_text())["cells"].items():
            if not cell.get("summary"):
                continue
            path, leaf = next(((p, x) for p, x in leaves(cell["summary"]).items() if x.kind == "value" and isinstance(x.value, float)
                               and "[" in p and "claims" not in p and abs(x.value) > 1e-3 * x.kin > 0 and (x.error or 0) < 0.1 * abs(x.value)), (None, None))
            if path is None:
                continue
            def altered(node):
                if isinstance(node, dict):
                    return {k: altered(v) for k, v in node.items()}
                if isinstance(node, list):
                    return [altered(v) for v in node]
                beyond = 2.5 * (leaf.error or 0) + 1e-8 * leaf.kin
                return node + beyond if isinstance(node, float) and node == leaf.value else node
            self.assertEqual(compare_cells(cell, {**cell, "summary": altered(cell["summary"])}, nothing=digest.NOTHING).verdict(), "different", name)


if __name__ == "__main__":
    unittest.main(verbosity=1)
