"""Variants of a machine, computed by whatever has `submit` or `map`: threads, processes, a Dask cluster."""

import os

from . import _kurbel
from ._results import Figures, Study
from ._text import choices_of, machine, names_given, text_given, whole_given, wrong


def _row(text, file, settings, figures, of, choices):
    """Of one variant, in whatever process: ({figure: (value, error, unit)}, why it failed or None)."""
    try:
        variant = _kurbel.Machine.from_text(text, file, settings)
        if of == "run":
            run = _kurbel.run(variant, page=False, **choices)
            found, failed = run.figures, None if run.complete else run.diagnosis
        else:
            state, diagnosis, found = _kurbel.answer(variant, of, choices.get("no_error", False))
            failed = diagnosis if state == "failed" else None
    except (ValueError, RuntimeError) as why:
        return {}, str(why)
    wanted = {name: (f.value, f.error, f.unit) for name, f in found.items()
              if not figures or any(_is_asked(name, figure) for figure in figures)}
    return wanted, failed


def _is_asked(name, figure):
    return figure in (name, name.split(".")[0])


def _refuse_unknown(base, figures, of, choices):
    """Raises ValueError for a figure that no row has: neither those that the machine's runs may yield, nor a row as the
    scene is, have it."""
    def unknown(known):
        return [figure for figure in figures if not any(_is_asked(name, figure) for name in known)]
    known = [name for name, _ in base.figures()] if of == "run" else []
    if unknown(known):
        known += [name for name in _row(base.text, os.path.abspath(base.file), [], (), of, choices)[0]
                  if name not in known]
    if known and (missing := unknown(known)):
        more = f" … and {len(known) - 30} more" if len(known) > 30 else ""
        raise ValueError(f"figures={missing[0]!r}: no such figure; there are: {', '.join(map(repr, known[:30]))}{more}")


def _row_of(asked):
    return _row(*asked)


def _computed(executor, rows):
    """The rows by whatever has `submit` or `map`."""
    if executor is None:
        return [_row(*row) for row in rows]
    if hasattr(executor, "gather"):  # Dask: rows of a worker that dies are computed by another one
        return executor.gather([executor.submit(_row, *row, pure=False) for row in rows])
    if not hasattr(executor, "submit"):
        return list(executor.map(_row_of, rows))
    futures = [executor.submit(_row, *row) for row in rows]
    try:
        return [future.result() for future in futures]
    except BaseException:  # Ctrl-C, too: what has not begun does not begin
        for future in futures:
            future.cancel()
        raise


class Sweep:
    """Rows in their order: parameters and figures."""

    def __init__(self, vary, parameters, results, file=None):
        self.vary = vary
        self.file = file                          # where the rows are kept; None: nowhere
        self.parameters = parameters              # a list of values for each row, in the units of `vary`
        self.figures = [r[0] for r in results]    # {name: (value, error, unit)} for each row
        self.failures = {i: r[1] for i, r in enumerate(results) if r[1] is not None}

    def __len__(self):
        return len(self.parameters)

    def __getitem__(self, figure):
        """Values of a figure in SI, a row each; nan where a row has none. Raises KeyError for what no row has."""
        import numpy
        known = Figures((name, None) for row in self.figures for name in row)
        if known:
            known[figure]
        return numpy.array([row[figure][0] if figure in row else numpy.nan for row in self.figures])

    def __repr__(self):
        return f"<Sweep of {', '.join(self.vary)}: {len(self)} rows, {len(self.failures)} failed>"

    def report(self, limit=()):
        """What `kurbel sweep` says of the rows in its file: response curves, which parameters matter, failures, the worst
        machines. limit: "delta.press <= 0.05", or a list of such."""
        if self.file is None:
            raise ValueError("these rows are kept in no file, which a report is made of; give sweep() a file: into")
        return Study(_kurbel.sweep_report(self.file, names_given("limit", limit, '"delta.press <= 0.05"')))

    def to_pandas(self):
        """A DataFrame, a row a variant: what is varied, in the units of `vary`, and figures in SI."""
        import pandas
        columns = [text.split("=")[0] for text in self.vary]
        frame = pandas.DataFrame(self.parameters, columns=columns)
        for name in sorted({name for row in self.figures for name in row}):
            frame[name] = self[name]
        return frame


