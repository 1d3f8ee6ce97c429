"""Scenes as mappings: what tomllib reads of each scene, written anew by the package, is the same machine."""

import glob
import os
import tomllib
import types
import unittest
from collections import ChainMap

import kurbel
from kurbel._text import text_of

SCENES = os.environ["KURBEL_SCENES"]
FILES = sorted(glob.glob(os.path.join(SCENES, "**", "*.toml"), recursive=True) +
               glob.glob(os.path.join(SCENES, "..", "docs", "tasks", "*.toml")))


def frozen(value):
    """The same with no dict left in it."""
    if isinstance(value, dict):
        return types.MappingProxyType({key: frozen(inner) for key, inner in value.items()})
    return [frozen(inner) for inner in value] if isinstance(value, list) else value


class Scenes(unittest.TestCase):
    def test_every_scene_as_a_mapping_is_the_machine_of_its_file(self):
        self.assertGreater(len(FILES), 40)
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        for file in FILES:
            with self.subTest(os.path.relpath(file, SCENES)):
                with open(file, "rb") as text:
                    read = tomllib.load(text)
                # Exactly: every number to its last bit, every text, every list.
                self.assertEqual(tomllib.loads(text_of(frozen(read))), read)
                os.chdir(os.path.dirname(file))  # of a mapping, data files are looked for here
                of_file, of_mapping = kurbel.machine(os.path.basename(file)), kurbel.machine(frozen(read))
                for what in ("title", "effects", "components", "until", "accuracy"):
                    self.assertEqual(getattr(of_mapping, what), getattr(of_file, what), what)
                self.assertEqual(of_mapping.explain(), of_file.explain())

    def test_settings_are_any_mapping(self):
        press = os.path.join(SCENES, "crank_press.toml")
        usual = {"main_coupling.stiffness": "2 MN*m/rad", "run.until": "2 s"}
        mine = {"main_coupling.stiffness": "1 MN*m/rad"}
        plain = kurbel.machine(press, set={**usual, **mine})
        for settings in (ChainMap(mine, usual), types.MappingProxyType({**usual, **mine})):
            self.assertEqual(kurbel.machine(press, set=settings).text, plain.text)
        self.assertIn("1 MN*m/rad", plain.text)

    def test_what_is_no_scene_is_said(self):
        for wrong in ({"line": {"a", "b"}}, {"line": [object()]}, {3: "x"}):
            with self.assertRaisesRegex(TypeError, "set|object|3"):
                kurbel.machine(wrong)


if __name__ == "__main__":
    unittest.main()
