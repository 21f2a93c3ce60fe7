# SPDX-License-Identifier: Apache-2.0
"""The C libraries of ROS 2 Jazzy that are called with ctypes, next to rclpy, and a check of their data structures.

The calls keep Python's interpreter lock (PyDLL): each participant is used by one thread of Python, and ROS 2's threads
never need the lock (see `separate_participants`).
"""

from __future__ import annotations

import ctypes
import functools
from collections.abc import Callable
from ctypes import POINTER, byref, c_bool, c_char_p, c_int, c_int64, c_size_t, c_void_p
from typing import Any

from microros_gen.ros.errors import RosUnusableError
from microros_gen.ros.layout import (
    HASH_RIHS01,
    Allocator,
    ErrorString,
    FastBuffer,
    MessageCallbacks,
    MessageMembers,
    MessageSupport,
    RequestId,
    SerializedMessage,
    ServiceCallbacks,
    ServiceInfo,
    ServiceSupport,
    TypeDescription,
    TypeHash,
)

INSTALL = "pip install ros-jazzy-rclpy ros-jazzy-rmw-fastrtps-cpp ros-jazzy-common-interfaces"
"""The ROS 2 packages needed where ROS 2 is not sourced: the extra `ros` of pyproject.toml."""
OK, TIMEOUT, BAD_ALLOC = 0, 2, 10
"""rcl_ret_t (rcl/types.h)."""
SUBSCRIPTION_TAKE_FAILED, CLIENT_TAKE_FAILED, SERVICE_TAKE_FAILED = 401, 501, 601
FAILURES = (RuntimeError, ValueError, TypeError, OSError)
"""What rclpy's handles raise: RCLError is a RuntimeError, refused names are ValueErrors."""
new_bytes: Callable[[int, int], bytes] = ctypes.PYFUNCTYPE(ctypes.py_object, c_void_p, ctypes.c_ssize_t)(
    ("PyBytes_FromStringAndSize", ctypes.pythonapi)
)
"""Return bytes made of a number of bytes at an address."""
_SAMPLE = "rcl_interfaces", "ListParameters"
"""A service that every rclpy brings, with type supports of the kinds that are made here."""
_PATIENCE_NS = 1_000_000
"""How long DDS waits for room in a writer's history: the agent has one thread, and tries again later."""
_HEARTBEAT_NS = 100_000_000
"""The period of a writer's heartbeats while samples are unacknowledged; the default of Fast DDS is 3 s. Its shared
memory transport drops messages that a reader's thread does not fetch in time (it holds 512), as on a busy machine;
until the next heartbeat, the history fills and further samples wait."""
_SUPPRESSION_NS = 4_000_000
"""The time in which a writer ignores requests to repeat a sample that it has just sent. With Fast DDS's default of 0,
each sample of a reliable writer starts a timer and wakes the thread of the timers, which took a third of the
agent's processor time for a sample. Fast DDS's readers request a sample 5 ms after a heartbeat at the earliest
(heartbeatResponseDelay), so no request is ignored; another reader's is repeated after the next heartbeat."""
_WRITER_DEFAULTS = f"""<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"><profiles>
<data_writer profile_name="microros_gen_agent" is_default_profile="true"><qos><reliability><kind>RELIABLE</kind>
<max_blocking_time><sec>0</sec><nanosec>{_PATIENCE_NS}</nanosec></max_blocking_time>
</reliability></qos><times><heartbeatPeriod><sec>0</sec><nanosec>{_HEARTBEAT_NS}</nanosec></heartbeatPeriod>
<nackSupressionDuration><sec>0</sec><nanosec>{_SUPPRESSION_NS}</nanosec></nackSupressionDuration></times>
</data_writer></profiles></dds>""".encode()
_SEPARATE_PARTICIPANTS = b"""<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
<library_settings><intraprocess_delivery>OFF</intraprocess_delivery></library_settings></dds>"""
_FACTORY = "_ZN8eprosima7fastdds3dds24DomainParticipantFactory"
_CDR_ROOM = 4096
"""An upper bound of the size of a Cdr object in bytes."""
_LITTLE, _XCDR1 = 1, 2
_WORD = ctypes.sizeof(c_size_t)


