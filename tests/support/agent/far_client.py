# SPDX-License-Identifier: Apache-2.0
"""A client at another place, as a process: `udp|tcp HOST PORT KEY COUNT TEXT` publishes a text reliably."""

from __future__ import annotations

import socket
import sys

from tests.support.agent.client import NoAnswerError, XrceClient
from tests.support.agent.tcp_link import TcpLink
from tests.support.patience import seconds

TEXT = "std_msgs/msg/String"


def connect(client: XrceClient) -> None:
    """Open the session as a device does, which asks again when no answer arrives: a tunnel may still be opening."""
    for _ in range(10):
        try:
            assert client.connect() == 0
            return
        except NoAnswerError:
            continue
    raise NoAnswerError("no session after ten requests")


def main() -> None:
    """Publish a text COUNT times; print `done` when the agent has acknowledged everything."""
    kind, host, port, key, count, text = sys.argv[1:]
    link: TcpLink | socket.socket
    if kind == "tcp":
        link = TcpLink(host, int(port))
    else:
        link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        link.settimeout(seconds(5))
        link.connect((host, int(port)))
    body = (len(text) + 1).to_bytes(4, "little") + text.encode() + b"\0"
    with XrceClient(link, int(key, 0), timeout_s=1.0) as client:  # type: ignore[arg-type]
        connect(client)
        writer = client.publisher("far", "far", TEXT, 0, depth=int(count))
        for _ in range(int(count)):
            client.write(writer, body)
        client.drain()
        print("done", flush=True)


if __name__ == "__main__":
    main()
