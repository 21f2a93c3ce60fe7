# SPDX-License-Identifier: Apache-2.0
"""Whether a client that is not heard has gone, or its line loses what it says.

A silent client is asked for signs of life. How many have to stay unanswered follows from what its line lost before:
questions that stayed without an answer, and reliable messages that had to be sent again. On a line that loses nothing
the time-out is as it was set; on one that loses a third each way it is up to twice as long.
"""

from __future__ import annotations

import math
from enum import Enum

from microros_gen.agent.clients import Client
from microros_gen.agent.limits import PROBES

MOST_PROBES = 15
"""Questions that stay unanswered on the worst of lines before its client has gone."""
WRONG = 1e-4
"""How likely it may be that a client is taken for gone although it answers everything it hears."""
LOST, ANSWERED = 0.2, 0.05
"""Weight of the newest question in what is known of the losses: losses come in groups, and are remembered longer."""


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


def ask(client: Client, now: float) -> None:
    """Send a question that every client answers."""
    client.probed = now
    client.probes += 1
    client.send(client.session.probe())


def loss_of(client: Client) -> float:
    """Return the estimated part of questions that stay unanswered, 0 to 1."""
    arrives = 1 - client.session.repeated_part()
    return max(client.loss, 1 - arrives * arrives)


def stretch(loss: float) -> float:
    """Return the factor of a time-out, 1 to 2, when this part of questions stays unanswered."""
    wanted = math.log(WRONG) / math.log(min(0.99, max(loss, 1e-9)))
    return 1 + (min(MOST_PROBES, max(PROBES, wanted)) - PROBES) / (2 * PROBES)


def _learn(client: Client) -> None:
    """Record that the last of several questions was answered and the earlier ones were not."""
    for _ in range(min(client.probes - 1, MOST_PROBES)):
        client.loss += (1 - client.loss) * LOST
    client.loss -= client.loss * ANSWERED
    client.probes = 0
