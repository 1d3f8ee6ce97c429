"""What is given to functions: types that are converted, and types that are refused."""

import inspect
import os
import tempfile
import unittest

import numpy

import kurbel

PRESS = os.path.join(os.environ["KURBEL_SCENES"], "crank_press.toml")
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
VARY = ["coupling.stiffness=2..10 kN*m/rad", "motor.torque=20,50 N*m"]


class Arguments(unittest.TestCase):
    def test_the_defaults_of_a_signature_may_be_given(self):
        for name in kurbel.study_names():
            if name in ("modes", "reduce", "gears", "effects"):
                function = getattr(kurbel, name)
                defaults = {p.name: p.default for p in inspect.signature(function).parameters.values()
                            if p.kind == p.KEYWORD_ONLY}
                self.assertGreaterEqual(len(defaults), 1)
                scene = [] if name in ("gears", "effects") else [TWO_MASSES if name == "modes" else PRESS]
                own = {"teeth": [31, 30], "module": "3.5 mm"} if name == "gears" else {}
                self.assertEqual(function(*scene, **{**defaults, **own}).text, function(*scene, **own).text)
        self.assertEqual(kurbel.run(TWO_MASSES, effects=None, method=None, until=None, no_error=True).conclusion,
                         kurbel.run(TWO_MASSES, no_error=True).conclusion)

    def test_numbers_of_numpy_are_those_of_python(self):
        plain = kurbel.gears(teeth=[19, 95], module="4 mm").text
        for teeth in (numpy.array([19, 95]), (19, 95), numpy.array([19.0, 95.0])):
            self.assertEqual(kurbel.gears(teeth=teeth, module="4 mm").text, plain)
        self.assertEqual(kurbel.gears(teeth=range(19, 21), module="4 mm").text,
                         kurbel.gears(teeth=[19, 20], module="4 mm").text)
        modes = kurbel.modes(PRESS, count=3, no_misfires=True, spot_checks=0).text
        for count in (3.0, numpy.int64(3), numpy.float32(3), numpy.array(3)):
            self.assertEqual(kurbel.modes(PRESS, count=count, no_misfires=numpy.bool_(True), spot_checks=0).text, modes)
        with self.assertRaisesRegex(ValueError, "whole number"):
            kurbel.modes(PRESS, count=2.5)
        quick = kurbel.run(TWO_MASSES, until=numpy.float32(0.25), no_error=numpy.bool_(True))
        self.assertEqual(quick.trajectory.time[-1], 0.25)
        self.assertEqual(kurbel.machine(TWO_MASSES, set={"fan.inertia": "2 kg*m2", "run.samples": numpy.int64(50)}).text,
                         kurbel.machine(TWO_MASSES, set={"fan.inertia": "2 kg*m2", "run.samples": 50}).text)

    def test_a_wrong_type_is_told_with_its_argument_and_what_is_accepted(self):
        of_run = dict(until=0.01, no_error=True, page=False)
        for name, form, call in (
                ("set", "a mapping", lambda: kurbel.run(TWO_MASSES, set="fan.inertia=2 kg*m2")),
                ("set", "a mapping", lambda: kurbel.machine(TWO_MASSES, set={5: 1})),
                ("other_set", "a mapping", lambda: kurbel.diff(TWO_MASSES, TWO_MASSES, other_set="x")),
                ("effects", "a list of texts", lambda: kurbel.run(TWO_MASSES, effects={"elasticity"})),
                ("effects", "a list of texts", lambda: kurbel.modes(TWO_MASSES, effects=5)),
                ("effects", "a list of texts", lambda: kurbel.motion(TWO_MASSES, effects={"elasticity"})),
                ("method", "a text", lambda: kurbel.run(TWO_MASSES, method=5)),
                ("until", "a number", lambda: kurbel.run(TWO_MASSES, until=[1])),
                ("no_error", "True or False", lambda: kurbel.run(TWO_MASSES, no_error="yes")),
                ("from_state", "a State", lambda: kurbel.run(TWO_MASSES, from_state="x", **of_run)),
                ("measured", "a file", lambda: kurbel.run(TWO_MASSES, measured=5, **of_run)),
                ("map", "a mapping", lambda: kurbel.run(TWO_MASSES, map=5, **of_run)),
                ("offset", "a text", lambda: kurbel.run(TWO_MASSES, offset={"T1": 5}, **of_run)),
                ("shift", "a text", lambda: kurbel.run(TWO_MASSES, shift=0.2, **of_run)),
                ("count", "a number", lambda: kurbel.modes(TWO_MASSES, count=object())),
                ("name", "a text", lambda: kurbel.study(5, TWO_MASSES)),
                ("executor", "submit", lambda: kurbel.sweep(TWO_MASSES, VARY, executor=5)),
                ("vary", "a list of texts", lambda: kurbel.sweep(TWO_MASSES, 5)),
                ("figures", "a list of texts", lambda: kurbel.sweep(TWO_MASSES, VARY, figures=5)),
                ("seed", "a whole number", lambda: kurbel.sweep(TWO_MASSES, VARY, seed="1")),
                ("files", "a list", lambda: kurbel.merge("a.db", "b.db")),
                ("untill", "until", lambda: kurbel.sweep(TWO_MASSES, VARY, untill=1.0))):
            with self.subTest(name), self.assertRaises(TypeError) as raised:
                call()
            self.assertRegex(str(raised.exception), rf"\b{name}\b.*{form}")
            self.assertNotIn("incompatible function arguments", str(raised.exception))

    def test_a_figure_that_no_row_has_is_refused_with_those_that_are(self):
        for of, figure in (("run", "peak_torque.coupling"), ("modes", "natural_frequency.1")):
            with self.assertRaisesRegex(ValueError, f"nofig.*{figure}"):
                kurbel.sweep(TWO_MASSES, VARY, design="grid:2x2", of=of, figures=[figure, "nofig"])
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(ValueError, "nofig.*peak_torque.coupling"):
            kurbel.sweep(TWO_MASSES, VARY, design="grid:2x2", figures="nofig", into=os.path.join(folder, "r.db"))


if __name__ == "__main__":
    unittest.main()
