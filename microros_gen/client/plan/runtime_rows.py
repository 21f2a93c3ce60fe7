# SPDX-License-Identifier: Apache-2.0
"""Rows of tables that the runtime's plan prints."""

from __future__ import annotations

from microros_gen.records import dataclass


@dataclass(frozen=True)
class EndpointRow:
    """A row of the table of declared endpoints, as PublisherPlan; an empty name is a place that nobody declared."""

    name: str = ""
    dds_type: str = ""
    node: int = 0
    limited: str = ""
    declared_as: str = ""

    @property
    def limited_type(self) -> str:
        """The address in C of the type with its own limits; NULL without such."""
        return f"&{self.limited}__message_type" if self.limited else "NULL"


@dataclass(frozen=True)
class SourceMembers:
    """Members of the tables of declarations that hold the names of the source code."""

    node: str
    namespace: str
    endpoint: str


@dataclass(frozen=True)
class QueueRow:
    """Where a queue lies in the storage of all: its first slot, the first byte of that, and how many bytes it has."""

    slots: int
    slot_size: int
    first: int
    offset: int
    size: int
