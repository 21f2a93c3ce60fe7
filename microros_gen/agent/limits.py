# SPDX-License-Identifier: Apache-2.0
"""What one agent lets its clients use: nothing that comes over the wire makes it grow beyond this."""

from __future__ import annotations

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Limits:
    """Limits and time-outs; counts are per client unless they say otherwise."""

    clients: int = 256
    """Clients of the agent, sleeping ones included."""
    newcomers: int = 4_096
    """Senders that opened a session over UDP and said nothing in it yet: they take no client's place."""
    objects: int = 512
    """Objects (participants, topics, publishers, writers, …)."""
    streams: int = 8
    """Streams of each kind (best effort, reliable) and each direction."""
    message_bytes: int = 262_144
    """Largest message that comes in fragments; also what a stream holds after a gap."""
    memory_bytes: int = 268_435_456
    """Memory of the agent's process; near it nothing more is made, and beyond it the client that takes most is sent
    away. The pools below have to fit."""
    history_bytes: int = 33_554_432
    """What histories of writers and readers of all clients together take in DDS."""
    client_history_bytes: int = 16_777_216
    """The same of one client."""
    object_history_bytes: int = 8_388_608
    """The same of one writer or reader: 512 bytes for each sample of its depth, and the size of its largest sample."""
    object_bytes: int = 50_331_648
    """What objects of all clients together take, those in ROS 2 included (a reader: 70 kB)."""
    output_bytes: int = 16_777_216
    """What waits for all clients together: reliable messages that they have not acknowledged, and TCP connections that
    read slowly."""
    call_bytes: int = 8_388_608
    """What open requests of all clients together take, 256 bytes each."""
    input_bytes: int = 33_554_432
    """What comes from all clients together and waits: pieces of messages, what is after a gap or waits for DDS."""
    backlog_bytes: int = 65_536
    """What waits for a reliable stream to the client, beyond the window of 16 messages."""
    requests: int = 1_024
    """Requests without a reply of each requester and replier; the oldest is forgotten for one more."""
    request_wait_s: float = 5.0
    """Seconds that a request waits for its service to be there; then it is dropped, counted and told."""
    messages_per_second: int = 50_000
    """Messages that are taken from one client in a second; further ones are dropped and counted."""
    operations_per_second: int = 100
    """Objects that one client creates or deletes in a second, and messages outside of its session; ten seconds' worth
    may come at once. On a reliable stream further ones wait, others are refused."""
    turn_ms: float = 2.0
    """Milliseconds of work for one client before others have their turn; it goes on in its next one."""
    graph_ms_per_second: float = 200.0
    """Milliseconds of processor in a second in which nodes and endpoints of all clients come and go; one alone gets at
    most half, and three seconds' worth may come at once. Further CREATE and DELETE wait."""
    strangers_per_second: int = 2_000
    """Messages outside of any session that are answered in a second, of all senders together."""
    log_bytes_per_second: int = 16_384
    """Bytes of log in a second, in the long run; 1 MiB may come at once. Lines of -v are not counted."""
    minimum_mtu: int = 32
    """Smallest message size in bytes that a client may announce; a STATUS has to fit."""
    domains: int = 16
    """ROS domains of the agent that are open at one time."""
    client_timeout_s: float = 30.0
    """Seconds after which a client that was not heard leaves the ROS graph."""
    keep_s: float = 60.0
    """Seconds for which samples are kept that a client's reliable readers did not get, when it timed out or opens its
    session again; 0: nothing is. What may have arrived comes again."""
    sleep_timeout_s: float = 86_400.0
    """Seconds until a client that left the graph is forgotten; heard before that, its entities return."""
    stop_s: float = 1.0
    """Seconds for which a stopping agent waits for readers to acknowledge samples."""
    adopt_after_s: float = 5.0
    """Seconds that a sender without session and key is listened to before it is adopted: one with liveliness shows
    itself before (our clients ask after 1 s of silence and open a new session after 4 s at the latest)."""


PROBES = 5
"""A silent client is asked for a sign of life this often before its time-out ends."""
