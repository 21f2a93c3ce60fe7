# SPDX-License-Identifier: Apache-2.0
"""The status of an agent as a table for a terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.agent.log import printable
from microros_gen.cli.tables import format_table

_HEAD = (
    *("NAME", "KEY", "STATE", "TRANSPORT", "ROUND TRIP", "IN", "OUT", "LOST", "RESENT", "REPEATED"),
    *("QUEUE", "RECONNECTS", "LAST WARNING"),
)
_UNITS = ("B", "kB", "MB", "GB", "TB")
_SHORTENED = 60
"""Maximum characters of a warning."""


def status_table(document: Mapping[str, Any]) -> str:
    """Return the answer of an agent as text: a few lines about it, and a row for each client."""
    agent, clients = document["agent"], document["clients"]
    present = sum(client["state"] != "gone" for client in clients)
    places = ", ".join(
        f"{each['kind']} {each['address']}{'' if each['ready'] else ' (not ready)'}"
        for each in agent["transports"]
    )
    samples = agent["samples"]
    core = ", compiled core" if agent["core"] == "compiled" else ""
    lines = [
        f"agent {agent['pid']} (microros-gen {agent['version']}{core}), up {_time(agent['uptime_s'])}",
        f"transports: {printable(places)}",
        f"clients: {present} of at most {agent['clients_max']}; samples: {samples['from_clients']} from clients,"
        f" {samples['to_clients']} to clients; faults of input: {sum(agent['faults'].values())}",
    ]
    workers = agent["workers"]
    if workers:
        lines.append(f"workers: {', '.join(map(_worker, workers))}")
    head = "".join(f"{line}\n" for line in lines)
    if not clients:
        return head
    rows = [(*_row(client), *((str(client["worker"]),) if workers else ())) for client in clients]
    return f"{head}\n{format_table((*_HEAD, *(('WORKER',) if workers else ())), rows)}"


def _worker(worker: Mapping[str, Any]) -> str:
    process = f"process {worker['pid']}" if worker["ready"] else "not ready"
    restarts = f", started again {worker['restarts']} times" if worker["restarts"] else ""
    return f"{worker['number']} ({process}{restarts})"


def _row(client: Mapping[str, Any]) -> tuple[str, ...]:
    warning = printable(client["last_error"])
    return (
        printable(client["name"]) or "-",
        client["key"],
        client["state"],
        f"{client['transport'].partition(' ')[0]} {printable(client['address'])}",
        "-" if client["round_trip_s"] is None else f"{client['round_trip_s'] * 1000:.1f} ms",
        _traffic(client["received"]),
        _traffic(client["sent"]),
        str(client["lost"]),
        str(client["resent"]),
        str(client["repeated"]),
        f"{client['queue']['fill']:.0%}",
        str(client["reconnects"]),
        warning if len(warning) <= _SHORTENED else f"{warning[: _SHORTENED - 1]}…",
    )


def _traffic(direction: Mapping[str, Any]) -> str:
    rate = f"{direction['messages_per_s']:.0f}/s {_size(direction['bytes_per_s'])}/s"
    return f"{rate}, {_size(direction['bytes'])}"


def _size(count: float) -> str:
    for unit in _UNITS:
        if count < 1000 or unit == _UNITS[-1]:
            break
        count /= 1000
    return f"{count:.0f} {unit}" if unit == _UNITS[0] else f"{count:.1f} {unit}"


def _time(seconds: float) -> str:
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    return f"{f'{days} d ' if days else ''}{hours}:{minutes:02}:{rest:02}"