class LayoutError(Exception):
    """A library was found, but differs from what is expected; the text names the difference."""


class Libraries:
    """Functions of librcl and libc, and identifiers of type supports; they stay loaded until the process ends."""

    FASTRTPS = b"rosidl_typesupport_fastrtps_c"
    INTROSPECTION = b"rosidl_typesupport_introspection_c"

    def __init__(self) -> None:
        """Find all functions and identifiers; import rclpy before. Raises RosUnusableError if one is missing."""
        try:
            self._load()
        except (OSError, AttributeError, ValueError) as error:
            raise _unsuitable(f"a part of ROS 2 Jazzy is missing: {error}") from error

    def _load(self) -> None:
        rcl = ctypes.PyDLL("librcl.so")
        runtime = ctypes.PyDLL("librosidl_runtime_c.so")
        self._cdr = ctypes.PyDLL("libfastcdr.so.2")
        self._utils = ctypes.PyDLL("librcutils.so")
        self._utils.rcutils_get_error_string.restype = ErrorString
        self._utils.rcutils_reset_error.restype = None
        self.fastrtps_identifier = _text_at(ctypes.PyDLL(f"lib{self.FASTRTPS.decode()}.so"), self.FASTRTPS)
        self.introspection_identifier = _text_at(
            ctypes.PyDLL(f"lib{self.INTROSPECTION.decode()}.so"), self.INTROSPECTION
        )
        self.service_handle_function = address_of(runtime.get_service_typesupport_handle_function)
        self.eventfd_write = address_of(ctypes.PyDLL(None).eventfd_write)
        self.default_allocator = _function(self._utils, "rcutils_get_default_allocator", Allocator)
        self.free_message = _function(
            self._utils, "rcutils_uint8_array_fini", c_int, POINTER(SerializedMessage)
        )
        self.take = _function(rcl, "rcl_take_serialized_message", c_int, *(c_void_p,) * 4)
        self.take_request = _function(
            rcl, "rcl_take_request_with_info", c_int, c_void_p, POINTER(ServiceInfo), c_void_p
        )
        self.take_response = _function(
            rcl, "rcl_take_response_with_info", c_int, c_void_p, POINTER(ServiceInfo), c_void_p
        )
        self.send_request = _function(rcl, "rcl_send_request", c_int, c_void_p, c_void_p, POINTER(c_int64))
        self.send_response = _function(
            rcl, "rcl_send_response", c_int, c_void_p, POINTER(RequestId), c_void_p
        )
        self.all_acknowledged = _function(rcl, "rcl_publisher_wait_for_all_acked", c_int, c_void_p, c_int64)
        notify = (c_int, c_void_p, c_void_p, c_void_p)
        self.notify_subscription = _function(rcl, "rcl_subscription_set_on_new_message_callback", *notify)
        self.notify_service = _function(rcl, "rcl_service_set_on_new_request_callback", *notify)
        self.notify_client = _function(rcl, "rcl_client_set_on_new_response_callback", *notify)
        self.graph_guard_condition = _function(rcl, "rcl_node_get_graph_guard_condition", c_void_p, c_void_p)
        self.add_guard_condition = _function(
            rcl, "rcl_wait_set_add_guard_condition", c_int, c_void_p, c_void_p, POINTER(c_size_t)
        )
        self.notify_event = _function(rcl, "rcl_event_set_callback", *notify)
        self.trim_heap = _function(ctypes.PyDLL(None), "malloc_trim", c_int, c_size_t)
        self._buffer_offset = 0
        self.cdr_skip = _function(self._cdr, "_ZN8eprosima7fastcdr3Cdr4jumpEm", c_bool, c_void_p, c_size_t)

    def error(self) -> str:
        """Return the first line of rcutils' error text for the last failed call, and reset it."""
        text: bytes = self._utils.rcutils_get_error_string().text
        self._utils.rcutils_reset_error()
        return text.decode("utf-8", "replace").splitlines()[0] if text else "no reason given"

    @staticmethod
    @functools.cache  # Fast DDS complains of a profile that it has already
    def hurry_writers() -> None:
        """Let writers created from now on wait 1 ms (not 100) for room, and send heartbeats after 100 ms (not 3 s).

        They also ignore requests to repeat a sample for 4 ms (not 0).

        ROS 2 sets reliability and leaves its max_blocking_time to the default profile of Fast DDS. A default profile in
        the user's XML file is loaded later and wins. Without the symbols of this Fast DDS, its own times stay.
        """
        _load_profiles(_WRITER_DEFAULTS)

    @staticmethod
    @functools.cache
    def separate_participants() -> None:
        """Let participants of this process reach each other as those of other processes do; call it before any exists.

        By default, Fast DDS delivers to a participant of the same process in the call of the writer, and takes locks of
        both. A writer of a service holds one of them while Python serializes for it. A thread that creates an endpoint
        of the other participant holds Python's interpreter lock meanwhile, and neither would ever get the other's:
        for example the agent, and its parameter server in another thread. Besides, a reader with KEEP_ALL that was full
        may get nothing more within a process: Fast DDS 2.14.5 does not deliver again what it has refused.
        """
        _load_profiles(_SEPARATE_PARTICIPANTS)

    def cdr_buffer(self, cdr: int) -> FastBuffer:
        """Return the buffer of the Cdr object at address `cdr`; call `check_layout` before."""
        return FastBuffer.from_address(c_size_t.from_address(cdr + self._buffer_offset).value)

    @staticmethod
    def capsule(address: int) -> Any:
        """Return a PyCapsule without name or destructor for a C address, as rclpy accepts C pointers."""
        new = ctypes.pythonapi.PyCapsule_New
        new.restype, new.argtypes = ctypes.py_object, (c_void_p, c_char_p, c_void_p)
        return new(address, None, None)

    def check_layout(self) -> None:
        """Compare the structures of `layout` with the installed ROS 2. Raises RosUnusableError if they differ."""
        try:
            self._check_messages()
            self._check_service()
            self._check_cdr()
        except (LayoutError, OSError, AttributeError) as error:
            raise _unsuitable(f"its type supports are not as in ROS 2 Jazzy: {error}") from error

    def _check_messages(self) -> None:
        """Check the identifier first, by its address: other members are only read if it is the expected one."""
        fast = self._sample(self.FASTRTPS)
        _expect(fast.identifier, self.fastrtps_identifier, "identifier")
        callbacks = MessageCallbacks.from_address(fast.data)
        package, service = (part.encode() for part in _SAMPLE)
        _expect(callbacks.namespace, package + b"::srv", "namespace")
        _expect(callbacks.name, service + b"_Request", "name")
        part_of, handle = ctypes.CFUNCTYPE(c_void_p, c_void_p), ctypes.addressof(fast)
        type_hash = TypeHash.from_address(part_of(fast.get_type_hash)(handle))
        _expect(type_hash.version, HASH_RIHS01, "hash")
        described = TypeDescription.from_address(part_of(fast.get_type_description)(handle))
        _expect((described.fields.size, described.referenced.size), (2, 0), "description")
        described_name = ctypes.string_at(described.type_name.data, described.type_name.size)
        _expect(described_name, b"/".join((package, b"srv", service + b"_Request")), "description")
        introspection = self._sample(self.INTROSPECTION)
        _expect(introspection.identifier, self.introspection_identifier, "identifier")
        members = MessageMembers.from_address(introspection.data)
        _expect(members.namespace, package + b"__srv", "namespace")
        _expect((members.name, members.count), (service + b"_Request", 2), "members")

    def _sample(self, identifier: bytes) -> MessageSupport:
        package, service = _SAMPLE
        text = identifier.decode()
        library = ctypes.PyDLL(f"lib{package}__{text}.so")
        name = f"{text}__get_message_type_support_handle__{package}__srv__{service}_Request"
        return MessageSupport.from_address(_function(library, name, c_void_p)())

    def _check_service(self) -> None:
        package, service = _SAMPLE
        text = self.FASTRTPS.decode()
        library = ctypes.PyDLL(f"lib{package}__{text}.so")
        get = _function(
            library, f"{text}__get_service_type_support_handle__{package}__srv__{service}", c_void_p
        )
        support = ServiceSupport.from_address(get())
        _expect(support.identifier, self.fastrtps_identifier, "identifier of a service")
        data = ServiceCallbacks.from_address(support.data)
        _expect((data.namespace, data.name), (f"{package}::srv".encode(), service.encode()), "service")
        for handle, ending in ((data.request, b"_Request"), (data.response, b"_Response")):
            callbacks = MessageCallbacks.from_address(MessageSupport.from_address(handle).data)
            _expect(callbacks.name, service.encode() + ending, "message of a service")
        type_hash = ctypes.CFUNCTYPE(c_void_p, c_void_p)(support.get_type_hash)(ctypes.addressof(support))
        _expect(TypeHash.from_address(type_hash).version, HASH_RIHS01, "hash of a service")

    def _check_cdr(self) -> None:
        """Have libfastcdr create a buffer and a Cdr; find the buffer's offset in a Cdr, which varies by version."""
        content = ctypes.create_string_buffer(24)
        buffer, cdr = FastBuffer(), ctypes.create_string_buffer(_CDR_ROOM)
        make_buffer = _function(
            self._cdr, "_ZN8eprosima7fastcdr10FastBufferC1EPcm", None, c_void_p, c_void_p, c_size_t
        )
        make_cdr = _function(
            self._cdr,
            "_ZN8eprosima7fastcdr3CdrC1ERNS0_10FastBufferENS1_10EndiannessENS0_10CdrVersionE",
            None,
            *(c_void_p, c_void_p, c_int, c_int),
        )
        get_pointer = _function(
            self._cdr, "_ZN8eprosima7fastcdr3Cdr18get_buffer_pointerEv", c_void_p, c_void_p
        )
        room = ctypes.addressof(content)
        make_buffer(byref(buffer), room, len(content))
        _expect((buffer.bytes, buffer.size), (room, len(content)), "buffer of libfastcdr")
        make_cdr(cdr, byref(buffer), _LITTLE, _XCDR1)
        words = (c_size_t * (_CDR_ROOM // _WORD)).from_buffer(cdr)
        places = [i for i, word in enumerate(words) if word == ctypes.addressof(buffer)]
        _expect(len(places), 1, "references to its buffer in a Cdr of libfastcdr")
        self._buffer_offset = places[0] * _WORD
        _expect(get_pointer(cdr), room, "Cdr of libfastcdr")


def _load_profiles(text: bytes) -> None:
    """Have Fast DDS read its XML format. Without the symbols of this Fast DDS, nothing changes."""
    try:
        fast_dds = ctypes.PyDLL("librmw_fastrtps_shared_cpp.so")  # and what it is linked with
        factory = _function(fast_dds, f"{_FACTORY}12get_instanceEv", c_void_p)
        load = _function(
            fast_dds, f"{_FACTORY}24load_XML_profiles_stringEPKcm", c_int, c_void_p, c_char_p, c_size_t
        )
    except (OSError, AttributeError):
        return
    load(factory(), text, len(text))


def first_line(error: Exception) -> str:
    """Return the first line of an exception's text; rcl adds lines of context."""
    return (str(error) or type(error).__name__).splitlines()[0]


def _function(library: ctypes.PyDLL, name: str, result: Any, *arguments: Any) -> Any:
    found = library[name]
    found.restype, found.argtypes = result, arguments
    return found


def address_of(function: Any) -> int:
    """Return the address of a C function."""
    return int(ctypes.cast(function, c_void_p).value or 0)


def _text_at(library: ctypes.PyDLL, expected: bytes) -> int:
    """Return the address of a type support identifier. Raises ValueError if the library has a different one.

    The library's variable `<identifier>__identifier` points to it.
    """
    where = c_void_p.in_dll(library, f"{expected.decode()}__identifier").value
    if where is None or ctypes.string_at(where) != expected:
        raise ValueError(f"{expected.decode()} has another identifier")
    return where


def _expect(found: object, expected: object, what: str) -> None:
    if found != expected:
        raise LayoutError(f"{what}: {found!r} in place of {expected!r}")


def _unsuitable(reason: str) -> RosUnusableError:
    hint = f"Run: {INSTALL}, or source an installation of ROS 2 Jazzy"
    return RosUnusableError(f"cannot use this ROS 2: {reason}", hint)
