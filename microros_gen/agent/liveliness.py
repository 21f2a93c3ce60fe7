# SPDX-License-Identifier: Apache-2.0
"""Decides whether a silent client is gone or its line loses messages.

A silent client is probed. How many probes must stay unanswered depends on the losses of its line so far: unanswered
probes, and reliable messages that had to be sent again. Without losses the time-out is as configured; on a line that
loses a third in each direction it is up to twice as long.
"""

from __future__ import annotations

import math
from enum import Enum

from microros_gen.agent.clients import Client
from microros_gen.agent.limits import PROBES
from microros_gen.agent.wire.constants import OBJECT_CLIENT, Status
from microros_gen.agent.wire.entity_messages import StatusReply

MOST_PROBES = 15
"""Number of unanswered probes after which a client on the worst line is considered gone."""
WRONG = 1e-4
"""Accepted probability of removing a client that answers every probe it receives."""
LOST, ANSWERED = 0.2, 0.05
"""Weight of the newest probe in the estimated loss; losses come in bursts, so they are remembered longer."""


_LOGOUT = 2
"""The request with which clients close their session (the public client's number, and this project's)."""


class Verdict(Enum):
    """What to do about a client."""

    FINE = 0
    ASK = 1
    GONE = 2


def judge(client: Client, now: float, patience_s: float) -> Verdict:
    """Return what to do about an awake client; it is probed after half of `patience_s` seconds at the latest."""
    if client.probes and client.last_received >= client.probed:
        _learn(client)
    silent = now - client.last_received
    probe_after_s = min(client.timeout_s, patience_s)
    if silent <= probe_after_s / 2:
        return Verdict.FINE
    if silent > client.timeout_s * stretch(loss_of(client)):
        return Verdict.GONE
    return Verdict.ASK if now - client.probed >= probe_after_s / (2 * PROBES) else Verdict.FINE


def is_well(client: Client, now: float, patience_s: float) -> bool:
    """Return whether an awake client has sent something lately: `judge` would have nothing to do for it."""
    probe_after_s = min(client.timeout_s, patience_s)
    return not client.probes and now - client.last_received <= probe_after_s / 2


def ask(client: Client, now: float) -> None:
    """Send a probe, which every client answers."""
    client.probed = now
    client.probes += 1
    client.send(client.session.probe())


def say_farewell(client: Client, status: Status = Status.OK) -> None:
    """Tell an awake client that its session ends: the answer to a DELETE of it, which it has not sent.

    `status` is DENIED if the agent would refuse it now.

    Clients with a list of agents go to the next one; others, the public ones too, ignore it.
    """
    if not client.asleep:
        client.send(client.session.unnumbered(StatusReply(_LOGOUT, OBJECT_CLIENT, status)))


def loss_of(client: Client) -> float:
    """Return the estimated fraction of unanswered probes, 0 to 1."""
    arrives = 1 - client.session.repeated_part()
    return max(client.loss, 1 - arrives * arrives)


def stretch(loss: float) -> float:
    """Return the factor for a time-out, 1 to 2, if the fraction `loss` of probes stays unanswered."""
    wanted = math.log(WRONG) / math.log(min(0.99, max(loss, 1e-9)))
    return 1 + (min(MOST_PROBES, max(PROBES, wanted)) - PROBES) / (2 * PROBES)


def _learn(client: Client) -> None:
    """Record that the last of several probes was answered and the earlier ones were not."""
    for _ in range(min(client.probes - 1, MOST_PROBES)):
        client.loss += (1 - client.loss) * LOST
    client.loss -= client.loss * ANSWERED
    client.probes = 0
