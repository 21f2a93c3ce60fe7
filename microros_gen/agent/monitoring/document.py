# SPDX-License-Identifier: Apache-2.0
"""The status of an agent as JSON: the answer to `GET /status.json`, described in docs/howto/monitoring.md.

Keys may be added within a version; one that changes its meaning or goes away makes a new version.
"""

from __future__ import annotations

import json
from typing import Any

from microros_gen.agent.monitoring.status import AgentStatus
from microros_gen.agent.states import ClientState
from microros_gen.agent.traffic import Direction

VERSION = 1
PATH = "/status.json"


def text_of(status: AgentStatus) -> str:
    """Return the status as JSON.

    Client by client, because the encoder does not let the agent's thread run meanwhile.
    """
    clients = ", ".join(json.dumps(client_data(state)) for state in status.clients)
    return f'{{"version": {VERSION}, "agent": {json.dumps(_agent(status))}, "clients": [{clients}]}}'


def _agent(status: AgentStatus) -> dict[str, Any]:
    return {
        "pid": status.pid,
        "version": status.version,
        "core": status.core,
        "started": round(status.started, 3),
        "uptime_s": round(status.uptime_s, 3),
        "domain": status.domain,
        "transports": [
            {"kind": each.kind, "address": each.address, "ready": each.ready} for each in status.transports
        ],
        "clients_max": status.clients_max,
        "samples": {"from_clients": status.from_clients, "to_clients": status.to_clients},
        "faults": dict(sorted(status.faults.items())),
        "workers": [
            {"number": each.number, "pid": each.pid, "ready": each.ready, "restarts": each.restarts}
            for each in status.workers
        ],
    }


def client_data(state: ClientState) -> dict[str, Any]:
    """Return the status of one client as data for JSON."""
    return {
        "name": name_of(state),
        "key": state.key,
        "state": state.presence.name.lower(),
        "transport": state.transport,
        "address": state.address,
        "nodes": list(state.nodes),
        "silent_s": round(state.silent_s, 3),
        "round_trip_s": None if state.round_trip_s is None else round(state.round_trip_s, 6),
        "received": _direction(state.received),
        "sent": _direction(state.sent),
        "lost": state.lost,
        "resent": state.resent,
        "repeated": state.repeated,
        "queue": {
            "fill": round(state.queue.fill, 4),
            "messages": state.queue.messages,
            "bytes": state.queue.bytes,
            "input_bytes": state.input_bytes,
        },
        "sessions": state.sessions,
        "reconnects": state.reconnects,
        "silences": state.silences,
        "denied": state.denied,
        "last_error": state.last_error,
        "worker": state.worker,
    }


def name_of(state: ClientState) -> str:
    """Return the name of a client: that of its first node; empty: it has none."""
    return state.nodes[0] if state.nodes else ""


def _direction(direction: Direction) -> dict[str, Any]:
    return {
        "messages": direction.messages,
        "bytes": direction.bytes,
        "messages_per_s": round(direction.messages_per_s, 1),
        "bytes_per_s": round(direction.bytes_per_s, 1),
    }
