"""What studies and runs hand out."""

import json


class Study:
    """What a study found: conclusion, summary, page, tables."""

    def __init__(self, output):
        self._output = output

    @property
    def conclusion(self):
        """In one line."""
        return self._output.conclusion

    @property
    def text(self):
        """All of it, for a terminal."""
        return self._output.text

    @property
    def summary(self):
        """summary.json as a dict (docs/summary.schema.json)."""
        return json.loads(self._output.json)

    @property
    def html(self):
        """The page, whole in itself."""
        return self._output.html

    @property
    def complete(self):
        """It came to its end; otherwise `diagnosis` says why not."""
        return self._output.complete

    @property
    def diagnosis(self):
        """Why it is not complete, in words."""
        return self._output.diagnosis

    @property
    def unconfirmed(self):
        """Why the requested accuracy is not confirmed; empty: it is."""
        return self._output.unconfirmed

    @property
    def tables(self):
        """CSV files by their names, and "sheet.html" where a worksheet was requested."""
        return dict(self._output.tables)

    def figures_of(self, model=""):
        """Figures by their names, of one of several models ("rigid", "elastic") or of the only one. Raises KeyError for a model
        that has none."""
        models = sorted({figure.of for figure in self._output.figures} - {""})
        if model and model not in models:
            raise KeyError(f"no figures of a model {model!r}; allowed: {', '.join(map(repr, models)) or 'no model'}")
        found = Figures()
        for figure in self._output.figures:
            if figure.of == model:
                found.setdefault(figure.name, figure)
        return found

    def to_pandas(self):
        """Figures: model, value, error, unit, at [s]; a row each, by their names."""
        import pandas
        rows = [(f.name, f.of, f.value, f.error, f.unit, f.at) for f in self._output.figures]
        return pandas.DataFrame(rows, columns=["figure", "model", "value", "error", "unit", "at"]).set_index("figure")

    def write(self, folder, formats="csv"):
        """summary.json, report.html and the tables into a folder, whole or not there. Formats of the tables: "csv,mat,xlsx"."""
        self._output.write(str(folder), formats)

    def _repr_html_(self):
        import html
        return (f'<iframe style="width:100%;height:42em;border:0" sandbox="allow-scripts" '
                f'srcdoc="{html.escape(self.html, quote=True)}"></iframe>')

    def __repr__(self):
        return f"<{type(self).__name__}: {self.conclusion}>"


class Trajectory:
    """Quantities over time, by their names: the rows of trajectory.csv, at equidistant times and at peaks between them.
    Arrays lie in the run's memory and keep it."""

    def __init__(self, output):
        self._output = output
        self.units = dict(zip(output.names, output.units))

    @property
    def time(self):
        """[s]"""
        return self._output.time

    def __getitem__(self, name):
        """A quantity over time, or "time" itself, in SI: `units` says which. Read-only, a view into the run's memory."""
        return self.time if name == "time" else self._output.series(name)

    def __iter__(self):
        return iter(self.units)

    def __len__(self):
        return len(self.units)

    def __contains__(self, name):
        return name in self.units

    def keys(self):
        """The names of the quantities."""
        return self.units.keys()

    def to_pandas(self):
        """A DataFrame over time [s]; attrs["units"] has the units."""
        import pandas
        frame = pandas.DataFrame({name: self[name] for name in self}, index=pandas.Index(self.time, name="time"),
                                 copy=False)
        frame.attrs["units"] = dict(self.units)
        return frame

    def __repr__(self):
        return f"<Trajectory: {len(self)} quantities at {len(self.time)} times>"


class Figures(dict):
    """Figures by their names; what is none of them is refused with those like it."""

    def __missing__(self, name):
        import difflib
        like = " or ".join(map(repr, difflib.get_close_matches(str(name), self, n=3, cutoff=0.5)))
        raise KeyError(f"the result has no {name!r}" + (f" — did you mean {like}?" if like else ""))


class Run(Study):
    """One simulation: figures with errors, what was recorded, events."""

    def __init__(self, output):
        super().__init__(output.study)
        self._run = output
        self.figures = Figures(output.figures)
        self.trajectory = Trajectory(output)

    @property
    def events(self):
        """What happened, in its order: clutches that stuck, steps of the sequence."""
        return self._run.events

    @property
    def measured_accuracy(self):
        """Largest error of a figure over its scale."""
        return self._run.measured_accuracy

    @property
    def processor_seconds(self):
        """Of all runs, those for the errors included [s]."""
        return self._run.processor_seconds

    def to_pandas(self):
        """Figures: value, error, unit, at [s]; a row each, by their names."""
        import pandas
        rows = [(f.name, f.value, f.error, f.unit, f.at) for f in self.figures.values()]
        return pandas.DataFrame(rows, columns=["figure", "value", "error", "unit", "at"]).set_index("figure")
