# SPDX-License-Identifier: Apache-2.0
"""Who decides an axis: the application, else a profile, else the default of the middleware table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from microros_gen.application.model import Application
from microros_gen.application.transport_decl import Transport
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.named import Named
from microros_gen.records import dataclass
from microros_gen.selection.component import Middleware, ResolvedProfile
from microros_gen.selection.declared import at


@dataclass(frozen=True)
class AxisChoice:
    """The value of an axis. `reason` says who chose it, `text` is both: `entities: binary (default)`.

    `further`: the other values of an axis that can have several.
    """

    axis: str
    value: str
    reason: str
    span: Span | None = None
    further: tuple[AxisChoice, ...] = ()

    @property
    def text(self) -> str:
        """The choice and who made it, to be printed."""
        return f"{self.axis}: {self.value} ({self.reason})"


def choose_axes(
    application: Application,
    profiles: tuple[ResolvedProfile, ...],
    middleware: Middleware,
    diagnostics: Diagnostics,
    target_transport: str | None = None,
) -> dict[str, AxisChoice]:
    """Return the choice for each axis, in the order of the middleware table.

    `target_transport` is what the target has where neither application nor profile choose (`Target.transport`).
    Profiles that disagree are an error that names both places, unless the application decides.
    """
    choices: dict[str, AxisChoice] = {}
    for axis, about in middleware.axes.items():
        own = tuple(
            _choice(axis, value)
            for value in _of_application(getattr(application, axis))
            if _known(axis, value, about.values, diagnostics)
        )
        default = AxisChoice(axis, about.default, "default")
        if axis == "transport" and target_transport is not None:
            default = AxisChoice(axis, target_transport, f"target {application.target.name}")
        first = own[0] if own else _of_profiles(axis, profiles, diagnostics) or default
        choices[axis] = replace(first, further=own[1:])
    return choices


def _of_application(value: object) -> Iterator[Named]:
    """Yield what a key of the application file chooses: a name, writers of log messages, or a transport."""
    if isinstance(value, Named):
        yield value
    elif isinstance(value, tuple):
        yield from (Named(writer.to, writer.span) for writer in value)
    elif isinstance(value, Transport) and (value.type_span is not None or value.type != Transport().type):
        yield Named(value.type, value.type_span or value.span)


def _known(axis: str, value: Named, values: Iterable[str], diagnostics: Diagnostics) -> bool:
    if value.name in values:
        return True
    hint = nearest(value.name, values) or f"Available: {', '.join(values)}"
    diagnostics.error(f"unknown {axis} '{value.name}'", value.span, hint, id="MG-4001")
    return False


def _choice(axis: str, value: Named) -> AxisChoice:
    reason = at(value.span).strip(" ()") or "application"
    return AxisChoice(axis, value.name, reason, value.span)


def _of_profiles(
    axis: str, profiles: tuple[ResolvedProfile, ...], diagnostics: Diagnostics
) -> AxisChoice | None:
    chosen_values = [(profile, profile.axes[axis]) for profile in profiles if axis in profile.axes]
    if not chosen_values:
        return None
    first, chosen = chosen_values[0]
    for profile, value in chosen_values[1:]:
        if value.name != chosen.name:
            diagnostics.error(
                f"the profile '{profile.name}' has {axis}: {value.name}, and the profile '{first.name}' has "
                f"{axis}: {chosen.name}{at(chosen.span)}",
                profile.place(value.span),
                f"Decide in the application with `{_key(axis, value.name)}`",
                id="MG-4002",
            )
    return AxisChoice(axis, chosen.name, f"profile {first.name}", first.place(chosen.span))


def _key(axis: str, value: str) -> str:
    return f"transport: {{type: {value}}}" if axis == "transport" else f"{axis}: {value}"
