# SPDX-License-Identifier: Apache-2.0
"""Settings of the existing stack that have no key here, and why.

Names and meanings: the CMakeLists.txt of rmw_microxrcedds_c, Micro XRCE-DDS Client, rcutils, rcl, rosidl_typesupport
and tracetools (Jazzy).
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

_PLANNED = "streams are planned from the declared entities"
_TRANSPORT = "`transport` says which one there is, and only its code comes in"
_COUNTED = "topics are counted from publishers and subscriptions"
_EXACT = "names of types and references have exactly the room that they need"
_SESSION = "the session connects, and connects again, by itself, at its own intervals"
_CALLS = "calls that create something wait for the agent for at most a second"
_HEAP = "the library has no heap, no files and no threads"
_TESTS = "the tests of the old stack are not built"
_BUILD = "it is about how the old stack is built"
_CORE = "the tracing of the old stack is not there"

NOT_NEEDED: Mapping[str, str] = MappingProxyType(
    {
        "RMW_UXRCE_MAX_SESSIONS": "a library has one session",
        "RMW_UXRCE_MAX_TOPICS": _COUNTED,
        "RMW_UXRCE_TYPE_NAME_MAX_LENGTH": _EXACT,
        "RMW_UXRCE_REF_BUFFER_LENGTH": _EXACT,
        "RMW_UXRCE_XML_BUFFER_LENGTH": _EXACT,
        "RMW_UXRCE_ENTITY_CREATION_DESTROY_TIMEOUT": _CALLS,
        "RMW_UXRCE_ENTITY_CREATION_TIMEOUT": _CALLS,
        "RMW_UXRCE_ENTITY_DESTROY_TIMEOUT": _CALLS,
        "RMW_UXRCE_IPV": "the agent's address says it; one of IPv6 stands in brackets",
        "RMW_UXRCE_C_STANDARD": "the library is C99",
        "RMW_UROS_ERROR_HANDLING": "failing calls leave a text behind rcl_get_error_string (`errors: text`)",
        "UCLIENT_MAX_OUTPUT_BEST_EFFORT_STREAMS": _PLANNED,
        "UCLIENT_MAX_OUTPUT_RELIABLE_STREAMS": _PLANNED,
        "UCLIENT_MAX_INPUT_BEST_EFFORT_STREAMS": _PLANNED,
        "UCLIENT_MAX_INPUT_RELIABLE_STREAMS": _PLANNED,
        "UCLIENT_MAX_SESSION_CONNECTION_ATTEMPTS": _SESSION,
        "UCLIENT_MIN_SESSION_CONNECTION_INTERVAL": _SESSION,
        "UCLIENT_MIN_HEARTBEAT_TIME_INTERVAL": _SESSION,
        "UCLIENT_PROFILE_UDP": _TRANSPORT,
        "UCLIENT_PROFILE_TCP": _TRANSPORT,
        "UCLIENT_PROFILE_SERIAL": _TRANSPORT,
        "UCLIENT_PROFILE_CUSTOM_TRANSPORT": _TRANSPORT,
        "UCLIENT_PROFILE_STREAM_FRAMING": _TRANSPORT,
        "UCLIENT_PLATFORM_POSIX": "`target` says it",
        "UCLIENT_BIG_ENDIANNESS": "`target` says it",
        "UCLIENT_C_STANDARD": "the library is C99",
        "UCLIENT_PIC": _BUILD,
        "UCLIENT_SUPERBUILD": _BUILD,
        "UCLIENT_BUILD_MICROCDR": _BUILD,
        "UCLIENT_ISOLATED_INSTALL": _BUILD,
        "UCLIENT_VERBOSE_MESSAGE": "the agent shows each message (`agent -vv`)",
        "UCLIENT_VERBOSE_SERIALIZATION": "the agent shows each message (`agent -vv`)",
        "UCLIENT_TWEAK_XRCE_WRITE_LIMIT": "messages of up to 65,527 bytes go in fragments",
        "RCUTILS_NO_FILESYSTEM": _HEAP,
        "RCUTILS_NO_THREAD_SUPPORT": _HEAP,
        "RCUTILS_NO_64_ATOMIC": _HEAP,
        "RCUTILS_AVOID_DYNAMIC_ALLOCATION": _HEAP,
        "RCUTILS_NO_LOGGING": "log messages come in with the component `logging` alone",
        "RCUTILS_MICROROS": _BUILD,
        "RCL_MICROROS": _BUILD,
        "RCL_COMMAND_LINE_ENABLED": "arguments of a command line are not read",
        "RCL_LOGGING_ENABLED": "log messages come in with the component `logging` alone",
        "TRACETOOLS_DISABLED": _CORE,
        "TRACETOOLS_STATUS_CHECKING_TOOL": _CORE,
        "ROSIDL_TYPESUPPORT_SINGLE_TYPESUPPORT": "there is one type support, generated for the selected types",
        "ENABLE_TESTING": _TESTS,
        "BUILD_TESTING": _TESTS,
    }
)

PREFIXES_OF_BUILDS = (
    "CMAKE_",
    "BUILD_",
    "UCLIENT_BUILD_",
    "UCLIENT_INSTALL_",
    "THIRDPARTY",
    "INSTALL_",
    "PYTHON_",
)
OF_A_BUILD = _BUILD

NOT_HERE_WHEN_ON: Mapping[str, str] = MappingProxyType(
    {
        "RMW_UXRCE_GRAPH": "declare the nodes and write `components: [+graph]`, which needs a graph server",
        "RMW_UXRCE_ALLOW_DYNAMIC_ALLOCATIONS": "pools do not grow: the library has no heap. Declare all entities",
        "UCLIENT_PROFILE_CAN": "`transport: {type: canfd, id: 0x7f}` selects it, with the identifier of this client",
        "UCLIENT_PROFILE_SHARED_MEMORY": "delivery inside one device goes through the agent in this version",
        "UCLIENT_PROFILE_MATCHING": "matching of QoS on the device is not in this version; the agent does it",
    }
)
"""Settings that mean nothing here while they are off, and what is to be said where they are on."""
