# SPDX-License-Identifier: Apache-2.0
"""example_interfaces/srv/AddTwoInts for rclpy's clients and services. No wheel has that package, so what its Python
side consists of is here: classes, and the functions through which rclpy turns their objects into messages and back.
"""

from __future__ import annotations

import ctypes
import struct
from ctypes import c_bool, c_void_p, py_object
from typing import Any

from microros_gen.interfaces.types import TypeName
from microros_gen.ros.layout import RawMessage
from microros_gen.ros.names import ServiceName
from microros_gen.ros.raw_types import raw_types

_ENCAPSULATION = bytes((0, 1, 0, 0))
"""XCDR1, little endian (DDS-XTypes 1.3, 7.6.2.1.2)."""
_CREATE = ctypes.CFUNCTYPE(c_void_p)
_DESTROY = ctypes.CFUNCTYPE(None, c_void_p)
_FROM_PY = ctypes.CFUNCTYPE(c_bool, py_object, c_void_p)
_TO_PY = ctypes.CFUNCTYPE(py_object, c_void_p)


class _Numbers:
    """A message of 64-bit integers."""

    fields: tuple[str, ...] = ()

    def __init__(self, **values: int) -> None:
        for field in self.fields:
            setattr(self, field, values.get(field, 0))


class _Conversion:
    """rclpy's way between objects of one class and messages of C; kept as long as the process."""

    def __init__(self, *fields: str) -> None:
        self._layout = struct.Struct(f"<{len(fields)}q")
        self._kept: dict[int, tuple[RawMessage, Any]] = {}
        self._functions = {
            "_CREATE_ROS_MESSAGE": _CREATE(self._create),
            "_DESTROY_ROS_MESSAGE": _DESTROY(lambda message: self._kept.pop(message) and None),
            "_CONVERT_FROM_PY": _FROM_PY(self._from_py),
            "_CONVERT_TO_PY": _TO_PY(self._to_py),
        }
        capsules = {name: _capsule(function) for name, function in self._functions.items()}
        self.message_class: Any = type("Meta", (type,), capsules)("Numbers", (_Numbers,), {"fields": fields})

    def _create(self) -> int:
        message = RawMessage()
        self._kept[ctypes.addressof(message)] = (message, None)
        return ctypes.addressof(message)

    def _from_py(self, value: Any, address: int) -> bool:
        data = _ENCAPSULATION + self._layout.pack(*(getattr(value, name) for name in value.fields))
        buffer = ctypes.create_string_buffer(data, len(data))
        message = self._kept[address][0]
        message.bytes, message.size = ctypes.addressof(buffer), len(data)
        self._kept[address] = (message, buffer)
        return True

    def _to_py(self, _address: int) -> Any:
        values = self._layout.unpack(raw_types().taken()[len(_ENCAPSULATION) :])
        return self.message_class(**dict(zip(self.message_class.fields, values, strict=True)))


def _capsule(function: Any) -> Any:
    return raw_types().libraries.capsule(ctypes.cast(function, c_void_p).value or 0)


_REQUEST, _RESPONSE = _Conversion("a", "b"), _Conversion("sum")
_TYPE = raw_types().service_class(
    ServiceName("add_two_ints", TypeName("example_interfaces", "srv", "AddTwoInts")), None, None, None
)
AddTwoInts: Any = type(
    "Meta",
    (type,),
    {"_TYPE_SUPPORT": type(_TYPE)._TYPE_SUPPORT, "__import_type_support__": lambda _cls: None},
)("AddTwoInts", (), {"Request": _REQUEST.message_class, "Response": _RESPONSE.message_class})
