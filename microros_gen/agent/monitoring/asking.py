# SPDX-License-Identifier: Apache-2.0
"""Asks a running agent at its local socket."""

from __future__ import annotations

import http.client
import json
import socket
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

from microros_gen.agent.log import printable
from microros_gen.agent.monitoring.document import VERSION
from microros_gen.agent.monitoring.shape import fault_of

ANSWER_S = 10.0
"""Seconds to wait for an answer: more than the agent waits for its own thread."""
LARGEST_BYTES = 64 << 20
"""Bytes of an answer that are read: that of an agent with 1000 clients has less than 1 MB."""

AGAIN_S = 0.02
"""Seconds until a connection is tried again, of which too many wait already."""


class NoAnswerError(Exception):
    """An agent that gave no answer that can be used; the text says why."""


class _LocalConnection(http.client.HTTPConnection):
    """HTTP over a local socket."""

    def __init__(self, path: Path, timeout_s: float) -> None:
        super().__init__("localhost", timeout=timeout_s)
        self._path = path
        self._timeout_s = timeout_s

    def connect(self) -> None:
        """Connect. Raises OSError."""
        self.sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.sock.settimeout(self._timeout_s)
        end = time.monotonic() + self._timeout_s
        while True:
            try:
                self.sock.connect(str(self._path))
                return
            except (
                BlockingIOError
            ) as error:  # a local socket does not wait for room in the queue (connect(2))
                if time.monotonic() >= end:
                    raise TimeoutError from error
                time.sleep(AGAIN_S)


def ask(path: Path, question: str, timeout_s: float = ANSWER_S) -> tuple[int, bytes]:
    """Return status and content of the answer to `GET question`, which is complete within `timeout_s` seconds.

    Raises PermissionError or another OSError if nobody can be asked at the socket, and NoAnswerError.
    """
    connection = _LocalConnection(path, timeout_s)
    late = threading.Event()
    # HTTPConnection forgets its socket before an answer without a length is read.
    opened: list[socket.socket] = []

    def give_up() -> None:
        late.set()
        with suppress(OSError):
            # Reads end at once; the time-out of each is no limit for all.
            opened[0].shutdown(socket.SHUT_RDWR)

    watch = threading.Timer(timeout_s, give_up)
    watch.daemon = True
    try:
        connection.connect()
        opened.append(connection.sock)
        watch.start()
        connection.request("GET", question)
        response = connection.getresponse()
        content = response.read(LARGEST_BYTES + 1)
        if late.is_set():
            raise TimeoutError
    except (TimeoutError, http.client.HTTPException, ConnectionResetError, BrokenPipeError) as error:
        if late.is_set() or isinstance(error, TimeoutError):
            raise NoAnswerError(f"no answer within {timeout_s:g} s") from error
        raise NoAnswerError("it is no agent, or it has ended") from error
    finally:
        watch.cancel()
        connection.close()
    if len(content) > LARGEST_BYTES:
        raise NoAnswerError(f"the answer has more than {LARGEST_BYTES >> 20} MiB")
    return response.status, content


def ask_status(path: Path, question: str, timeout_s: float = ANSWER_S) -> dict[str, Any]:
    """Return the status, as in `document_of`: of this version, it has all keys. Errors as `ask`."""
    status, content = ask(path, question, timeout_s)
    if status != 200:
        text = printable(content.decode(errors="replace").strip()[:200])
        raise NoAnswerError(text or f"status {status}")
    try:
        document = json.loads(content)
    except (ValueError, RecursionError):
        document = None
    if not isinstance(document, dict) or type(document.get("version")) is not int:
        raise NoAnswerError("the answer is no status")
    fault = fault_of(document) if document["version"] == VERSION else ""
    if fault:
        raise NoAnswerError(f"the answer is no status: {fault}")
    return document
