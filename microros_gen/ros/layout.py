# SPDX-License-Identifier: Apache-2.0
"""The C structures that ROS 2 Jazzy exchanges with a type support, as ctypes sees them.

Source: the headers of rosidl_runtime_c (message_type_support_struct.h, service_type_support_struct.h, type_hash.h,
type_description), rosidl_typesupport_fastrtps_cpp (message_type_support.h, service_type_support.h),
rosidl_typesupport_introspection_c (message_introspection.h), rmw (types.h, serialized_message.h), rcutils
(allocator.h, error_handling.h). `Libraries.check_layout` compares them with type supports that are installed, before
anything is made.
"""

from __future__ import annotations

import ctypes
from ctypes import c_bool, c_char, c_char_p, c_int64, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p

HASH_BYTES = 32
"""SHA-256."""
HASH_UNSET, HASH_RIHS01 = 0, 1
"""Versions of a type hash: none, and that of REP-2011."""
GUID_BYTES = 16


class TypeHash(ctypes.Structure):
    """rosidl_type_hash_t."""

    _fields_ = (("version", c_uint8), ("value", c_uint8 * HASH_BYTES))


class MessageSupport(ctypes.Structure):
    """rosidl_message_type_support_t."""

    _fields_ = (
        ("identifier", c_void_p),
        ("data", c_void_p),
        ("func", c_void_p),
        ("get_type_hash", c_void_p),
        ("get_type_description", c_void_p),
        ("get_type_sources", c_void_p),
    )


class ServiceSupport(ctypes.Structure):
    """rosidl_service_type_support_t."""

    _fields_ = (
        ("identifier", c_void_p),
        ("data", c_void_p),
        ("func", c_void_p),
        ("request", c_void_p),
        ("response", c_void_p),
        ("event", c_void_p),
        ("create_event", c_void_p),
        ("destroy_event", c_void_p),
        ("get_type_hash", c_void_p),
        ("get_type_description", c_void_p),
        ("get_type_sources", c_void_p),
    )


class MessageCallbacks(ctypes.Structure):
    """message_type_support_callbacks_t."""

    _fields_ = (
        ("namespace", c_char_p),
        ("name", c_char_p),
        ("serialize", c_void_p),
        ("deserialize", c_void_p),
        ("serialized_size", c_void_p),
        ("maximum_size", c_void_p),
        ("key", c_void_p),
    )


class ServiceCallbacks(ctypes.Structure):
    """service_type_support_callbacks_t."""

    _fields_ = (
        ("namespace", c_char_p),
        ("name", c_char_p),
        ("request", c_void_p),
        ("response", c_void_p),
    )


class MessageMembers(ctypes.Structure):
    """rosidl_typesupport_introspection_c__MessageMembers."""

    _fields_ = (
        ("namespace", c_char_p),
        ("name", c_char_p),
        ("count", c_uint32),
        ("size", c_size_t),
        ("has_key", c_bool),
        ("members", c_void_p),
        ("init", c_void_p),
        ("fini", c_void_p),
    )


class String(ctypes.Structure):
    """rosidl_runtime_c__String."""

    _fields_ = (("data", c_void_p), ("size", c_size_t), ("capacity", c_size_t))


class Sequence(ctypes.Structure):
    """Any rosidl_runtime_c sequence."""

    _fields_ = (("data", c_void_p), ("size", c_size_t), ("capacity", c_size_t))


class TypeDescription(ctypes.Structure):
    """rosidl_runtime_c__type_description__TypeDescription."""

    _fields_ = (("type_name", String), ("fields", Sequence), ("referenced", Sequence))


class RequestId(ctypes.Structure):
    """rmw_request_id_t: GUID of the writer (16 bytes) and its sequence number."""

    _fields_ = (("guid", c_uint8 * GUID_BYTES), ("number", c_int64))


class ServiceInfo(ctypes.Structure):
    """rmw_service_info_t."""

    _fields_ = (("sent_ns", c_int64), ("received_ns", c_int64), ("request", RequestId))


class MessageInfo(ctypes.Structure):
    """rmw_message_info_t."""

    _fields_ = (
        ("sent_ns", c_int64),
        ("received_ns", c_int64),
        ("publication_number", c_uint64),
        ("reception_number", c_uint64),
        ("gid_identifier", c_void_p),
        ("gid", c_uint8 * GUID_BYTES),
        ("from_intra_process", c_bool),
    )


class Allocator(ctypes.Structure):
    """rcutils_allocator_t."""

    _fields_ = tuple((name, c_void_p) for name in ("allocate", "free", "reallocate", "zero", "state"))


class SerializedMessage(ctypes.Structure):
    """rcutils_uint8_array_t, rmw_serialized_message_t: bytes that rmw lets grow with the allocator."""

    _fields_ = (("buffer", c_void_p), ("length", c_size_t), ("capacity", c_size_t), ("allocator", Allocator))


class ErrorString(ctypes.Structure):
    """rcutils_error_string_t."""

    _fields_ = (("text", c_char * 1024),)


class FastBuffer(ctypes.Structure):
    """eprosima::fastcdr::FastBuffer: where the bytes are, and how many."""

    _fields_ = (("vtable", c_void_p), ("bytes", c_void_p), ("size", c_size_t), ("internal", c_bool))


class RawMessage(ctypes.Structure):
    """A message of any type: encapsulation header and CDR body, in borrowed memory."""

    _fields_ = (("bytes", c_void_p), ("size", c_size_t))
