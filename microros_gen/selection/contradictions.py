# SPDX-License-Identifier: Apache-2.0
"""What contradicts a selection: drops, declarations and axes, each reported with both places."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.application.model import Application
from microros_gen.diagnostics import Span
from microros_gen.documents.named import Named
from microros_gen.selection.axes import AxisChoice
from microros_gen.selection.clock import CLOCK_ROS
from microros_gen.selection.component import NOT_READY, Middleware, ResolvedProfile
from microros_gen.selection.declared import STREAM_RELIABLE, at, declared_components
from microros_gen.selection.picker import Picker


def check_contradictions(
    picker: Picker,
    application: Application,
    profiles: tuple[ResolvedProfile, ...],
    axes: Mapping[str, AxisChoice],
    middleware: Middleware,
) -> None:
    """Report what is dropped but needed, declared without its component, and axes that exclude each other."""
    drops = [(d.name, d.span, f"'-{d.name}'") for d in application.components if not d.add]
    added = {c.name for c in application.components if c.add}
    for profile in profiles:
        text = f"'-{{}}' of the profile {profile.name}"
        drops += [(d.name, d.span, text.format(d.name)) for d in profile.drops if d.name not in added]
    for name, span, text in drops:
        _check_drop(picker, name, span, text)
    _check_declarations(picker, application)
    _check_axis_components(picker, axes, middleware)
    _check_liveliness(picker, axes["liveliness"])
    _check_discovery(picker, axes["transport"])
    _check_sleep(picker, axes["transport"])
    _check_creation(picker, application, axes["entities"])
    _check_pools(picker, application)


def _check_drop(picker: Picker, name: str, span: Span | None, text: str) -> None:
    reasons = picker.causes.get(name, [])
    needing = sorted(r.needed_by for r in reasons if r.needed_by is not None)
    direct = [
        r for r in reasons if r.needed_by is None and not r.text.startswith(("profile ", "components: "))
    ]
    if needing:
        roots = [r for r in picker.roots(name) if f"-{name}" not in r.name]
        because = "; ".join(placed(root) for root in roots)
        message = f"{text} drops a component that {', '.join(needing)} needs (selected by {because})"
        picker.diagnostics.error(message, span, f"Drop {needing[0]} too, or remove {text}", id="MG-4033")
    elif direct:
        message = f"{text} drops a component that is selected by {direct[0].text}"
        key = direct[0].text.partition(":")[0]
        change = "that" if " " in key else f"`{key}:`"
        picker.diagnostics.error(message, span, f"Change {change}, or remove {text}", id="MG-4034")


def _check_declarations(picker: Picker, application: Application) -> None:
    for demand in declared_components(application):
        if demand.component in picker.causes:
            continue
        component = picker.catalogue.get(demand.component)
        if component is not None and not component.ready:
            message = f"{demand.text} needs the component '{demand.component}', which {NOT_READY}"
            picker.diagnostics.error(message, demand.span, "Remove it", id="MG-4035")
            continue
        picker.diagnostics.error(
            f"{demand.text} needs the component '{demand.component}', which nothing selects",
            demand.span,
            f"Add `components: [+{demand.component}]`, or a profile that has it",
            id="MG-4036",
        )


def _check_axis_components(picker: Picker, axes: Mapping[str, AxisChoice], middleware: Middleware) -> None:
    for axis, choice in axes.items():
        about = middleware.axes[axis]
        if about.several:
            continue
        chosen = about.values[choice.value].component
        for other in about.values.values():
            if other.component is None or other.component in (chosen, CLOCK_ROS):
                continue
            if other.component in picker.causes:
                root = picker.roots(other.component)[0]
                picker.diagnostics.error(
                    f"the component '{other.component}' ({root.name}) belongs to {axis}: {other.value} "
                    f"and contradicts {choice.text}",
                    root.span or choice.span,
                    f"Write `{axis}: {other.value}` instead of it",
                    id="MG-4037",
                )


def placed(cause: Named) -> str:
    """Return a cause with its place, where its text has none."""
    return cause.name if cause.name.endswith(")") else f"{cause.name}{at(cause.span)}"


def _check_pools(picker: Picker, application: Application) -> None:
    for key, count in application.pools.items():
        owners = [name for name, component in sorted(picker.catalogue.items()) if key in component.pools]
        if count == 0 or not owners or any(name in picker.causes for name in owners):
            continue
        picker.diagnostics.warning(
            f"'pools.{key}' has no effect: nothing selects the component {' or '.join(map(repr, owners))}",
            application.spans.get(f"pools.{key}"),
            f"Remove it, or add `components: [+{owners[0]}]`",
            id="MG-4051",
        )


def _check_liveliness(picker: Picker, choice: AxisChoice) -> None:
    by_itself = "liveliness_acknack"
    streams = [r for r in picker.causes.get(STREAM_RELIABLE, ()) if r.needed_by != by_itself]
    if choice.value == "acknack" and not streams:
        picker.diagnostics.error(
            f"{choice.text} needs a reliable stream, and no selected component has one",
            choice.span,
            "Make a publisher reliable, or write `liveliness: ping`",
            id="MG-4038",
        )


def _check_creation(picker: Picker, application: Application, choice: AxisChoice) -> None:
    creation = application.creation
    if creation is not None and creation.name == "reliable" and choice.value == "preconfigured":
        picker.diagnostics.error(
            f"creation: reliable{at(creation.span)} contradicts {choice.text}: the client creates nothing",
            creation.span,
            "Remove `creation:`, or write `entities: reference`",
            id="MG-4039",
        )


def _check_discovery(picker: Picker, choice: AxisChoice) -> None:
    if "discovery" in picker.causes and choice.value in ("serial", "canfd", "custom"):
        root = picker.roots("discovery")[0]
        picker.diagnostics.error(
            f"{choice.text} contradicts the component 'discovery' ({placed(root)}): agents are searched for "
            f"by UDP multicast",
            choice.span or root.span,
            "Write `transport: {type: udp}`, or drop it: `components: [-discovery]`",
            id="MG-4040",
        )


def _check_sleep(picker: Picker, choice: AxisChoice) -> None:
    if "sleep_cycles" not in picker.causes:
        return
    root = picker.roots("sleep_cycles")[0]
    if choice.value == "tcp":
        picker.diagnostics.error(
            f"{choice.text} contradicts the component 'sleep_cycles' ({placed(root)}): the session ends with its"
            " connection",
            choice.span or root.span,
            "Write `transport: {type: udp}`, or drop it: `components: [-sleep_cycles]`",
            id="MG-4041",
        )
    if "discovery" in picker.causes:
        found = picker.roots("discovery")[0]
        picker.diagnostics.error(
            f"the component 'discovery' ({placed(found)}) contradicts 'sleep_cycles' ({placed(root)}): an agent is"
            " searched for at each start",
            found.span or root.span,
            'Give its address: `transport: {agent: "192.168.1.10:8888"}`',
            id="MG-4042",
        )
