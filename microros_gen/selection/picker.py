# SPDX-License-Identifier: Apache-2.0
"""Components on their way into a selection, each with the reasons that bring it."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.named import Named
from microros_gen.records import dataclass
from microros_gen.selection.clock import CLOCK_ROS
from microros_gen.selection.component import Catalogue
from microros_gen.selection.xrce import MICRO_ROS_COMPONENTS


@dataclass(frozen=True)
class Reason:
    """One reason of a component: a choice of the user, or (`needed_by`) another component."""

    text: str
    span: Span | None = None
    needed_by: str | None = None


class Picker:
    """Components on their way in, with reasons. An unknown component is reported once per place."""

    def __init__(self, catalogue: Catalogue, diagnostics: Diagnostics) -> None:
        self.catalogue = catalogue
        self.diagnostics = diagnostics
        self.causes: dict[str, list[Reason]] = {}

    def pick(self, name: str, text: str, span: Span | None, needed_by: str | None = None) -> None:
        """Select `name` because of `text`."""
        if name not in self.catalogue:
            self.unknown(name, text, span)
            return
        reason = Reason(text, span, needed_by)
        reasons = self.causes.setdefault(name, [])
        if reason not in reasons:
            reasons.append(reason)

    def unknown(self, name: str, text: str, span: Span | None) -> None:
        """Report an unknown component."""
        hint = nearest(name, self.catalogue) or f"Available: {', '.join(MICRO_ROS_COMPONENTS)}"
        self.diagnostics.error(f"unknown component '{name}' ({text})", span, hint, id="MG-4030")

    def close(self) -> None:
        """Add everything that the selected components need."""
        waiting = sorted(self.causes)
        while waiting:
            name = waiting.pop(0)
            for need in self.catalogue[name].needs:
                if need not in self.causes:
                    waiting.append(need)
                self.pick(need, f"needed by {name}", None, name)

    def open_to(self, application: Application) -> frozenset[str]:
        """Return what is selected; where no nodes are declared, without what the ROS clock alone needs for itself."""
        own = [] if application.nodes else [Reason(f"needed by {CLOCK_ROS}", None, CLOCK_ROS)]
        return frozenset(name for name, reasons in self.causes.items() if reasons != own)

    def roots(self, name: str) -> tuple[Named, ...]:
        """Return the choices of the user that lead to `name`, sorted."""
        seen: set[str] = set()
        found: dict[str, Named] = {}
        waiting = [name]
        while waiting:
            current = waiting.pop()
            if current in seen:
                continue
            seen.add(current)
            for reason in self.causes.get(current, ()):
                if reason.needed_by is not None:
                    waiting.append(reason.needed_by)
                else:
                    found.setdefault(reason.text, Named(reason.text, reason.span))
        return tuple(found[text] for text in sorted(found))
