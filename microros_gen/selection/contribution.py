# SPDX-License-Identifier: Apache-2.0
"""What a component adds to files that all components share, as its `component.yaml` declares it.

Each contribution may be there in a part of the plans only, by its conditions.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from microros_gen.records import dataclass

Conditions = tuple[tuple[str, str | int | bool], ...]
"""Attributes of the plan and their values: `(("streams.on_full", "error"),)`; empty: always.

`true` and `false` ask whether there is something: a number that is not 0, a list that is not empty.
`component.executor` is whether that component is selected.
"""


@dataclass(frozen=True)
class HookPoint:
    """A place in the generated C where components are called: the variables there, and its phases in their order.

    `value` is true where the call's result is used.
    """

    variables: tuple[str, ...]
    phases: tuple[str, ...] = ("",)
    value: bool = False


STEP_PHASES = (
    "transport",
    "broken",
    "liveliness",
    "connect",
    "create",
    "receive",
    "send",
    "answer",
    "watch",
    "wake",
)
CONNECTED_PHASES = ("forget", "streams", "endpoints", "liveliness")

HOOK_POINTS: Mapping[str, HookPoint] = MappingProxyType(
    {
        # xrce_session.c, for each call of the transport's receive
        "received": HookPoint(("client", "size")),
        "handled": HookPoint(("client",)),
        # xrce_routes.c
        "ignores": HookPoint(("client", "message", "size"), value=True),
        "takes": HookPoint(("client", "message", "size", "now"), value=True),
        "taken": HookPoint(("client", "now")),
        "step": HookPoint(("client", "now"), STEP_PHASES),
        "gate": HookPoint(("client", "now"), STEP_PHASES, value=True),
        "connected": HookPoint(("client", "now"), CONNECTED_PHASES),
        "leaving": HookPoint(("client",)),
        "leave": HookPoint(("client",)),
        "closed": HookPoint(("client",)),
        "settled": HookPoint(("client",), value=True),
        # the output streams, in xrce_routes.c
        "full": HookPoint(("client", "reliable"), value=True),
        "reserved": HookPoint(("client",), value=True),
        "committing": HookPoint(("client", "reliable")),
        # the WRITE_DATA submessage
        "dropped": HookPoint(("client", "dropped")),
        # for waiting functions: xrce_wait_left.h
        "due": HookPoint(("client", "left", "now"), value=True),
        "due_always": HookPoint(("client", "left", "now"), value=True),
        # rcl and rclc
        "support_opened": HookPoint(("support", "allocator"), value=True),
        "support_closed": HookPoint(("support",)),
        "node_opened": HookPoint(("node",), value=True),
        "node_closing": HookPoint(("node",)),
        "receiver_opened": HookPoint(("place",)),
        "receiver_closed": HookPoint(("endpoint",)),
        "pumped": HookPoint(()),
        "round_begins": HookPoint(("executor",)),
        "round_ends": HookPoint(("executor",)),
        "rests": HookPoint(()),
        "rested": HookPoint(()),
        "contingency": HookPoint(("node", "mode"), value=True),
        "clock_jump": HookPoint(("time", "clock", "jump", "before_jump")),
        # after a sleep: xrce_sleep.c
        "woken": HookPoint(("client", "now")),
    }
)
"""Where components hook in; docs/architecture.md says when each is called."""

STATE_SECTIONS = ("first", "streams", "input_streams", "parts", "tables", "queues", "services")
HANDLE_SECTIONS = ("handle", "handle_callbacks", "handle_data", "goal_handle", "wait_set")
TRANSPORT_SECTIONS = ("transport", "line")
"""Sections of members of the client, of a handle of the executor or of a goal, of a wait set, and of the transport."""
RETAINED_SECTIONS = ("retained",)
"""Section of objects outside of the client that have to outlast a sleep as it does."""
CONFIG_SECTIONS = ("errors", "transport", "session", "streams", "places", "memory")
OUTPUT_STREAMS = ("reliable", "best_effort")
OUTPUT_FUNCTIONS: Mapping[str, str] = MappingProxyType(
    {
        "reserve": "NULL",
        "commit": "false",
        "capacity": "0u",
        "drop_oldest": "NULL",
        "unacknowledged": "0",
        "passes": "true",
    }
)
"""The operations of an output stream, and their replacements if no stream of the kind is selected."""


@dataclass(frozen=True, kw_only=True)
class Conditional:
    """When a contribution is there."""

    when: Conditions = ()


@dataclass(frozen=True, kw_only=True)
class HookHeader(Conditional):
    """A header that declares functions of hooks and handlers."""

    header: str


@dataclass(frozen=True, kw_only=True)
class State(Conditional):
    """A member of the client (microros/xrce_client.h), as C declares it: `uint8_t creation[MICROROS_CREATION_SIZE]`.

    In the section `retained` it is a variable with this name, which `header` declares.

    `clocks` are its fields that hold a moment of port_time_ms; of an array those of each element.
    """

    declaration: str
    section: str
    header: str = ""
    comment: str = ""
    clocks: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Kept(Conditional):
    """A field of the client, `ping.answers`, that xrce_session_open leaves as it is."""

    field: str
    type: str

    @property
    def name(self) -> str:
        """Return the field's own name: `answers`."""
        return self.field.rpartition(".")[2]


