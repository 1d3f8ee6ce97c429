"""kurbel: dynamics of machine units, rigid against elastic, with measured errors.

    r = kurbel.run("press.toml", set={"main_coupling.stiffness": "1 MN*m/rad"})
    r.conclusion
    r.figures["delta.press"].value, .unit, .error
    r.trajectory["torque.main_coupling"]      # numpy, in the run's own memory [N*m]

A scene is the path of a file, a text (with a line end in it), a mapping as tomllib hands out (a dict), or a Machine.
All numbers are in SI units, angles in rad, speeds in rad/s. What is wrong with a scene raises SceneError, a ValueError
whose `places` tell file, line, column and text of every fault. A run that cannot go on is no exception: `complete` is
False, `diagnosis` says why.
"""

from ._kurbel import Event, Figure, Machine, Motion, SceneError, State, __version__, option_names, study_names
from ._results import Run, Study, Trajectory
from ._sweep import Sweep, sweep
from ._text import choices_of, machine
from . import _kurbel

__all__ = ["Event", "Figure", "Machine", "Motion", "Run", "SceneError", "State", "Study", "Sweep", "Trajectory",
           "machine", "motion", "option_names", "run", "study", "study_names", "sweep"]


def run(scene, *, set=None, effects=None, method=None, accuracy=None, until=None, errors=True, plots=True):
    """Simulates a scene: figures confirmed by further runs, trajectory, page.

    set       values put beside the scene: {"main_coupling.stiffness": "1 MN*m/rad"}
    effects   "none", "all", or names, joined by commas or as a list, in place of the scene's
    method    "auto", "dop853", …
    accuracy  of every figure over its scale
    until     end of the simulated time [s]
    errors    measure them by further runs
    plots     follow what the page draws
    """
    choices = choices_of(effects=effects, method=method, accuracy=accuracy, until=until, errors=errors, plots=plots)
    return Run(_kurbel.run(machine(scene, set=set), **choices))


def motion(scene, *, set=None, effects="", tolerance=1e-9):
    """A machine to be stepped: go_to(t), motion["torque.main_coupling"], state, restore(state)."""
    return Motion(machine(scene, set=set), **choices_of(effects=effects, tolerance=tolerance))


def study(name, scene, *, set=None, **options):
    """One of study_names() put to a scene; options as the command has them: mid_speed="60 rpm"."""
    said = [(key, ("true" if value else "false") if isinstance(value, bool) else
             ",".join(value) if isinstance(value, (list, tuple)) else str(value)) for key, value in options.items()]
    return Study(_kurbel.study(name, machine(scene, set=set), said))


def _verb(name):
    def ask(scene, *, set=None, **options):
        return study(name, scene, set=set, **options)
    ask.__name__ = ask.__qualname__ = name
    ask.__doc__ = f"kurbel {name} put to a scene. Options: {', '.join(option_names(name)) or 'none'}."
    return ask


for _name in study_names():
    globals()[_name] = _verb(_name)
    __all__.append(_name)
del _name