_CHOICES = {"accuracy", "effects", "method", "no_error", "until"}


def sweep(scene, vary, *, design="grid", seed=1, figures=(), of="run", set=None, executor=None, into=None, jobs=0,
          **choices):
    """Runs variants of a scene. Options:

    vary      ["main_coupling.stiffness=500..1500 kN*m/rad", "flywheel.inertia=200,400 kg*m2"]
    design    "grid:21x3", "sobol:4096", "lhs:500", "random:500"; row i is a function of i, design and seed alone
    figures   whole names, or a quantity ("delta"); none: all
    of        "run", "steady", "modes" or "size": the question computed for each variant
    executor  with submit(f, …) -> future, or map(f, rows): concurrent.futures, a Dask Client, multiprocessing's Pool;
              None: here, one by one
    into      a file (SQLite) that keeps the rows as they come, in threads of this process (`jobs`; 0: one a core), and
              that a later call goes on with; it makes the rows' report. Not with an executor
    choices   of run, as of run(): no_error, effects, method, accuracy, until; of others no_error
    """
    base = machine(scene, set=set)
    vary = names_given("vary", vary, '"flywheel.inertia=200,400 kg*m2"')
    figures = tuple(names_given("figures", figures, '"delta" or ["delta.press", "peak_torque"]'))
    design, of = text_given("design", design, '"grid:21x3"'), text_given("of", of, '"run"')
    seed, jobs = whole_given("seed", seed), whole_given("jobs", jobs)
    if executor is not None and not (hasattr(executor, "submit") or hasattr(executor, "map")):
        raise wrong("executor", executor, "what has submit() or map(), such as those of concurrent.futures")
    if unknown := sorted(choices.keys() - _CHOICES):
        raise TypeError(f"sweep takes no {unknown[0]!r}; choices of a run are {', '.join(sorted(_CHOICES))}")
    choices = choices_of(**choices)
    if of != "run" and choices.keys() - {"no_error"}:
        raise TypeError(f"of={of!r} takes no {', '.join(sorted(choices.keys() - {'no_error'}))}; set them in the scene")
    if into is not None:
        if executor is not None or choices:
            raise TypeError(f"into goes without {'an executor' if executor is not None else ', '.join(choices)}; "
                            "what holds for all rows stands in the scene, or in set")
        file = os.fspath(into)
        return Sweep(*_kurbel.sweep(base, vary, design, seed, list(figures), of, file, jobs), file)
    rows = _kurbel.rows_of(vary, design, seed)
    settings = _kurbel.settings_of(vary, design, seed)
    # Data files are found from wherever a row is computed.
    text, file = base.text, os.path.abspath(base.file)
    _kurbel.Machine.from_text(text, base.file, settings[0])  # faults are reported before anything is computed
    _refuse_unknown(base, figures, of, choices)
    return Sweep(vary, rows, _computed(executor, [(text, file, s, figures, of, choices) for s in settings]))


def merge(files, into):
    """Puts shards of one sweep, which `kurbel sweep --shard` filled, into one file; how many rows it has.
    Options: files, into."""
    if isinstance(files, (str, os.PathLike)) or not all(isinstance(file, (str, os.PathLike)) for file in files):
        raise wrong("files", files, "a list of files")
    return _kurbel.merge([os.fspath(file) for file in files], os.fspath(into))


def rows_in(file):
    """The rows that a sweep's file holds, as sweep() hands them out."""
    file = os.fspath(file)
    return Sweep(*_kurbel.rows_in(file), file)
