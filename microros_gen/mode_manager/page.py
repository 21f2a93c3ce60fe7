# SPDX-License-Identifier: Apache-2.0
"""The overview of a monitor as a page, for browsers on this machine."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.web.places import Place, is_loopback, read_place
from microros_gen.web.server import Answer, served

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
    const rule = part.diagnostics ? part.rule + ": " + part.diagnostics : part.rule;
    cell(row, "message", part.rule ? part.message + " (rule " + rule + ")" : part.message);
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


def check_place(text: str) -> Place:
    """Return the place HOST:PORT. Raises UserError if that is no address of this machine alone."""
    place = read_place(text)
    if place is None or ":" not in text or not is_loopback(place.host):
        hint = "Write 127.0.0.1:8080; for other machines, forward the port with ssh -L"
        raise UserError([Diagnostic(f"'{text}' is no place for a page", hint=hint, id="MG-8875")])
    return place


@contextmanager
def served_page(place: str, data: Callable[[], dict[str, Any]]) -> Iterator[str]:
    """Serve the page at HOST:PORT within the context; give its address. Port 0: a free one.

    `data` is called in other threads. Raises UserError as `check_place` does, and for a port that cannot be used.
    """
    where = check_place(place)
    routes = {
        "/": lambda: Answer("text/html; charset=utf-8", _PAGE.encode()),
        "/state.json": lambda: Answer("application/json", json.dumps(data()).encode()),
    }
    with ExitStack() as stack:
        try:
            address = stack.enter_context(served(where, routes))
        except OSError as error:
            hint = "Choose another port, or 0 for a free one"
            message = f"the page cannot be served at '{place}': {error.strerror}"
            raise UserError([Diagnostic(message, hint=hint, id="MG-8876")]) from error
        yield address
