# SPDX-License-Identifier: Apache-2.0
"""Type supports for messages and services of any type, installed or not: their messages are CDR bytes of the wire.

rmw_fastrtps_cpp asks a type support for the type's name, its hash and functions that turn a message into CDR and
back. Here a message is a `RawMessage`, so these functions copy. They are Python (ctypes) and are only called where this
process itself calls ROS 2: when an entity is created, for a request and for a reply. Samples of topics never pass them.

Handles are made once for each type name and hash and are kept for good, since Fast DDS registers types by name and its
registry of type objects only grows; so their number is limited.
"""

from __future__ import annotations

import ctypes
import functools
import re
import threading
from collections.abc import Callable
from ctypes import addressof, c_bool, c_char, c_char_p, c_size_t, c_uint32, c_void_p
from typing import Any

from microros_gen.interfaces.types import TypeName
from microros_gen.ros.errors import RosError, TypeLimitError
from microros_gen.ros.layout import (
    HASH_RIHS01,
    MessageCallbacks,
    MessageMembers,
    MessageSupport,
    RawMessage,
    Sequence,
    ServiceCallbacks,
    ServiceSupport,
    TypeDescription,
    TypeHash,
)
from microros_gen.ros.libraries import Libraries
from microros_gen.ros.names import ServiceName, cpp_namespace

MAXIMUM_HANDLES = 4096
"""Types (with their hashes) that one process handles in its life; each takes some 5 KiB here and in Fast DDS."""
ENCAPSULATION_BYTES = 4
_HASH = re.compile(r"RIHS01_([0-9a-f]{64})", re.ASCII)

_HANDLE_OF = ctypes.CFUNCTYPE(c_void_p, c_void_p, c_char_p)
_PART_OF = ctypes.CFUNCTYPE(c_void_p, c_void_p)
_SERIALIZE = ctypes.CFUNCTYPE(c_bool, c_void_p, c_void_p)
_SERIALIZED_SIZE = ctypes.CFUNCTYPE(c_uint32, c_void_p)
_MAXIMUM_SIZE = ctypes.CFUNCTYPE(c_size_t, ctypes.POINTER(c_char))


class _Message(ctypes.Structure):
    """The C data of a message type: its handle, which is the first member, and the data that the handle points to."""

    _fields_ = (
        ("support", MessageSupport),
        ("introspection", MessageSupport),
        ("callbacks", MessageCallbacks),
        ("members", MessageMembers),
        ("hash", TypeHash),
        ("description", TypeDescription),
        ("sources", Sequence),
    )


class _Service(ctypes.Structure):
    """The C data of a service type: its handle, which is the first member, and the data that the handle points to."""

    _fields_ = (
        ("support", ServiceSupport),
        ("callbacks", ServiceCallbacks),
        ("hash", TypeHash),
        ("description", TypeDescription),
        ("sources", Sequence),
    )


