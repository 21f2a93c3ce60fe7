# SPDX-License-Identifier: Apache-2.0
"""Asks a running agent at its local socket."""

from __future__ import annotations

import http.client
import json
import socket
import time
from pathlib import Path
from typing import Any

from microros_gen.agent.log import printable

ANSWER_S = 10.0
"""Seconds to wait for an answer: more than the agent waits for its own thread."""


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
    """Return status and content of the answer to `GET question`.

    Raises PermissionError or another OSError if nobody can be asked at the socket, and NoAnswerError.
    """
    connection = _LocalConnection(path, timeout_s)
    try:
        connection.connect()
        connection.request("GET", question)
        response = connection.getresponse()
        return response.status, response.read()
    except TimeoutError as error:
        raise NoAnswerError(f"no answer within {timeout_s:g} s") from error
    except (http.client.HTTPException, ConnectionResetError, BrokenPipeError) as error:
        raise NoAnswerError("it is no agent, or it has ended") from error
    finally:
        connection.close()


def ask_status(path: Path, question: str, timeout_s: float = ANSWER_S) -> dict[str, Any]:
    """Return the status, as in `document_of`; errors as `ask`."""
    status, content = ask(path, question, timeout_s)
    if status != 200:
        text = printable(content.decode(errors="replace").strip()[:200])
        raise NoAnswerError(text or f"status {status}")
    try:
        document = json.loads(content)
        if isinstance(document, dict) and isinstance(document["version"], int):
            return document
    except (ValueError, KeyError):
        pass
    raise NoAnswerError("the answer is no status")
