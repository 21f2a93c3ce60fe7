# SPDX-License-Identifier: Apache-2.0
"""A worker without ROS, for tests of its front: it does what the first word of a message says.

`echo` is sent back to where it came from, `claim` opens a session there, `enter` admits a newcomer there, `type`
reports a type, `fall` ends the process with status 3, and `hang` stops it. When a client has to leave, it does. Each
message counts as a client. What it got on standard input names how it starts: `refuse` is a fault in its files, `sleep`
never serves.
"""

from __future__ import annotations

import os
import pickle
import select
import socket
import sys
import time

from microros_gen.agent.workers.channel import Channel, Kind, message_frame, message_of
from microros_gen.agent.workers.report import Report
from microros_gen.diagnostics import Diagnostic


def main() -> None:
    """Serve until the front says stop."""
    channel = Channel(socket.socket(fileno=int(sys.argv[1])))
    start = sys.stdin.read()
    if start == "refuse":
        channel.send(Kind.FAILED, pickle.dumps([Diagnostic("a fault", id="MG-9703")]))
        channel.finish(5.0)
        return
    while start == "sleep":
        time.sleep(1000)
    channel.send(Kind.READY)
    count = 0
    while not channel.closed:
        channel.flush()
        select.select([channel.fileno()], [], [])
        for kind, content in channel.receive():
            if kind is Kind.STOP:
                channel.finish(5.0)
            elif kind is Kind.ASK:
                channel.send(
                    Kind.STATUS,
                    Report(samples=count, clients=() if content else None, connected=count).encode(),
                )
            elif kind is Kind.LEFT:
                channel.send(Kind.RELEASED, content)
            elif kind is Kind.MESSAGE:
                count += 1
                _do(channel, content)


def _do(channel: Channel, content: bytes) -> None:
    number, code, data = message_of(content)
    word = data[12:].split()[0]
    if word == b"echo":
        channel.send(Kind.MESSAGE, message_frame(number, code, data))
    elif word == b"claim":
        channel.send(Kind.CLAIMED, message_frame(number, code))
    elif word == b"enter":
        channel.send(Kind.NEWCOMER, message_frame(number, code, b"welcome"))
    elif word == b"type":
        channel.send(Kind.TYPE, b"a/msg/Type")
    elif word == b"fall":
        os._exit(3)
    elif word == b"hang":
        time.sleep(1000)


if __name__ == "__main__":
    main()
