# SPDX-License-Identifier: Apache-2.0
"""The application file that somebody begins with: one entity of each kind that the selected profiles have."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.migrate.draft import Draft, DraftEndpoint, DraftNode, DraftValue, Flow
from microros_gen.selection.model import Selection

AGENT = "127.0.0.1:8888"
"""Where the agent is until somebody says otherwise: on this machine, at the port that its examples use."""

_ENDPOINTS = {
    "publish": DraftEndpoint("publisher", "count", "std_msgs/msg/Int32"),
    "subscribe": DraftEndpoint("subscription", "numbers", "std_msgs/msg/Int32"),
    "services": DraftEndpoint("service", "add_two_ints", "example_interfaces/srv/AddTwoInts"),
}
_SUGGESTIONS = (
    'limits: {"*": {string: 64, sequence: 16}} # needed as soon as a type has strings (bytes) or sequences (elements)',
    "memory: {ram_budget: 8 KiB} # a library that takes more refuses the build",
)


def first_draft(selection: Selection, profiles: tuple[str, ...], name: str, target: str) -> Draft:
    """Return the proposal for `profiles`, as they were named, on `target`; its node is called `name`."""
    implying = [chosen.component.name for chosen in selection.components if chosen.component.implies]
    endpoints = [
        endpoint
        for component, endpoint in _ENDPOINTS.items()
        if selection.has(component) and not any(selection.serves_only(component, other) for other in implying)
    ]
    settings = {"target": DraftValue(target, "`microros-gen targets` lists them")}
    if any(endpoint.kind != "subscription" for endpoint in endpoints):
        note = (
            "what a write does while its stream is full: wait that long for the agent; `error` fails at once"
        )
        settings["on_full"] = DraftValue(Flow("block 1 s"), note)
    return Draft(
        profiles=profiles,
        nodes=(DraftNode(name, endpoints=tuple(endpoints)),),
        groups={"transport": transport_of(selection)},
        settings=settings,
        suggestions=_SUGGESTIONS,
    )


def transport_of(selection: Selection) -> Mapping[str, DraftValue]:
    """Return the keys of `transport` that say how the agent is reached."""
    kind = selection.transport
    keys: dict[str, DraftValue] = {"type": DraftValue(kind)}
    if kind == "serial":
        keys["baud"] = DraftValue(115_200)
    elif kind == "canfd":
        keys["id"] = DraftValue(0x7F, "each client of a bus needs its own")
    elif kind in ("udp", "tcp"):
        found = DraftValue("discover", "it asks for one by multicast; or its address and port")
        keys["agent"] = found if selection.has("discovery") else DraftValue(AGENT)
    return keys
