# SPDX-License-Identifier: Apache-2.0
"""CREATE_CLIENT of a client that nobody knows."""

from __future__ import annotations

from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.agent.wire.submessages import encode


def hello(key: int, session: int = 0x81, timeout_ms: int = 0, mtu: int = 512) -> bytes:
    """Return the CREATE_CLIENT of a key, perhaps with its own time-out."""
    properties = (("uxr_hl", str(timeout_ms)),) if timeout_ms else None
    head = Header(session & 0x80, 0, 0, b"" if session >= 0x80 else key.to_bytes(4, "big"))
    return join(head, [encode(CreateClient(key.to_bytes(4, "big"), session, mtu, properties=properties))])
