# SPDX-License-Identifier: Apache-2.0
"""Calls the generated encoders through ctypes."""

from __future__ import annotations

import ctypes
from typing import Any

from microros_gen.typesupport.plan.types import TypePlan
from tests.support.typesupport.build import Generated


class Fault(ctypes.Structure):
    _fields_ = (
        ("field", ctypes.c_char_p),
        ("within", ctypes.c_char_p),
        ("found", ctypes.c_uint32),
        ("fits", ctypes.c_uint32),
        ("index", ctypes.c_uint32),
        ("kind", ctypes.c_int),
        ("depth", ctypes.c_uint8),
    )

    @property
    def path(self) -> str:
        """Which member was refused, as the text of the error names it."""
        if self.within is None:
            return str(self.field.decode())
        index = "" if self.index == 2**32 - 1 else f"[{self.index}]"
        return f"{self.within.decode()}{index}{'...' if self.depth > 1 else '.'}{self.field.decode()}"


class MessageType(ctypes.Structure):
    _fields_ = (
        ("dds_type_name", ctypes.c_char_p),
        ("max_encoded_size", ctypes.c_uint32),
        (
            "encode",
            ctypes.CFUNCTYPE(ctypes.c_uint32, ctypes.c_void_p, ctypes.c_void_p, ctypes.POINTER(Fault)),
        ),
        ("encoded_size", ctypes.CFUNCTYPE(ctypes.c_uint32, ctypes.c_void_p, ctypes.POINTER(Fault))),
        ("decode", ctypes.c_void_p),
    )


class Handle(ctypes.Structure):
    _fields_ = (("identifier", ctypes.c_char_p), ("data", ctypes.POINTER(MessageType)))


def with_python(generated: Generated) -> list[TypePlan]:
    """All types but those of test_interface_files, which has no code (test_msgs has the same ones)."""
    return [plan for plan in generated.plans if plan.name.package != "test_interface_files"]


def message_type(library: ctypes.CDLL, c_name: str) -> MessageType:
    get = library[f"rosidl_typesupport_c__get_message_type_support_handle__{c_name}"]
    get.restype = ctypes.POINTER(Handle)
    handle = get().contents
    assert handle.identifier == b"rosidl_typesupport_microros_c"
    contents: MessageType = handle.data.contents
    return contents


class Encoder:
    """Calls the generated functions of one type; the buffer is larger than what may be written, to see it."""

    def __init__(self, library: ctypes.CDLL, c_name: str) -> None:
        self.type = message_type(library, c_name)

    def encode(self, value: ctypes.Structure | ctypes.Array[Any]) -> bytes:
        fault = Fault()
        size = self.type.encoded_size(ctypes.addressof(value), fault)
        assert size, (fault.field, fault.found, fault.fits)
        assert size <= self.type.max_encoded_size
        body = ctypes.create_string_buffer(b"\xa5" * (size + 16), size + 16)
        assert self.type.encode(ctypes.addressof(value), ctypes.addressof(body), fault) == size
        assert body.raw[size:] == b"\xa5" * 16, "wrote after the body"
        return body.raw[:size]

    def refusal(self, value: ctypes.Structure) -> tuple[str, int, int, int]:
        """Return the fault of a message that both functions must refuse: path, found, fits, kind."""
        fault, other = Fault(), Fault()
        body = ctypes.create_string_buffer(self.type.max_encoded_size)
        assert self.type.encode(ctypes.addressof(value), ctypes.addressof(body), fault) == 0
        assert self.type.encoded_size(ctypes.addressof(value), other) == 0
        reported = (fault.path, fault.found, fault.fits, fault.kind)
        assert reported == (other.path, other.found, other.fits, other.kind)
        return reported


def names_member(reported: str, path: str) -> bool:
    """Whether `reported` is a member's `path` in the first element of each sequence, the middle of long ones aside."""
    start, dots, end = reported.replace("[0]", "[]").partition("...")
    return path.startswith(f"{start}.") and path.endswith(f".{end}") if dots else path == start
