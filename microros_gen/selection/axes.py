# SPDX-License-Identifier: Apache-2.0
"""Who decides an axis: the application, else a profile, else the default of the middleware table."""

from __future__ import annotations

from microros_gen.application.model import Application, Transport
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.named import Named
from microros_gen.records import dataclass
from microros_gen.selection.component import Middleware, ResolvedProfile
from microros_gen.selection.profiles import at


@dataclass(frozen=True)
class AxisChoice:
    """The value of an axis. `reason` says who chose it, `text` is both: `entities: binary (default)`."""

    axis: str
    value: str
    reason: str
    span: Span | None = None

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
    said = _application_axes(application)
    choices: dict[str, AxisChoice] = {}
    for axis, values in middleware.axes.items():
        own = said.get(axis)
        if own is not None and own.name not in values:
            hint = nearest(own.name, values) or f"There are {', '.join(values)}"
            diagnostics.error(f"unknown {axis} '{own.name}'", own.span, hint, id="MG-4001")
            own = None
        default = AxisChoice(axis, middleware.defaults[axis], "default")
        if axis == "transport" and target_transport is not None:
            default = AxisChoice(axis, target_transport, f"target {application.target.name}")
        choices[axis] = _own(axis, own) or _of_profiles(axis, profiles, diagnostics) or default
    return choices


def _application_axes(application: Application) -> dict[str, Named]:
    transport = application.transport
    said = {
        "entities": application.entities,
        "liveliness": application.liveliness,
        "clock": application.clock,
        "logging": next((Named(w.to, w.span) for w in application.logging), None),
    }
    if transport.type_span is not None or transport.type != Transport().type:
        said["transport"] = Named(transport.type, transport.type_span or transport.span)
    return {axis: value for axis, value in said.items() if value is not None}


def _own(axis: str, own: Named | None) -> AxisChoice | None:
    if own is None:
        return None
    reason = at(own.span).strip(" ()") or "application"
    return AxisChoice(axis, own.name, reason, own.span)


def _of_profiles(
    axis: str, profiles: tuple[ResolvedProfile, ...], diagnostics: Diagnostics
) -> AxisChoice | None:
    said = [(profile, profile.axes[axis]) for profile in profiles if axis in profile.axes]
    if not said:
        return None
    first, chosen = said[0]
    for profile, value in said[1:]:
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
