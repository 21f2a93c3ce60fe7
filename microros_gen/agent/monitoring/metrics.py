# SPDX-License-Identifier: Apache-2.0
"""The status of an agent in the text format of Prometheus (exposition formats, text-based format, version 0.0.4).

Series of clients exist while a client is known and has not left, so their number is bounded by the limit `clients`;
their label is its key. Counters continue when a client reconnects.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from microros_gen.agent.monitoring.document import name_of
from microros_gen.agent.monitoring.status import AgentStatus
from microros_gen.agent.states import ClientState, Presence
from microros_gen.records import dataclass

CONTENT_TYPE = "text/plain; version=0.0.4; charset=utf-8"
PATH = "/metrics"
_PREFIX = "microros_agent_"
Labels = tuple[tuple[str, str], ...]
Samples = Iterable[tuple[Labels, float | None]]
"""Labels and value of each series of a family; without a value, a series is left out."""


@dataclass(frozen=True)
class _Family:
    """A metric: its name below the prefix, its type, and its text for HELP."""

    name: str
    kind: str
    text: str

    def lines(self, samples: Samples) -> Iterator[str]:
        """Yield the lines of the metric; none without a series."""
        full = _PREFIX + self.name
        found = [(labels, value) for labels, value in samples if value is not None]
        if found:
            yield f"# HELP {full} {self.text}"
            yield f"# TYPE {full} {self.kind}"
        for labels, value in found:
            text = ",".join(f'{key}="{_escaped(content)}"' for key, content in labels)
            yield f"{full}{{{text}}} {value!r}" if labels else f"{full} {value!r}"


_PRESENT = (Presence.CONNECTED, Presence.SILENT)
_AGENT: tuple[tuple[_Family, Callable[[AgentStatus], Samples]], ...] = (
    (
        _Family("build_info", "gauge", "Version of the agent; always 1."),
        lambda s: [((("version", s.version),), 1)],
    ),
    (
        _Family("start_time_seconds", "gauge", "When the agent started, in seconds since 1970."),
        lambda s: [((), s.started)],
    ),
    (
        _Family("transport_ready", "gauge", "Whether a transport accepts messages (1) or not (0)."),
        lambda s: [((("transport", f"{t.kind} {t.address}"),), int(t.ready)) for t in s.transports],
    ),
    (
        _Family("worker_ready", "gauge", "Whether a worker process serves (1) or not (0)."),
        lambda s: [((("worker", str(w.number)),), int(w.ready)) for w in s.workers],
    ),
    (
        _Family("worker_restarts_total", "counter", "How often a worker process was started again."),
        lambda s: [((("worker", str(w.number)),), w.restarts) for w in s.workers],
    ),
    (
        _Family("clients", "gauge", "Number of clients that have not left, and of refused ones, by state."),
        lambda s: [
            ((("state", p.name.lower()),), sum(c.presence is p for c in s.clients))
            for p in (*_PRESENT, Presence.REFUSED)
        ],
    ),
    (_Family("clients_limit", "gauge", "Maximum number of clients."), lambda s: [((), s.clients_max)]),
    (
        _Family(
            "samples_from_clients_total",
            "counter",
            "Samples, requests and replies that were passed to ROS 2.",
        ),
        lambda s: [((), s.from_clients)],
    ),
    (
        _Family(
            "samples_to_clients_total", "counter", "Samples, requests and replies that were sent to clients."
        ),
        lambda s: [((), s.to_clients)],
    ),
    (
        _Family("faults_total", "counter", "Faults of input, by kind as in the log."),
        lambda s: [((("kind", kind),), count) for kind, count in sorted(s.faults.items())],
    ),
)
_CLIENT: tuple[tuple[_Family, Callable[[ClientState, float], float | None]], ...] = (
    (
        _Family("client_connected", "gauge", "Whether a client is connected (1) or silent (0)."),
        lambda c, _: int(c.presence is Presence.CONNECTED),
    ),
    (
        _Family("client_last_message_timestamp_seconds", "gauge", "When its last message came, since 1970."),
        lambda c, now: round(now - c.silent_s, 3),
    ),
    (
        _Family(
            "client_round_trip_seconds", "gauge", "Last time from a reliable message to its acknowledgement."
        ),
        lambda c, _: c.round_trip_s,
    ),
    (
        _Family("client_received_messages_total", "counter", "Messages from the client."),
        lambda c, _: c.received.messages,
    ),
    (
        _Family("client_received_bytes_total", "counter", "Bytes of messages from the client."),
        lambda c, _: c.received.bytes,
    ),
    (
        _Family("client_sent_messages_total", "counter", "Messages to the client."),
        lambda c, _: c.sent.messages,
    ),
    (
        _Family("client_sent_bytes_total", "counter", "Bytes of messages to the client."),
        lambda c, _: c.sent.bytes,
    ),
    (
        _Family("client_lost_messages_total", "counter", "Messages from the client that were lost or late."),
        lambda c, _: c.lost,
    ),
    (
        _Family("client_resent_messages_total", "counter", "Reliable messages that were sent to it again."),
        lambda c, _: c.resent,
    ),
    (
        _Family("client_repeated_messages_total", "counter", "Reliable messages from it that arrived again."),
        lambda c, _: c.repeated,
    ),
    (_Family("client_sessions_total", "counter", "Sessions that the client began."), lambda c, _: c.sessions),
    (_Family("client_silences_total", "counter", "Time-outs of the client."), lambda c, _: c.silences),
    (
        _Family("client_denied_total", "counter", "Its sessions and objects that the policy refused."),
        lambda c, _: c.denied,
    ),
    (
        _Family("client_queue_fill_ratio", "gauge", "How full the queue of output to the client is, 0 to 1."),
        lambda c, _: c.queue.fill,
    ),
    (
        _Family("client_queue_bytes", "gauge", "Bytes of output that wait for the client."),
        lambda c, _: c.queue.bytes,
    ),
    (
        _Family("client_input_bytes", "gauge", "Bytes of the client that wait to be processed."),
        lambda c, _: c.input_bytes,
    ),
)
_INFO = _Family("client_info", "gauge", "First node and transport of a client; always 1.")


def metrics_text(status: AgentStatus) -> str:
    """Return the metrics of an agent."""
    lines: list[str] = []
    for family, samples in _AGENT:
        lines += family.lines(samples(status))
    clients = [
        (client, (("client", client.key),)) for client in status.clients if client.presence in _PRESENT
    ]
    lines += _INFO.lines(
        ((*label, ("name", name_of(client)), ("transport", client.transport)), 1) for client, label in clients
    )
    for family, value in _CLIENT:
        lines += family.lines((label, value(client, status.now)) for client, label in clients)
    return "".join(f"{line}\n" for line in lines)


def _escaped(text: str) -> str:
    """Return a value of a label, where backslash, quote and line feed are escaped."""
    return text.replace("\\", r"\\").replace('"', r"\"").replace("\n", r"\n")
