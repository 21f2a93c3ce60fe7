# SPDX-License-Identifier: Apache-2.0
"""Calls the generated decoders through ctypes, into storage that is bound and surrounded by marks."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

from microros_gen.typesupport.plan.layout import LP64
from microros_gen.typesupport.plan.types import TypePlan
from tests.support.typesupport.build import Generated
from tests.support.typesupport.encoder import Fault, MessageType, message_type
from tests.support.typesupport.values import CStructs

DECODE = ctypes.CFUNCTYPE(
    ctypes.c_bool,
    ctypes.POINTER(MessageType),
    ctypes.c_void_p,
    ctypes.c_uint32,
    ctypes.c_bool,
    ctypes.c_void_p,
    ctypes.POINTER(Fault),
)
LIMIT, END, VALUE, BOUND, CAPACITY, DATA = range(6)
MARK = b"\x5a" * 16


@dataclass(frozen=True)
class Refused:
    """Why a body was refused."""

    path: str
    found: int
    fits: int
    kind: int


class Decoder:
    """The decoder of one type, with a message of it bound to its storage."""

    def __init__(self, library: ctypes.CDLL, generated: Generated, plan: TypePlan) -> None:
        self.plan = plan
        self.structs = CStructs(generated.messages)
        self.type = message_type(library, plan.c_name)
        assert self.type.decode
        self._decode = DECODE(("cdr_decode", library))
        self._bind = library[f"{plan.c_name}__bind"] if plan.storage else None
        self._size = plan.storage_size(LP64)
        self._storage = ctypes.create_string_buffer(self._size + len(MARK))
        self.message = self.structs.structure(plan.name)()

    def bind(self) -> Any:
        """Return the message, empty and with its capacities, in a storage full of another pattern."""
        ctypes.memset(self._storage, 0xA5, self._size)
        ctypes.memmove(ctypes.addressof(self._storage) + self._size, MARK, len(MARK))
        ctypes.memset(ctypes.byref(self.message), 0, ctypes.sizeof(self.message))
        if self._bind is not None:
            self._bind(ctypes.byref(self.message), self._storage)
        return self.message

    def into(self, message: Any, body: bytes, swap: bool = False) -> Refused | None:
        """Decode into `message`; return why not, or None."""
        return self.at(message, body, len(body), swap)

    def at(self, message: Any, body: bytes | int, size: int, swap: bool = False) -> Refused | None:
        """The same for a body that may be given by its address."""
        fault = Fault(field=b"?", kind=-1)
        done = self._decode(self.type, body, size, swap, ctypes.addressof(message), fault)
        assert self._storage.raw[self._size :] == MARK, "wrote behind the storage"
        assert done == (fault.kind == -1)
        return None if done else Refused(fault.path, fault.found, fault.fits, fault.kind)

    def decode(self, body: bytes, swap: bool = False) -> dict[str, Any] | Refused:
        """Return the contents, or why the body was refused."""
        message = self.bind()
        refused = self.into(message, body, swap)
        return refused or self.structs.read(self.plan.name, message)
