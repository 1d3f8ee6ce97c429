"""The Python of the READMEs runs as it is written there."""

import os
import re
import tempfile
import unittest

import kurbel  # noqa: F401

HERE = os.path.join(os.path.dirname(__file__), "..", "..")


def blocks(file, language):
    with open(os.path.join(HERE, file), encoding="utf-8") as text:
        return re.findall(rf"```{language}\n(.*?)```", text.read(), re.DOTALL)


class Readme(unittest.TestCase):
    def runs(self, file, *given):
        """Runs the blocks of a page, one after the other, in a folder with these files."""
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for name, text in given:
                    with open(name, "w", encoding="utf-8") as out:
                        out.write(text)
                names = {}
                for block in blocks(file, "python"):
                    exec(compile(block, file, "exec"), names)
                return names
            finally:
                os.chdir(before)

    def test_of_the_package(self):
        self.assertIn("rows", self.runs("python/README.md"))

    def test_of_the_project(self):
        self.assertIn("r", self.runs("README.md", ("press.toml", blocks("README.md", "toml")[0])))


if __name__ == "__main__":
    unittest.main()
