"""Scenes from whatever describes them: files, texts, mappings."""

import errno
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


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    if hasattr(value, "tolist"):  # numpy's numbers and arrays
        return _value(value.tolist())
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


def settings_of(set):
    return [(path, value if isinstance(value, str) else _value(value)) for path, value in (set or {}).items()]


def assigned(given):
    """What may be given several times as a list: {"T1": "fit"} is ["T1=fit"]."""
    if isinstance(given, Mapping):
        return [f"{name}={value}" for name, value in given.items()]
    return [given] if isinstance(given, str) else list(given)


def by_commas(names):
    """Names of effects, as a list or joined already."""
    return ",".join(names) if isinstance(names, (list, tuple)) else names


def choices_of(**given):
    """Choices of a run as the module takes them: effects by commas, numbers in SI."""
    for name, value in given.items():
        if name in ("accuracy", "until", "tolerance") and isinstance(value, str):
            raise TypeError(f"{name}={value!r}: must be a number in SI units"
                            + ("" if name == "tolerance" else f"; or set={{'run.{name}': {value!r}}}"))
    if "effects" in given:
        given["effects"] = by_commas(given["effects"])
    return given


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
