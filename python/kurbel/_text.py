"""Scenes from whatever describes them: files, texts, mappings; and what is given beside them, checked for its type."""

import errno
import numbers
import os
from collections.abc import Mapping

from ._kurbel import Machine


def _quoted(text):
    out = ['"']
    for c in text:
        if c in '"\\':
            out.append("\\" + c)
        elif c < " " or c == "\x7f":
            out.append(f"\\u{ord(c):04x}")
        else:
            out.append(c)
    return "".join(out) + '"'


def _plain(value):
    """numpy's numbers and arrays as Python's."""
    return value.tolist() if hasattr(value, "tolist") else value


def _listed(value):
    """What is a list, of Python or numpy; or None."""
    value = _plain(value)
    return list(value) if isinstance(value, (list, tuple, range)) else None


def _value(value):
    value = _plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if (several := _listed(value)) is not None:
        return "[" + ", ".join(_value(v) for v in several) + "]"
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"a scene holds no {type(value).__name__}: {value!r}; give texts, numbers, lists and mappings")


def _key(key):
    if not isinstance(key, str):
        raise TypeError(f"keys of a scene are texts, not {key!r}")
    plain = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if plain else _quoted(key)


def text_of(scene):
    """A mapping as the text of a scene, a key a line."""
    return "".join(f"{_key(key)} = {_value(value)}\n" for key, value in scene.items())


def wrong(name, value, form):
    """An argument of a type that it has not."""
    return TypeError(f"{name}={value!r}: must be {form}, not {type(value).__name__}")


def text_given(name, value, example):
    if not isinstance(value, str):
        raise wrong(name, value, f"a text, {example}")
    return value


def names_given(name, value, example):
    """One text, or several as a list."""
    several = [value] if isinstance(value, str) else _listed(value)
    if several is None or not all(isinstance(one, str) for one in several):
        raise wrong(name, value, f"a text or a list of texts, {example}")
    return several


def whole_given(name, value):
    value = _plain(value)
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise wrong(name, value, "a whole number")
    return int(value)


def settings_of(set, name="set"):
    """A mapping as (path, text), a pair each."""
    if set is None:
        return []
    example = 'a mapping, {"main_coupling.stiffness": "1 MN*m/rad"}'
    if not isinstance(set, Mapping):
        raise wrong(name, set, example)
    for path in set:
        if not isinstance(path, str):
            raise TypeError(f"{name} has the key {path!r}, which is no text; must be {example}")
    return [(path, value if isinstance(value, str) else _value(value)) for path, value in set.items()]


def assigned(name, given, example):
    """What may be given several times as a list: {"T1": "fit"} is ["T1=fit"]."""
    if isinstance(given, Mapping):
        return [f"{key}={text_given(name, value, example)}" for key, value in given.items()]
    return names_given(name, given, f"or a mapping, {example}")


def _effects(name, value):
    return ",".join(names_given(name, value, '"elasticity,backlash" or ["elasticity", "backlash"]'))


def _number(name, value):
    value = _plain(value)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise wrong(name, value, "a number in SI units"
                    + ("" if name == "tolerance" else f"; or set={{'run.{name}': '…'}} with its unit"))
    return float(value)


def _flag(name, value):
    value = _plain(value)
    if not isinstance(value, bool):
        raise wrong(name, value, "True or False")
    return value


_CHOICES = {"effects": _effects, "accuracy": _number, "until": _number, "tolerance": _number,
            "method": lambda name, value: text_given(name, value, '"dop853"'),
            "no_error": _flag, "page": _flag, "no_trials": _flag}


def choices_of(**given):
    """Choices of a run as the module takes them: effects by commas, numbers in SI. What is None is not given."""
    return {name: _CHOICES[name](name, value) for name, value in given.items() if value is not None}


def _option(name, value):
    """A value of an option as the command line has it."""
    value = _plain(value)
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and value.is_integer() and abs(value) < 2**53:
        return str(int(value))
    if isinstance(value, numbers.Number):
        return str(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise wrong(name, value, "a text, a number, True or False; or a list or a mapping of such")


def options_of(given):
    """Options of a study as the module takes them, (name, text): a flag as true, what is a list once for each, a mapping
    as NAME=VALUE. What is None is not given."""
    said = []
    for name, value in given.items():
        if value is None:
            continue
        if name in ("effects", "against"):
            value = _effects(name, value)
        if isinstance(value, Mapping):
            said += [(name, f"{key}={_option(name, one)}") for key, one in value.items()]
        else:
            several = _listed(value)
            said += [(name, _option(name, one)) for one in ([value] if several is None else several)]
    return said


def machine(scene, *, set=None):
    """A machine from a file's path, a text with a line end in it, a mapping (a dict), or a machine.

    Raises SceneError for what is wrong with it, FileNotFoundError for a path that leads nowhere."""
    settings = settings_of(set)
    if isinstance(scene, Machine):
        return scene.with_settings(settings) if settings else scene
    if isinstance(scene, Mapping):
        return Machine.from_text(text_of(scene), "dict", settings)
    if isinstance(scene, str) and "\n" in scene:
        return Machine.from_text(scene, "text", settings)
    if not isinstance(scene, (str, os.PathLike)):
        raise TypeError(f"a scene is the path of a file, a text, a mapping or a machine, not {type(scene).__name__}")
    path = os.fspath(scene)
    if not os.path.exists(path):
        raise FileNotFoundError(errno.ENOENT, "no such scene (a path; a scene as text has line ends in it)", path)
    return Machine.from_file(path, settings)
