# SPDX-License-Identifier: Apache-2.0
"""Frozen data classes that are cheap to define: one run of `generate` defines two hundred of them.

`dataclasses.dataclass(frozen=True)` compiles six methods for each class when its module is imported, which is half
of all that importing the tool takes. Here only `__init__` is compiled, and only for a class with many instances: most
have one or two in a run. All classes share the other methods. What the classes do does not differ, for type checkers
neither.
"""

from __future__ import annotations

import dataclasses
from operator import attrgetter
from reprlib import recursive_repr
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
else:

    def dataclass(cls=None, /, **options):
        """Do what `dataclasses.dataclass` does; a class that is frozen, and no more than that, is cheap."""
        if cls is None and options.get("frozen") and options.keys() <= {"frozen", "kw_only"}:
            return lambda cls: _frozen(cls, options.get("kw_only", False))
        return dataclasses.dataclass(cls, **options)

    def _frozen(cls, kw_only):
        """Make `cls` a frozen data class. The standard library finds the fields and compiles nothing for that."""
        cls.__doc__ = cls.__doc__ or cls.__name__
        dataclasses.dataclass(init=False, repr=False, eq=False, kw_only=kw_only)(cls)
        fields = dataclasses.fields(cls)
        cls.__init__ = _init_of_first(cls, fields)
        cls._record_values = _values_of([field.name for field in fields if field.compare])
        for name, method in _SHARED.items():
            if cls.__dict__.get(name) is None:  # a class with __eq__ alone has None for __hash__
                setattr(cls, name, method)
        return cls

    def _values_of(names):
        """Return a function from an instance to the values that are compared; no method of the class."""
        if not names:
            return staticmethod(lambda record: ())
        values = attrgetter(*names)
        return values if len(names) > 1 else staticmethod(lambda record: (values(record),))

    # Compiling a method takes as long as filling this many instances without it.
    _FIRST = 12

    def _init_of_first(cls, fields):
        """Return the method for the first instances; it then replaces itself by one that is compiled."""
        known = {field.name: field for field in fields}
        positional = [field.name for field in fields if not field.kw_only]
        left = _FIRST

        def init(self, *arguments, **named):
            nonlocal left
            left -= 1
            assigned = dict(zip(positional, arguments, strict=False), **named)
            if left >= 0 and len(assigned) == len(arguments) + len(named) and _fill(self, known, assigned):
                if after := getattr(self, "__post_init__", None):
                    after()
                return
            # Of the compiled one are the messages about wrong arguments, too.
            cls.__init__ = _init(cls, fields)
            cls.__init__(self, *arguments, **named)

        return init

    def _fill(self, known, assigned):
        """Set all fields from `assigned` or to their defaults; False if one is missing or unknown."""
        values = []
        for name, field in known.items():
            if name in assigned:
                values.append((name, assigned.pop(name)))
            elif field.default is not dataclasses.MISSING:
                values.append((name, field.default))
            elif field.default_factory is not dataclasses.MISSING:
                values.append((name, field.default_factory()))
            else:
                return False
        if assigned:
            return False
        for name, value in values:
            _set(self, name, value)
        return True

    _set = object.__setattr__

    def _init(cls, fields):
        """Return the method that sets each field to its argument or its default."""
        names = {"_set": object.__setattr__, "_MISSING": dataclasses.MISSING}
        parameters, lines = ["self"], []
        for field in sorted(fields, key=lambda f: f.kw_only):
            if field.kw_only and "*" not in parameters:
                parameters.append("*")
            parameter = value = field.name
            if field.default is not dataclasses.MISSING:
                names[f"_default_{field.name}"] = field.default
                parameter = f"{field.name}=_default_{field.name}"
            elif field.default_factory is not dataclasses.MISSING:
                names[f"_new_{field.name}"] = field.default_factory
                parameter = f"{field.name}=_MISSING"
                value = f"_new_{field.name}() if {field.name} is _MISSING else {field.name}"
            parameters.append(parameter)
            lines.append(f" _set(self, {field.name!r}, {value})\n")
        lines.append(" self.__post_init__()\n" if hasattr(cls, "__post_init__") else " pass\n")
        exec(f"def __init__({', '.join(parameters)}):\n{''.join(lines)}", names)
        names["__init__"].__qualname__ = f"{cls.__qualname__}.__init__"
        return names["__init__"]

    def _equal(self, other):
        if other.__class__ is not self.__class__:
            return NotImplemented
        return self._record_values(self) == self._record_values(other)

    def _hash(self):
        return hash(self._record_values(self))

    @recursive_repr()
    def _repr(self):
        shown = [f"{f.name}={getattr(self, f.name)!r}" for f in dataclasses.fields(self) if f.repr]
        return f"{self.__class__.__qualname__}({', '.join(shown)})"

    def _refuse_to_set(self, name, value):
        raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")

    def _refuse_to_delete(self, name):
        raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")

    _SHARED = {
        "__eq__": _equal,
        "__hash__": _hash,
        "__repr__": _repr,
        "__setattr__": _refuse_to_set,
        "__delattr__": _refuse_to_delete,
    }
