"""The notebook of the press is executed from its first cell to its last, and shows the page."""

import os
import unittest


class Notebook(unittest.TestCase):
    def test_the_press_runs_through(self):
        try:
            import nbformat
            from nbclient import NotebookClient
        except ImportError:
            self.skipTest("no nbclient (python3-nbconvert, python3-ipykernel)")
        scenes = os.environ["KURBEL_SCENES"]
        notebook = nbformat.read(os.path.join(scenes, "..", "examples", "press.ipynb"), as_version=4)
        NotebookClient(notebook, timeout=120, kernel_name="python3",
                       resources={"metadata": {"path": os.path.join(scenes, "..", "examples")}}).execute()
        outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
        self.assertFalse([output for output in outputs if output.output_type == "error"])
        self.assertTrue(any("srcdoc=" in "".join(output.get("data", {}).get("text/html", "")) for output in outputs))


if __name__ == "__main__":
    unittest.main()
