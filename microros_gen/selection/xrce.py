# SPDX-License-Identifier: Apache-2.0
"""The vocabulary of OMG DDS-XRCE 1.0: profiles, submessages and object kinds, each in its fixed order."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

XRCE_PROFILES = (
    "read",
    "write",
    "configure_entities",
    "configure_qos",
    "configure_types",
    "discovery",
    "file_configuration",
    "udp",
    "tcp",
    "complete",
)
"""The profiles of clause 2, in the order of D1.4, 4.10.3.2."""

SUBMESSAGES: Mapping[str, int] = MappingProxyType(
    {
        name: number
        for number, name in enumerate(
            (
                "CREATE_CLIENT",
                "CREATE",
                "GET_INFO",
                "DELETE",
                "STATUS_AGENT",
                "STATUS",
                "INFO",
                "WRITE_DATA",
                "READ_DATA",
                "DATA",
                "ACKNACK",
                "HEARTBEAT",
                "RESET",
                "FRAGMENT",
                "TIMESTAMP",
                "TIMESTAMP_REPLY",
            )
        )
    }
)
"""Submessage → its id (clause 8.3.4)."""

OBJECT_KINDS: Mapping[str, int] = MappingProxyType(
    {
        "participant": 0x01,
        "topic": 0x02,
        "publisher": 0x03,
        "subscriber": 0x04,
        "datawriter": 0x05,
        "datareader": 0x06,
        "requester": 0x07,
        "replier": 0x08,
        "type": 0x0A,
        "qosprofile": 0x0B,
        "application": 0x0C,
        "agent": 0x0D,
        "client": 0x0E,
    }
)
"""Object kind → its number (clause 7.7).

Requester and replier are an addition of the reference implementation.
"""

MICRO_ROS_COMPONENTS = (
    "node",
    "lifecycle",
    "publish",
    "subscribe",
    "services",
    "timers",
    "clock",
    "logging",
    "parameters",
    "executor",
    "discovery",
)
"""The eleven components of D1.4, 4.10.3.1, in its order."""