class RawTypes:
    """Creates handles and keeps them; one object per process, since Fast DDS may use handles until the process ends."""

    def __init__(self, libraries: Libraries) -> None:
        """Use the type support identifiers of `libraries`. Raises RosUnusableError if their layout differs."""
        libraries.check_layout()
        libraries.separate_participants()
        self.libraries = libraries
        self._lock = threading.Lock()
        self._last = threading.local()
        self._messages: dict[tuple[TypeName, str | None], _Message] = {}
        self._services: dict[tuple[TypeName, tuple[str | None, ...]], _Service] = {}
        self._kept: list[Any] = []
        self._functions = {
            "handle_of": _HANDLE_OF(self._handle_of),
            "message_hash": _PART_OF(_offset(_Message.hash.offset)),
            "message_description": _PART_OF(_offset(_Message.description.offset)),
            "message_sources": _PART_OF(_offset(_Message.sources.offset)),
            "service_hash": _PART_OF(_offset(_Service.hash.offset)),
            "service_description": _PART_OF(_offset(_Service.description.offset)),
            "service_sources": _PART_OF(_offset(_Service.sources.offset)),
            "serialize": _SERIALIZE(self._serialize),
            "deserialize": _SERIALIZE(self._deserialize),
            "serialized_size": _SERIALIZED_SIZE(_serialized_size),
            "maximum_size": _MAXIMUM_SIZE(_maximum_size),
        }

    def message_class(self, name: TypeName, type_hash: str | None) -> Any:
        """Return a message class for rclpy's publishers and subscriptions; `type_hash` is RIHS01 text or None.

        Raises RosError if the hash does not follow REP-2011, TypeLimitError if the process uses too many types.
        """
        with self._lock:
            return self._class(addressof(self._message(name, type_hash)))

    def service_class(
        self, name: ServiceName, type_hash: str | None, request_hash: str | None, response_hash: str | None
    ) -> Any:
        """Return a service class for rclpy's services and clients, with the hashes of service, request and response.

        Raises as `message_class` does.
        """
        key = (name.type, (type_hash, request_hash, response_hash))
        with self._lock:
            if key not in self._services:
                self._check_room()
                request = self._message(name.request, request_hash)
                response = self._message(name.response, response_hash)
                self._services[key] = self._make_service(
                    name.type, type_hash, addressof(request), addressof(response)
                )
            return self._class(addressof(self._services[key]))

    def taken(self) -> bytes:
        """Return and clear the request or reply (encapsulation, body) that this thread took last; else empty bytes."""
        taken: bytes = getattr(self._last, "taken", b"")
        self._last.taken = b""
        return taken

    def _message(self, name: TypeName, type_hash: str | None) -> _Message:
        key = (name, type_hash)
        if key not in self._messages:
            self._check_room()
            self._messages[key] = self._make_message(name, type_hash)
        return self._messages[key]

    def _check_room(self) -> None:
        if len(self._messages) + len(self._services) >= MAXIMUM_HANDLES:
            raise TypeLimitError(MAXIMUM_HANDLES)

    def _make_message(self, name: TypeName, type_hash: str | None) -> _Message:
        namespace, text = cpp_namespace(name).encode(), name.name.encode()
        message = _Message(
            callbacks=MessageCallbacks(
                namespace,
                text,
                self._function("serialize"),
                self._function("deserialize"),
                self._function("serialized_size"),
                self._function("maximum_size"),
            ),
            # Fast DDS registers a type object for the type; nothing of it is sent (rmw_fastrtps turns that off).
            members=MessageMembers(namespace.replace(b"::", b"__"), text),
            hash=_parse_hash(type_hash),
            description=self._description(str(name)),
        )
        for member, identifier, data in (
            ("support", self.libraries.fastrtps_identifier, _Message.callbacks.offset),
            ("introspection", self.libraries.introspection_identifier, _Message.members.offset),
        ):
            support = MessageSupport(
                identifier,
                addressof(message) + data,
                self._function("handle_of"),
                self._function("message_hash"),
                self._function("message_description"),
                self._function("message_sources"),
            )
            setattr(message, member, support)
        return message

    def _make_service(self, name: TypeName, type_hash: str | None, request: int, response: int) -> _Service:
        service = _Service(
            callbacks=ServiceCallbacks(cpp_namespace(name).encode(), name.name.encode(), request, response),
            hash=_parse_hash(type_hash),
            description=self._description(str(name)),
        )
        service.support = ServiceSupport(
            identifier=self.libraries.fastrtps_identifier,
            data=addressof(service) + _Service.callbacks.offset,
            func=self.libraries.service_handle_function,
            request=request,
            response=response,
            get_type_hash=self._function("service_hash"),
            get_type_description=self._function("service_description"),
            get_type_sources=self._function("service_sources"),
        )
        return service

    def _description(self, name: str) -> TypeDescription:
        """Return a type description without fields: rcl copies it, and nodes created here offer it to no other node."""
        text = ctypes.create_string_buffer(name.encode())
        self._kept.append(text)
        description = TypeDescription()
        description.type_name.data = addressof(text)
        description.type_name.size, description.type_name.capacity = len(name), len(name) + 1
        return description

    def _class(self, handle: int) -> Any:
        return type("RawType", (), {"_TYPE_SUPPORT": self.libraries.capsule(handle)})()

    def _function(self, name: str) -> int:
        return int(ctypes.cast(self._functions[name], c_void_p).value or 0)

    def _handle_of(self, handle: int, identifier: bytes) -> int | None:
        if identifier == self.libraries.FASTRTPS:
            return handle
        return handle + _Message.introspection.offset if identifier == self.libraries.INTROSPECTION else None

    def _serialize(self, message: int, cdr: int) -> bool:
        """Copy encapsulation header and body into the buffer; the header that Fast CDR wrote is overwritten."""
        raw = RawMessage.from_address(message)
        buffer = self.libraries.cdr_buffer(cdr)
        body = raw.size - ENCAPSULATION_BYTES
        if body < 0 or buffer.size < raw.size or not self.libraries.cdr_skip(cdr, body):
            return False
        ctypes.memmove(buffer.bytes, raw.bytes, raw.size)
        return True

    def _deserialize(self, cdr: int, _message: int) -> bool:
        buffer = self.libraries.cdr_buffer(cdr)
        self._last.taken = ctypes.string_at(buffer.bytes, buffer.size)
        return True


@functools.cache
def raw_types() -> RawTypes:
    """Return the raw types of the process; import rclpy before. Raises RosUnusableError if ROS 2 is not usable."""
    return RawTypes(Libraries())


def _offset(bytes_after: int) -> Callable[[int], int]:
    return lambda handle: handle + bytes_after


def _serialized_size(message: int) -> int:
    return int(RawMessage.from_address(message).size) - ENCAPSULATION_BYTES


def _maximum_size(bounds: Any) -> int:
    bounds[0] = b"\0"  # unbounded
    return 0


def _parse_hash(text: str | None) -> TypeHash:
    if text is None:
        return TypeHash()
    match = _HASH.fullmatch(text)
    if not match:
        raise RosError(f"'{text[:80]}' is not a type hash: RIHS01_ and 64 hexadecimal digits are expected")
    type_hash = TypeHash(version=HASH_RIHS01)
    type_hash.value[:] = bytes.fromhex(match[1])
    return type_hash
