"""The stub and the module are the same: names, what is a property and what a method, signatures, and the types of what
properties hold and of what is answered without arguments."""

import ast
import collections.abc
import inspect
import os
import types
import typing
import unittest

import numpy
import numpy.typing
import pandas

import kurbel

STUB = os.path.join(os.path.dirname(kurbel.__file__), "__init__.pyi")
PRESS = os.path.join(os.environ["KURBEL_SCENES"], "crank_press.toml")
# What every class has, or pybind11 gives to all of its own.
OF_ALL = {"__module__", "__doc__", "__dict__", "__weakref__", "__new__", "__init__", "__repr__",
          "_pybind11_conduit_v1_"}


def is_public(name):
    return not name.startswith("_")


def defined_in(body):
    """{name: node} of what a stub's body defines: functions, classes, annotated names."""
    found = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
    return found


def parameters_of_node(node):
    """[(name, kind, has a default)] of a definition, without what is in front of a method's own."""
    a = node.args
    plain = a.posonlyargs + a.args
    rows = [(p.arg, "first" if p in a.posonlyargs else "plain", i >= len(plain) - len(a.defaults))
            for i, p in enumerate(plain)]
    rows += [(a.vararg.arg, "rest", False)] if a.vararg else []
    rows += [(p.arg, "keyword", default is not None) for p, default in zip(a.kwonlyargs, a.kw_defaults)]
    rows += [(a.kwarg.arg, "keywords", False)] if a.kwarg else []
    return [row for row in rows if row[0] != "self"]


def parameters_of(function):
    """The same of what the module has: pybind11's functions give their signature in their first line."""
    if not inspect.isfunction(function):
        return parameters_of_node(ast.parse(f"def {function.__doc__.splitlines()[0]}: ...").body[0])
    kinds = {inspect.Parameter.POSITIONAL_ONLY: "first", inspect.Parameter.POSITIONAL_OR_KEYWORD: "plain",
             inspect.Parameter.KEYWORD_ONLY: "keyword", inspect.Parameter.VAR_POSITIONAL: "rest", inspect.Parameter.VAR_KEYWORD: "keywords"}
    return [(p.name, kinds[p.kind], p.default is not p.empty)
            for p in inspect.signature(function).parameters.values() if p.name != "self"]


def decorators(node):
    return {d.id for d in getattr(node, "decorator_list", [])}


def kind_of_node(node):
    if isinstance(node, ast.AnnAssign):
        return "attribute"
    return next(iter(decorators(node)), "method")


def kind_of(member):
    if isinstance(member, property):
        return "property"
    if isinstance(member, staticmethod):
        return "staticmethod"
    return "method" if callable(member) else "attribute"


def holds(value, hint):
    """Whether a value is of the type that an annotation names, with what it contains."""
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if hint is typing.Any:
        return True
    if hint is None:
        return value is None
    if origin in (typing.Union, types.UnionType):
        return any(holds(value, one) for one in inner)
    if origin is typing.ClassVar:
        return holds(value, inner[0])
    if origin is numpy.ndarray:
        return isinstance(value, numpy.ndarray) and value.dtype == numpy.float64
    if origin is None:
        return isinstance(value, hint)
    if not isinstance(value, origin):
        return False
    if origin is tuple:
        return len(value) == len(inner) and all(map(holds, value, inner))
    if origin is dict:
        return all(holds(k, inner[0]) and holds(v, inner[1]) for k, v in value.items())
    return all(holds(one, inner[0]) for one in value)


def samples():
    run = kurbel.run(PRESS, no_error=True, page=False, until=1.0)
    motion = kurbel.motion(PRESS)
    try:
        kurbel.machine("title = 3\n")
    except kurbel.SceneError as error:
        fault = error
    return [run, run.trajectory, run.events[0], run.figures["peak_torque.main_coupling"], motion, motion.state, fault,
            kurbel.machine(PRESS), kurbel.modes(PRESS),
            kurbel.sweep(PRESS, "main_coupling.stiffness=900 kN*m/rad", design="grid:1", no_error=True, until=0.1)]


class Stub(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(STUB, encoding="utf-8") as text:
            tree = ast.parse(text.read())
        cls.stub = defined_in(tree.body)
        cls.classes = {name: node for name, node in cls.stub.items() if isinstance(node, ast.ClassDef)}
        cls.samples = samples()
        cls.names = vars(collections.abc) | vars(typing) | vars(kurbel) | {"numpy": numpy, "pandas": pandas}
        cls.names |= {"PathLike": os.PathLike, "_Array": numpy.typing.NDArray[numpy.float64]}

    def test_the_names_are_the_same(self):
        self.assertEqual(set(kurbel.__all__) | {"__version__"},
                         {name for name in self.stub if is_public(name) or name == "__version__"})

    def test_functions_take_the_same(self):
        for name, node in self.stub.items():
            if isinstance(node, ast.FunctionDef):
                with self.subTest(name):
                    self.assertEqual(parameters_of(getattr(kurbel, name)), parameters_of_node(node))

    def test_classes_have_the_same_members(self):
        for sample in self.samples:
            cls = type(sample)
            with self.subTest(cls.__name__):
                stub = defined_in(self.classes[cls.__name__].body)
                of_instance = {name for name in getattr(sample, "__dict__", {}) if is_public(name)}
                self.assertEqual((vars(cls).keys() | of_instance) - OF_ALL, stub.keys() - OF_ALL)
                for name in stub.keys() & vars(cls).keys():
                    self.assertEqual(kind_of(vars(cls)[name]), kind_of_node(stub[name]), name)

    def test_every_class_is_looked_at(self):
        self.assertEqual({type(sample).__name__ for sample in self.samples}, self.classes.keys())

    def test_methods_take_the_same(self):
        for cls, node in self.classes.items():
            for name, method in defined_in(node.body).items():
                if kind_of_node(method) not in ("method", "staticmethod"):
                    continue
                with self.subTest(f"{cls}.{name}"):
                    there, here = parameters_of(getattr(getattr(kurbel, cls), name)), parameters_of_node(method)
                    if name.startswith("__") and name != "__init__":  # called by position alone
                        there, here = len(there), len(here)
                    self.assertEqual(there, here)

    def test_what_is_held_and_answered_is_of_the_types_told(self):
        for sample in self.samples:
            for name, node in defined_in(self.classes[type(sample).__name__].body).items():
                method = kind_of_node(node) == "method"
                if kind_of_node(node) == "staticmethod" or method and parameters_of_node(node):
                    continue
                told = node.annotation if kind_of_node(node) == "attribute" else node.returns
                hint = eval(ast.unparse(told), self.names)
                with self.subTest(f"{type(sample).__name__}.{name}"):
                    value = getattr(sample, name)() if method else getattr(sample, name)
                    self.assertTrue(holds(value, hint), f"{value!r} is no {hint}")

    def test_what_is_read_only_is_a_property(self):
        for sample in self.samples:
            for name, node in defined_in(self.classes[type(sample).__name__].body).items():
                if kind_of_node(node) == "property":
                    with self.subTest(f"{type(sample).__name__}.{name}"), self.assertRaises(AttributeError):
                        setattr(sample, name, None)


if __name__ == "__main__":
    unittest.main()