@dataclass(frozen=True, kw_only=True)
class Hook(Conditional):
    """A call at a hook point, as C writes it: `xrce_ping_step(client, now)`; `test` is what `takes` asks first."""

    point: str
    phase: str
    call: str
    test: str = ""


@dataclass(frozen=True, kw_only=True)
class Handler(Conditional):
    """The function that takes one kind of submessage; (client, submessage, size, now)."""

    submessage: str
    function: str


@dataclass(frozen=True, kw_only=True)
class Output(Conditional):
    """An output stream: for each function of OUTPUT_FUNCTIONS the C expression that does it."""

    stream: str
    calls: tuple[tuple[str, str], ...]


@dataclass(frozen=True, kw_only=True)
class ErrorCode(Conditional):
    """An error of the library: the number behind "E" of `errors: code`; no text: a source of the component has it."""

    name: str
    code: int
    text: str = ""


@dataclass(frozen=True, kw_only=True)
class Include(Conditional):
    """A header that a header which gathers others, `into`, includes."""

    into: str
    header: str


@dataclass(frozen=True, kw_only=True)
class Setting(Conditional):
    """A line of microros_config.h: an attribute of the plan as a constant."""

    name: str
    section: str
    value: str
    comment: str = ""


@dataclass(frozen=True, kw_only=True)
class Counter(Conditional):
    """A uint32_t that a diagnosis reports below `group`: `value` is its expression in C, which may name `client`.

    `warns`: it counts faults, so a change is a warning. `header` declares what the expression calls. `each` is a
    tuple of the plan: the counter is there for each of its elements, whose `{name}` and `{index}` are in `group` and
    `value`.
    """

    group: str
    name: str
    value: str
    warns: bool = False
    header: str = ""
    each: str = ""


@dataclass(frozen=True, kw_only=True)
class Property(Conditional):
    """A property of the client in CREATE_CLIENT; `value` is an attribute of the plan, printed with `digits` digits."""

    name: str
    value: str
    digits: int


@dataclass(frozen=True, kw_only=True)
class Variant(Conditional):
    """A header for some plans, and the file of the folder variants/ that replaces it there."""

    header: str
    file: str


@dataclass(frozen=True, kw_only=True)
class Replacement(Conditional):
    """A header of this component that stands in for the one of the same name of a component that it needs."""

    header: str


@dataclass(frozen=True, kw_only=True)
class InitOption(Conditional):
    """A function of rmw_microros/init_options.h that sets an option of the session.

    `absent` and `unmet` end the name that a call gets where the component is not selected, or its conditions do not
    hold: they say what to change.
    """

    function: str
    arguments: str
    comment: str
    absent: str
    unmet: str = ""


@dataclass(frozen=True)
class Contributions:
    """All that a component contributes, in the order of its file."""

    hook_headers: tuple[HookHeader, ...] = ()
    state: tuple[State, ...] = ()
    kept: tuple[Kept, ...] = ()
    hooks: tuple[Hook, ...] = ()
    handlers: tuple[Handler, ...] = ()
    outputs: tuple[Output, ...] = ()
    errors: tuple[ErrorCode, ...] = ()
    config: tuple[Setting, ...] = ()
    counters: tuple[Counter, ...] = ()
    properties: tuple[Property, ...] = ()
    includes: tuple[Include, ...] = ()
    variants: tuple[Variant, ...] = ()
    replaces: tuple[Replacement, ...] = ()
    init_options: tuple[InitOption, ...] = ()


NOTHING = Contributions()
"""What a component contributes that says nothing about it."""
