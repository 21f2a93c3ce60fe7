# SPDX-License-Identifier: Apache-2.0
"""CDR of any message from its interface file, without ROS 2 and without generated code.

A message is a dict of its members: numbers (including `char` and `wchar` of .idl files, as code numbers), bool, str,
nested dicts. Arrays and sequences are lists; those of `byte`, `char` and `uint8` are bytes. A missing member has its
default from the interface file, otherwise zero, False or empty. Values outside of the interface are refused when
encoding and decoding.

The encoding is XCDR1, little endian, after an encapsulation header of four bytes; decoding accepts both byte orders and
ignores bytes after the message, as ROS 2 does. docs/explanation/typesupport.md lists ROS 2's additions to the standard.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.interfaces.interface_set import InterfaceSet
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.ros.errors import CodecError
from microros_gen.ros.program import Program, compile_program

ENCAPSULATION_BYTES = 4
_LITTLE_ENDIAN = b"\0\1\0\0"
_ORDERS = {b"\0\0": ">", b"\0\1": "<"}
"""Byte orders by the representation identifier: CDR_BE and CDR_LE (RTPS 2.2, 10.2); options say nothing here."""


class Codec:
    """Encodes and decodes messages; a type is compiled on its first use. Not thread-safe."""

    def __init__(self, interfaces: InterfaceSet | Mapping[TypeName, Message]) -> None:
        """Use `interfaces`, which must contain the messages and all nested types."""
        self._messages = interfaces.messages if isinstance(interfaces, InterfaceSet) else interfaces
        self._programs: dict[TypeName, Program] = {}
        self._by_text: dict[str, Program] = {}

    def encode(self, type_name: TypeName | str, value: Mapping[str, Any]) -> bytes:
        """Return the encapsulation header (4 bytes) and the CDR body, in plain CDR (XCDR1), little endian.

        Members that `value` omits have their default. Raises CodecError, which names the member, for an unknown
        member, a value out of the range of its type, or a string or sequence above its bound.
        Source: DDS-XTypes 1.3, 7.4.1; details as rmw_fastrtps_cpp of ROS 2 Jazzy writes them.
        """
        out = bytearray()
        try:
            self._program(type_name).write(value, out)
        except CodecError as error:
            raise error.of_type(type_name) from None
        return _LITTLE_ENDIAN + out

    def decode(self, type_name: TypeName | str, data: bytes) -> dict[str, Any]:
        """Return the message with all of its members; either byte order is accepted.

        `data` begins with the encapsulation header. Raises CodecError, which names the member, if `data` is not plain
        CDR, ends too early, or exceeds a bound.
        """
        try:
            program = self._program(type_name)
            order = _ORDERS.get(bytes(data[:2]))
            if order is None or len(data) < ENCAPSULATION_BYTES:
                raise CodecError(f"'{bytes(data[:4]).hex(' ')}' is not an encapsulation header of plain CDR")
            return program.read(memoryview(data)[ENCAPSULATION_BYTES:], 0, order)[0]
        except CodecError as error:
            raise error.of_type(type_name) from None

    def _program(self, type_name: TypeName | str) -> Program:
        program = self._by_text.get(str(type_name))
        if program is None:
            parts = str(type_name).split("/")
            name = TypeName(*parts) if len(parts) == 3 else None
            if name is None or name not in self._messages:
                raise CodecError("is not a message of these interfaces")
            program = self._by_text[str(type_name)] = compile_program(name, self._messages, self._programs)
        return program
