"""Variants of a machine, computed by whatever has `submit` or `map`: threads, processes, a Dask cluster."""

from . import _kurbel
from ._text import choices_of, machine


def _row(text, file, settings, figures, choices):
    """Of one variant, in whatever process: ({figure: (value, error, unit)}, why it failed or None)."""
    try:
        run = _kurbel.run(_kurbel.Machine.from_text(text, file, settings), plots=False, **choices)
    except (ValueError, RuntimeError) as why:
        return {}, str(why)
    wanted = {name: (f.value, f.error, f.unit) for name, f in run.figures.items()
              if not figures or name in figures or name.split(".")[0] in figures}
    return wanted, None if run.complete else run.diagnosis


class Sweep:
    """Rows in their order: parameters and figures."""

    def __init__(self, vary, parameters, results):
        self.vary = vary
        self.parameters = parameters              # a list of values for each row, in the units of `vary`
        self.figures = [r[0] for r in results]    # {name: (value, error, unit)} for each row
        self.failures = {i: r[1] for i, r in enumerate(results) if r[1] is not None}

    def __len__(self):
        return len(self.parameters)

    def __getitem__(self, figure):
        """Values of a figure, a row each; nan where a row has none."""
        import numpy
        return numpy.array([row[figure][0] if figure in row else numpy.nan for row in self.figures])

    def __repr__(self):
        return f"<Sweep of {', '.join(self.vary)}: {len(self)} rows, {len(self.failures)} failed>"

    def to_pandas(self):
        import pandas
        columns = [text.split("=")[0] for text in self.vary]
        frame = pandas.DataFrame(self.parameters, columns=columns)
        for name in sorted({name for row in self.figures for name in row}):
            frame[name] = self[name]
        return frame


def sweep(scene, vary, *, design="grid", seed=1, figures=(), set=None, executor=None, **choices):
    """Runs variants of a scene.

    vary      ["main_coupling.stiffness=500..1500 kN*m/rad", "flywheel.inertia=200,400 kg*m2"]
    design    "grid:21x3", "sobol:4096", "lhs:500", "random:500"; row i is a function of i, design and seed alone
    figures   whole names, or a quantity ("delta"); none: all
    executor  with submit(f, …) -> future, or map(f, …): concurrent.futures, a Dask Client; None: here, one by one
    choices   as of run(): errors, effects, method, accuracy, until
    """
    base = machine(scene, set=set)
    vary = [vary] if isinstance(vary, str) else list(vary)
    figures, choices = tuple(figures), choices_of(**choices)
    rows = _kurbel.rows_of(vary, design, seed)
    settings = _kurbel.settings_of(vary, design, seed)
    text, file = base.text, base.file
    _kurbel.Machine.from_text(text, file, settings[0])  # what is wrong is told before anything is computed
    if executor is None:
        results = [_row(text, file, s, figures, choices) for s in settings]
    elif hasattr(executor, "gather"):  # Dask: rows of a worker that dies are computed by another one
        results = executor.gather([executor.submit(_row, text, file, s, figures, choices, pure=False)
                                   for s in settings])
    elif hasattr(executor, "submit"):
        results = [f.result() for f in [executor.submit(_row, text, file, s, figures, choices) for s in settings]]
    else:
        n = len(settings)
        results = list(executor.map(_row, [text] * n, [file] * n, settings, [figures] * n, [choices] * n))
    return Sweep(vary, rows, results)
