"""kurbel: dynamics of machine units, rigid against elastic, with measured errors.

    r = kurbel.run("press.toml", set={"main_coupling.stiffness": "1 MN*m/rad"})
    r.conclusion
    r.figures["delta.press"].value, .unit, .error
    r.trajectory["torque.main_coupling"]      # numpy, in the run's own memory [N*m]

A scene is the path of a file, a text (with a line end in it), a mapping as tomllib hands out (a dict), or a Machine.
What is handed out is in SI units, angles in rad, speeds in rad/s; values of a scene and of `set` carry their units, as in
its file. What is wrong with a scene raises SceneError, a ValueError whose `places` give file, line, column and text of
every fault. A run that cannot go on is no exception: `complete` is
False, `diagnosis` says why.
"""

import inspect as _inspect
import json as _json
import os as _os

from ._kurbel import (Event, Figure, Machine, Motion, SceneError, State, __version__, example_scenes, explain,
                      explained_figures, keys, kinds, option_names, study_names)
from ._results import Run, Study, Trajectory
from ._sweep import Sweep, merge, rows_in, sweep
from ._text import machine
from . import _kurbel, _text

__all__ = ["Event", "Figure", "Machine", "Motion", "Run", "SceneError", "State", "Study", "Sweep", "Trajectory",
           "check", "diff", "example_scenes", "explain", "explained_figures", "figures", "keys", "kinds", "machine",
           "merge", "motion", "new", "option_names", "rows_in", "run", "schema", "study", "study_names", "sweep"]


def run(scene, *, set=None, effects=None, method=None, accuracy=None, until=None, no_error=False, page=True,
        no_trials=True, measured="", map=(), shift="", offset=(), from_state=None):
    """Simulates a scene: figures confirmed by further runs, trajectory, page. Options:

    set       values put beside the scene: {"main_coupling.stiffness": "1 MN*m/rad"}
    effects   "none", "all", or names, joined by commas or as a list, in place of the scene's
    method    "auto", "dop853", …
    accuracy  of every figure over its scale
    until     end of the simulated time [s]
    no_error  skip the runs that measure errors, two or three of tighter tolerances: several times the time of one
    page      follow what the page draws; no_error=True, page=False is the quick way
    no_trials  False: after a short run also the rigid machine's figures, and which effects that are off would change
              a key figure
    measured  a test's record (a CSV file) laid over it; map: {"T1": "torque.main_coupling"}; shift: "0.2 s" or "fit";
              offset: {"T1": "5 N*m"}, {"T1": "fit"} or "fit"; the difference is given as figures
    from_state  of Motion.state: goes on from there
    """
    choices = _text.choices_of(effects=effects, method=method, accuracy=accuracy, until=until, no_error=no_error,
                               page=page, no_trials=no_trials)
    if not isinstance(measured, (str, _os.PathLike)):
        raise _text.wrong("measured", measured, "the path of a file")
    if from_state is not None and not isinstance(from_state, State):
        raise _text.wrong("from_state", from_state, "a State, which Motion.state hands out")
    return Run(_kurbel.run(machine(scene, set=set), measured=_os.fspath(measured),
                           map=_text.assigned("map", map, '{"T1": "torque.main_coupling"}'),
                           shift=_text.text_given("shift", shift, '"0.2 s" or "fit"'),
                           offset=_text.assigned("offset", offset, '{"T1": "5 N*m"}'),
                           from_state=from_state.text if from_state else "", **choices))


def motion(scene, *, set=None, effects="", tolerance=1e-9):
    """A machine to be stepped: go_to(t), motion["torque.main_coupling"], state, restore(state). For one thread at a time:
    a call while another thread is in one raises RuntimeError."""
    return Motion(machine(scene, set=set), **_text.choices_of(effects=effects, tolerance=tolerance))


def study(name, /, scene=None, *, set=None, **options):
    """One of study_names() put to a scene, or without one: a pair of gears alone, the list of effects; options as the
    command has them: mid_speed="60 rpm"; those that may be given again there as a list."""
    return Study(_kurbel.study(_text.text_given("name", name, '"modes"'),
                               None if scene is None else machine(scene, set=set), _text.options_of(options)))


def diff(scene, other, *, set=None, other_set=None, **options):
    """Two machines figure by figure, and what differs in their scenes. `set` holds for both, `other_set` for the other.
    Options:

    of        "run", "steady", "modes" or "size"
    no_error  skip the runs that measure errors
    delta     demanded, of size
    """
    of_other = dict(_text.settings_of(set) + _text.settings_of(other_set, "other_set"))
    return Study(_kurbel.diff(machine(scene, set=set), machine(other, set=of_other), _text.options_of(options)))


def check(scene, *, set=None):
    """Checks a scene and returns its machine; raises SceneError with all faults."""
    sound = machine(scene, set=set)
    sound.explain()  # compiled, too
    return sound


def figures(scene, *, set=None):
    """{name: unit} of the figures that runs of a scene may yield."""
    return dict(machine(scene, set=set).figures())


def new(name, file=None):
    """A scene to start from, with comments: one of example_scenes(), as text. With a file it is written there; one that
    exists is left as it is: FileExistsError."""
    text = _kurbel.example_scene(name)
    if file is not None:
        with open(file, "x", encoding="utf-8") as out:
            out.write(text)
    return text


def schema():
    """JSON Schema of a scene (draft 2020-12) as a dict."""
    return _json.loads(_kurbel.schema_text())


def _verb(name):
    def ask(scene=None, *, set=None, **options):
        return study(name, scene, set=set, **options)
    ask.__name__ = ask.__qualname__ = name
    ask.__doc__ = (f"kurbel {name} put to a scene. Options: {', '.join(option_names(name)) or 'none'}; "
                   f"what they are: kurbel {name} --help.")
    keyword = _inspect.Parameter.KEYWORD_ONLY
    default = _inspect.Parameter.empty if _kurbel.needs_machine(name) else None
    ask.__signature__ = _inspect.Signature(
        [_inspect.Parameter("scene", _inspect.Parameter.POSITIONAL_OR_KEYWORD, default=default)] +
        [_inspect.Parameter(option, keyword, default=None) for option in ["set", *option_names(name)]])
    return ask


for _name in study_names():
    if _name not in __all__:  # diff: of machines, too
        globals()[_name] = _verb(_name)
        __all__.append(_name)
del _name
