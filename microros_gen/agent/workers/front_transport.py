# SPDX-License-Identifier: Apache-2.0
"""What a worker knows of a transport of the front."""

from __future__ import annotations

from microros_gen.records import dataclass


@dataclass(frozen=True)
class FrontTransport:
    """A transport of the front: `descriptor` is that of its UDP socket, -1 for others."""

    label: str
    forgeable: bool
    descriptor: int = -1

    @property
    def kind(self) -> str:
        """Kind of the transport, as on the command line."""
        return self.label.partition(" ")[0]
