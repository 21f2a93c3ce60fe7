# SPDX-License-Identifier: Apache-2.0
"""Limits of an agent: no input from the network makes it grow beyond these."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.records import dataclass

CLIENT_OBJECT_BYTES = 196_608
"""Bytes of objects that each client adds to the default limits: a node, two writers and readers take less."""


@dataclass(frozen=True)
class Limits:
    """Limits and time-outs; counts are per client unless they say otherwise."""

    clients: int = 256
    """Clients of the agent, sleeping ones included."""
    newcomers: int = 4_096
    """Senders that opened a session over UDP and have sent nothing in it yet; they do not count as clients."""
    objects: int = 512
    """Objects (participants, topics, publishers, writers, …)."""
    streams: int = 8
    """Streams of each kind (best effort, reliable) and each direction."""
    message_bytes: int = 262_144
    """Bytes of the largest fragmented message; also the bytes that a stream stores after a gap."""
    memory_bytes: int = 268_435_456
    """Bytes of the agent's process. Near it no objects are created, and above it the client with the most memory is
    removed. The pools below have to fit."""
    history_bytes: int = 33_554_432
    """Bytes of the DDS histories of all clients' writers and readers."""
    client_history_bytes: int = 16_777_216
    """The same of one client."""
    object_history_bytes: int = 8_388_608
    """The same of one writer or reader: 512 bytes for each sample of its depth, and the size of its largest sample."""
    object_bytes: int = 50_331_648
    """Bytes of all clients' objects, including their ROS 2 entities (a reader: 70 kB)."""
    output_bytes: int = 16_777_216
    """Bytes of output that waits for all clients: unacknowledged reliable messages, and data for slow TCP
    connections."""
    call_bytes: int = 8_388_608
    """Bytes of all clients' open requests, 256 each."""
    input_bytes: int = 33_554_432
    """Bytes of waiting input of all clients: fragments, messages after a gap, messages that wait for DDS."""
    backlog_bytes: int = 65_536
    """Bytes that wait for a reliable stream to the client, beyond the window of 16 messages."""
    requests: int = 1_024
    """Requests without a reply of each requester and replier; one more replaces the oldest."""
    request_wait_s: float = 5.0
    """Seconds that a request waits for its service to appear; then it is dropped, counted and reported."""
    messages_per_second: int = 50_000
    """Messages accepted from one client per second; further ones are dropped and counted."""
    operations_per_second: int = 100
    """Objects that one client creates or deletes in a second, and messages outside of its session; ten seconds' worth
    may come at once. On a reliable stream further ones wait, others are refused."""
    turn_ms: float = 2.0
    """Milliseconds of work for one client before the next client's turn; it continues in its next turn."""
    graph_ms_per_second: float = 200.0
    """Milliseconds of processor in a second in which nodes and endpoints of all clients come and go; one alone gets at
    most half, and three seconds' worth may come at once. Further CREATE and DELETE wait."""
    strangers_per_second: int = 2_000
    """Messages outside of any session that are answered per second, for all senders together."""
    log_bytes_per_second: int = 16_384
    """Bytes of log per second on average; 1 MiB may be written at once. Lines of -v are not counted."""
    minimum_mtu: int = 32
    """Smallest message size in bytes that a client may announce; a STATUS has to fit."""
    domains: int = 16
    """ROS domains of the agent that are open at one time."""
    client_timeout_s: float = 30.0
    """Seconds after which a silent client leaves the ROS graph."""
    keep_s: float = 60.0
    """Seconds for which samples are kept that a client's reliable readers did not get, when it timed out or opens its
    session again; 0: nothing is. What may have arrived comes again."""
    sleep_timeout_s: float = 86_400.0
    """Seconds until a client that left the graph is removed; a message before that restores its entities."""
    stop_s: float = 1.0
    """Seconds for which a stopping agent waits for readers to acknowledge samples."""
    adopt_after_s: float = 5.0
    """Seconds that a sender without session and key is listened to before it is adopted: one with liveliness shows
    itself before (our clients ask after 1 s of silence and open a new session after 4 s at the latest)."""


PROBES = 5
"""Number of probes of a silent client before its time-out ends."""


def limits_with(chosen: Mapping[str, Any]) -> Limits:
    """Return the limits with those that the user has chosen, by name.

    With more clients than by default, the memory of their objects and that of the process are larger, unless the user
    has chosen one of the two.
    """
    default = Limits()
    more = chosen.get("clients", default.clients) - default.clients
    if more <= 0 or "object_bytes" in chosen or "memory_bytes" in chosen:
        return Limits(**chosen)
    extra = more * CLIENT_OBJECT_BYTES
    memory = {
        "object_bytes": default.object_bytes + extra,
        "memory_bytes": default.memory_bytes + extra,
    }
    return Limits(**{**chosen, **memory})
