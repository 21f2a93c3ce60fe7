# SPDX-License-Identifier: Apache-2.0
"""One call of a service of a node."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.ros.errors import RosError
from microros_gen.ros.peer import Peer

CALL_WAIT_S = 5.0
"""How long a node may take to be discovered, and to answer."""


def ask(peer: Peer, node: str, service: str, type_name: str, request: Mapping[str, Any]) -> dict[str, Any]:
    """Call `NODE/SERVICE` and return the response. Raises RosError without one within `CALL_WAIT_S`."""
    client = peer.client(f"{node}/{service}", type_name)
    try:
        response = client.call(request, CALL_WAIT_S)
    finally:
        peer.remove(client)
    if response is None:
        raise RosError(f"{node} does not answer {service} within {CALL_WAIT_S:.0f} s")
    return response
