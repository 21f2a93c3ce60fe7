# SPDX-License-Identifier: Apache-2.0
"""What components ask of a platform is what they call, and each capability has a header that declares it."""

from __future__ import annotations

import re

import pytest

from microros_gen.documents.templates import TEMPLATE_FOLDERS
from microros_gen.platform.capabilities import capabilities, prototypes
from microros_gen.selection.component import Component
from microros_gen.selection.find_components import load_catalogue

CATALOGUE = load_catalogue()
_COMMENT = re.compile(r"/\*.*?\*/|\{#.*?#\}", re.DOTALL)
# Called where another component is selected, which asks for it.
_OF_OTHERS = {
    ("session", "wait"): "executor",
    ("session", "wake"): "executor",
    ("session", "lock"): "multithread",
    ("multithread", "time"): "session",
    ("logging_console", "wake"): "executor",
    ("multithread", "wake"): "executor",
    ("peer", "wake"): "executor",
    ("transport_canfd", "canfd_link"): "peer",
}
_OF_THE_PLAN = {
    "support": {"port_unique_id"},
    "timers": {
        "port_timer_start",
        "port_timer_stop",
        "port_hardware_timer_start",
        "port_hardware_timer_stop",
    },
}
"""Calls that a component's template prints as the plan has them."""


def called(component: Component) -> set[str]:
    """Return the port_* functions that the files of a component call."""
    files = (path for path in component.folder.rglob("*.*") if path.suffix in (".c", ".h", ".j2"))
    text = "".join(_COMMENT.sub("", path.read_text()) for path in files if path.name != "port.h")
    return set(re.findall(r"\b((?:port|microros_seal)_[a-z_]+)\(", text)) | _OF_THE_PLAN.get(
        component.name, set()
    )


@pytest.mark.parametrize("name", [n for n, c in CATALOGUE.items() if c.layer != "port"])
def test_a_component_asks_for_what_it_calls_and_for_nothing_else(name: str) -> None:
    component = CATALOGUE[name]
    required = {ask.capability for ask in component.asks}
    calls = called(component)
    used = {c.name for c in capabilities().values() if set(c.functions) & calls}
    others = {capability for owner, capability in _OF_OTHERS if owner == name}
    assert used - others == required
    for capability in others:
        other = CATALOGUE[_OF_OTHERS[name, capability]]
        assert capability in {ask.capability for ask in other.asks}, other.name


def test_every_function_of_a_capability_has_one_prototype() -> None:
    for capability in capabilities().values():
        paths = [p for folder in TEMPLATE_FOLDERS for p in folder.rglob(f"include/{capability.header}")]
        assert len(paths) == 1, capability
        declared = prototypes(paths[0].read_text(), capability.functions)
        assert len(declared) == len(capability.functions)
    assert prototypes("bool port_a(\n  int x,\n  int y);\n", ("port_a",)) == ("bool port_a(int x, int y);",)


def test_what_parts_provide_and_ask_for_is_known() -> None:
    for component in CATALOGUE.values():
        asks = [*component.asks, *(ask for provided in component.provides for ask in provided.asks)]
        required = {ask.capability for ask in asks}
        assert required | {provided.capability for provided in component.provides} <= set(capabilities()), (
            component.name
        )
