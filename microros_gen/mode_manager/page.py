# SPDX-License-Identifier: Apache-2.0
"""The overview of a monitor as a page, for browsers on this machine."""

from __future__ import annotations

import ipaddress
import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from microros_gen.diagnostics import Diagnostic, UserError

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>System modes</title>
<style>
:root { color-scheme: light dark; font-family: system-ui, sans-serif; }
body { margin: 1rem; }
div { overflow-x: auto; }
table { border-collapse: collapse; }
th, td { padding: .25rem .75rem; text-align: left; white-space: nowrap; }
tr { border-bottom: 1px solid #8886; }
.ok .level { color: #2a8a3e; }
.warning .level { color: #b07800; }
.error .level { color: #d03030; }
.stale { opacity: .7; }
</style>
</head>
<body>
<h1>System modes</h1>
<p id="since" role="status">Loading</p>
<div><table>
<thead><tr><th>part</th><th>target</th><th>actual</th><th>level</th><th>message</th></tr></thead>
<tbody id="parts"></tbody>
</table></div>
<script>
const body = document.getElementById("parts"), since = document.getElementById("since");
function cell(row, name, text) {
  const made = row.insertCell();
  made.className = name;
  made.textContent = text;
  return made;
}
function show(data) {
  const rows = document.createElement("tbody");
  for (const part of data.parts) {
    const row = rows.insertRow();
    row.className = part.level;
    row.id = "part-" + part.part;
    cell(row, "part", part.part).style.paddingLeft = (0.75 + 1.5 * part.depth) + "rem";
    for (const name of ["target", "actual", "level"]) cell(row, name, part[name]);
    cell(row, "message", part.rule ? part.message + " (rule " + part.rule + ")" : part.message);
  }
  body.replaceChildren(...rows.children);
}
async function poll() {
  try {
    show(await (await fetch("/state.json", {cache: "no-store"})).json());
    since.textContent = "Live";
  } catch {
    since.textContent = "The monitor does not answer";
  }
  setTimeout(poll, 1000);
}
poll();
</script>
</body>
</html>
"""
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'"


class _Handler(BaseHTTPRequestHandler):
    """Answers GET of the page and of its data."""

    def __init__(self, data: Callable[[], dict[str, Any]], *arguments: Any) -> None:
        self._data = data
        super().__init__(*arguments)

    def do_GET(self) -> None:
        """Answer; a request with another host name comes from a page of somebody else."""
        if not is_loopback(self.headers.get("Host", "").rpartition(":")[0]):
            self.send_error(403)
        elif self.path == "/":
            self._send("text/html; charset=utf-8", _PAGE)
        elif self.path == "/state.json":
            self._send("application/json", json.dumps(self._data()))
        else:
            self.send_error(404)

    def log_message(self, format: str, *arguments: Any) -> None:
        """Log nothing: stdout and stderr belong to the monitor."""

    def _send(self, kind: str, text: str) -> None:
        content = text.encode()
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Content-Security-Policy", _POLICY)
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(content)


def check_place(place: str) -> tuple[str, int]:
    """Return host and port of HOST:PORT. Raises UserError if that is no address of this machine alone."""
    host, colon, port = place.rpartition(":")
    if not colon or not is_loopback(host) or not port.isdecimal() or int(port) > 65535:
        hint = "Write 127.0.0.1:8080; for other machines, forward the port with ssh -L"
        raise UserError([Diagnostic(f"'{place}' is no place for a page", hint=hint, id="MG-8875")])
    return host, int(port)


@contextmanager
def served_page(place: str, data: Callable[[], dict[str, Any]]) -> Iterator[str]:
    """Serve the page at HOST:PORT within the context; give its address. Port 0: a free one.

    `data` is called in other threads. Raises UserError as `check_place` does, and for a port that cannot be used.
    """
    host, port = check_place(place)
    try:
        server = ThreadingHTTPServer((host, port), partial(_Handler, data))
    except OSError as error:
        hint = "Choose another port, or 0 for a free one"
        message = f"the page cannot be served at '{place}': {error.strerror}"
        raise UserError([Diagnostic(message, hint=hint, id="MG-8876")]) from error
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://{host}:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def is_loopback(host: str) -> bool:
    """Return whether a host name or IPv4 address is the one of this machine itself."""
    if host == "localhost":
        return True
    try:
        return ipaddress.IPv4Address(host).is_loopback
    except ValueError:
        return False
