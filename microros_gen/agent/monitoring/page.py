# SPDX-License-Identifier: Apache-2.0
"""The status of an agent as a page that updates itself; it loads nothing from elsewhere."""

from __future__ import annotations

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Agent</title>
<style>
:root { color-scheme: light dark; font-family: system-ui, sans-serif; }
body { margin: 1rem; }
div { overflow-x: auto; }
table { border-collapse: collapse; }
th, td { padding: .25rem .75rem; text-align: left; white-space: nowrap; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
tr { border-bottom: 1px solid #8886; }
.connected .state { color: #2a8a3e; }
.silent .state { color: #b07800; }
.gone, .old { opacity: .6; }
</style>
</head>
<body>
<h1>Agent</h1>
<p id="since" role="status">Loading</p>
<p id="agent"></p>
<div><table>
<thead><tr><th>name</th><th>key</th><th>state</th><th>transport</th><th>address</th><th>round trip</th>
<th>in</th><th></th><th>out</th><th></th><th>lost</th><th>resent</th><th>repeated</th><th>queue</th>
<th>reconnects</th><th>last warning</th></tr></thead>
<tbody id="clients"></tbody>
</table></div>
<script>
const body = document.getElementById("clients"), since = document.getElementById("since");
const agent = document.getElementById("agent");
function cell(row, name, text) {
  const made = row.insertCell();
  made.className = name;
  made.textContent = text;
}
function size(count) {
  const units = ["B", "kB", "MB", "GB", "TB"];
  let unit = 0;
  while (count >= 1000 && unit < units.length - 1) { count /= 1000; unit += 1; }
  return count.toFixed(unit ? 1 : 0) + " " + units[unit];
}
function traffic(row, way) {
  cell(row, "number", way.messages_per_s.toFixed(0) + "/s");
  cell(row, "number", size(way.bytes_per_s) + "/s");
}
function show(data) {
  if (data.version !== 1) throw new Error("unknown version");
  const about = data.agent, made = document.createElement("tbody");
  agent.textContent = "Process " + about.pid + ", microros-gen " + about.version + ", up "
    + Math.floor(about.uptime_s) + " s; "
    + about.transports.map((t) => t.kind + " " + t.address + (t.ready ? "" : " (not ready)")).join(", ")
    + (about.workers.length ? "; " + about.workers.length + " workers" : "")
    + about.workers.map((w) => w.ready ? "" : " (" + w.number + " not ready)").join("")
    + "; samples: " + about.samples.from_clients + " from clients, " + about.samples.to_clients + " to clients";
  for (const client of data.clients) {
    const row = made.insertRow();
    row.className = client.state;
    row.id = "client-" + client.key;
    for (const name of ["name", "key", "state", "transport", "address"]) cell(row, name, client[name]);
    if (client.worker !== null) row.cells[3].textContent += ", worker " + client.worker;
    const trip = client.round_trip_s;
    cell(row, "number", trip === null ? "" : (trip * 1000).toFixed(1) + " ms");
    traffic(row, client.received);
    traffic(row, client.sent);
    for (const name of ["lost", "resent", "repeated"]) cell(row, "number", client[name]);
    cell(row, "number", (client.queue.fill * 100).toFixed(0) + " %");
    cell(row, "number", client.reconnects);
    cell(row, "error", client.last_error);
  }
  body.replaceChildren(...made.children);
}
async function poll() {
  try {
    const answer = await fetch("/status.json", {cache: "no-store", signal: AbortSignal.timeout(5000)});
    show(await answer.json());
    since.textContent = "Live";
    body.className = "";
  } catch {
    since.textContent = "The agent does not answer";
    body.className = "old";
  }
  setTimeout(poll, 1000);
}
poll();
</script>
</body>
</html>
"""
