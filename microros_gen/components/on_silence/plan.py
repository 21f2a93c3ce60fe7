# SPDX-License-Identifier: Apache-2.0
"""Which subscriptions must not be silent, for how long, and what is called otherwise."""

from __future__ import annotations

from microros_gen.client.plan.declared import declarations, full_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass


@dataclass(frozen=True)
class SilenceRow:
    """A subscription by its position among those, its topic, and the C function that is called after `after_ms`."""

    receiver: int
    topic: str
    after_ms: int
    call: str

    @property
    def entry(self) -> str:
        """Return its row as C."""
        return f"{{{self.call}, {self.after_ms}u, {self.receiver}u}}, /* {self.topic} */"


@dataclass(frozen=True)
class SilencePlan:
    """The subscriptions in the order of the file."""

    rows: tuple[SilenceRow, ...]

    @property
    def count(self) -> int:
        """Return the number of subscriptions."""
        return len(self.rows)

    @property
    def shown(self) -> str:
        """Return what a report says."""
        return ", ".join(f"{row.topic}: {row.call}() after {row.after_ms} ms" for row in self.rows)

    @property
    def functions(self) -> tuple[str, ...]:
        """Return the declarations of the functions, each once."""
        return tuple(f"void {name}(void);" for name in self._names)

    @property
    def example_functions(self) -> tuple[str, ...]:
        """Return functions for the example as lines of C."""
        found: list[str] = []
        for name in self._names:
            topics = ", ".join(row.topic for row in self.rows if row.call == name)
            found += [f"/* No sample of {topics} for too long: bring the device into a safe state here. */"]
            found += [f"void {name}(void)", "{", f'  (void)puts("{name}");', "}", ""]
        return tuple(found)

    @property
    def _names(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(row.call for row in self.rows))


def plan(context: PlanContext, diagnostics: Diagnostics) -> SilencePlan:
    """Return the table; the component without a subscription that needs it is an error."""
    rows = tuple(
        SilenceRow(place, full_name(node, endpoint), endpoint.silence.after_ms, endpoint.silence.call)
        for place, (_, node, endpoint) in enumerate(declarations(context.application, "subscription"))
        if endpoint.silence is not None
    )
    if not rows:
        diagnostics.error(
            "the component 'on_silence' is for subscriptions with `on_silence`, and none has one",
            context.application.spans.get("components"),
            "Add to a subscription: `on_silence: {after: 500 ms, call: stop_motors}`",
            id="MG-7210",
        )
    return SilencePlan(rows)


def record(part: SilencePlan) -> object:
    """Return what the plan id is made of."""
    return [[row.receiver, row.after_ms, row.call] for row in part.rows]
