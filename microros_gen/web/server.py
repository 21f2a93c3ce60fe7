# SPDX-License-Identifier: Apache-2.0
"""Answers GET of a few paths, over TCP or a local socket, in threads."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import partial
from http.server import BaseHTTPRequestHandler
from socketserver import BaseServer, ThreadingMixIn
from typing import Any

from microros_gen.records import dataclass
from microros_gen.web.places import Place, host_of, is_loopback

CONNECTIONS = 32
"""Maximum number of connections that are answered at the same time; further ones are closed."""
SILENT_S = 10.0
"""Seconds after which a connection that sends or takes nothing is closed."""
CUT_S = 30.0
"""Seconds after which every connection is closed."""
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'"


@dataclass(frozen=True)
class Answer:
    """An answer: the type of its content, the content, and the status of HTTP."""

    kind: str
    content: bytes
    status: int = 200


Routes = Mapping[str, Callable[[], Answer]]
"""Function that answers GET, by path; called in other threads."""


class _Handler(BaseHTTPRequestHandler):
    """Answers GET and HEAD of the paths of `routes`."""

    timeout = SILENT_S

    def __init__(self, routes: Routes, may_ask: Callable[[str], bool], *arguments: Any) -> None:
        self._routes = routes
        self._may_ask = may_ask
        super().__init__(*arguments)

    def do_GET(self) -> None:
        """Answer."""
        answer = self._answer()
        if answer is not None:
            self._send(answer, answer.content)

    def do_HEAD(self) -> None:
        """Answer as GET, without the content."""
        answer = self._answer()
        if answer is not None:
            self._send(answer, b"")

    def log_message(self, format: str, *arguments: Any) -> None:
        """Log nothing: stdout and stderr belong to the program."""

    def _answer(self) -> Answer | None:
        if not self._may_ask(host_of(self.headers.get("Host", "")).lower()):
            self.send_error(403)
            return None
        route = self._routes.get(self.path.partition("?")[0])
        if route is None:
            self.send_error(404)
            return None
        return route()

    def _send(self, answer: Answer, content: bytes) -> None:
        self.send_response(answer.status)
        self.send_header("Content-Type", answer.kind)
        self.send_header("Content-Length", str(len(answer.content)))
        self.send_header("Content-Security-Policy", _POLICY)
        self.send_header("X-Content-Type-Options", "nosniff")
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(content)


class HttpServer(ThreadingMixIn, BaseServer):
    """A server of a listening socket, which it closes at the end."""

    daemon_threads = True
    block_on_close = False

    def __init__(self, listener: socket.socket, routes: Routes, may_ask: Callable[[str], bool]) -> None:
        """`may_ask` gets the host name of each request, without the port: see `of_this_machine`."""
        super().__init__(listener.getsockname(), partial(_Handler, routes, may_ask))
        listener.setblocking(False)  # somebody may connect and be gone before the connection is accepted
        self.socket = listener
        self._free = threading.BoundedSemaphore(CONNECTIONS)

    def fileno(self) -> int:
        """Return the descriptor that is readable when somebody connects."""
        return self.socket.fileno()

    def get_request(self) -> tuple[socket.socket, Any]:
        """Accept a connection."""
        return self.socket.accept()

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer in a separate thread, if one is free."""
        if not self._free.acquire(blocking=False):
            request.close()
            return
        try:
            super().process_request(request, client_address)
        except RuntimeError:  # the system gives no more threads
            self._free.release()
            raise

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """Answer one connection, which is cut off after a while: one byte at a time would keep it for days."""
        limit = threading.Timer(CUT_S, _cut, (request,))
        limit.daemon = True
        try:
            limit.start()
            super().process_request_thread(request, client_address)
        finally:
            limit.cancel()
            self._free.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Ignore an asker that went away or was silent for too long: its connection is closed."""

    def shutdown_request(self, request: Any) -> None:
        """Close a connection."""
        request.close()

    def server_close(self) -> None:
        """Close the socket."""
        self.socket.close()


def _cut(connection: socket.socket) -> None:
    with suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)


def anyone(_host: str) -> bool:
    """Answer every request."""
    return True


@contextmanager
def served(place: Place, routes: Routes) -> Iterator[str]:
    """Answer at a place within the context; give its URL.

    On a loopback address, requests that name another host are refused: they come from a page of somebody else. Raises
    OSError if the place cannot be used.
    """
    listener = _listener(place)
    local = is_loopback(listener.getsockname()[0])  # also of a name: 127.0.1.1 is that of many machines
    own = place.host.lower()
    server = HttpServer(
        listener, routes, (lambda host: is_loopback(host) or host == own) if local else anyone
    )
    thread = threading.Thread(target=server.serve_forever, name="http", daemon=True)
    thread.start()
    try:
        yield f"http://{Place(place.host, listener.getsockname()[1]).address}/"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def _listener(place: Place) -> socket.socket:
    family, kind, number, _, address = socket.getaddrinfo(
        place.host, place.port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
    )[0]
    listener = socket.socket(family, kind, number)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen(CONNECTIONS)
    except OSError:
        listener.close()
        raise
    return listener
