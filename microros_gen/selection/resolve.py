# SPDX-License-Identifier: Apache-2.0
"""From profiles and application to components, XRCE profiles, submessages and objects, with reasons.

Pure: everything that is read comes in as data. The order of profiles, components and keys in the input does
not change the result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from microros_gen.application.model import Application
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.named import Named
from microros_gen.selection.axes import AxisChoice, choose_axes
from microros_gen.selection.component import (
    NOT_READY,
    AxisValue,
    Catalogue,
    Component,
    Middleware,
    ResolvedProfile,
)
from microros_gen.selection.contradictions import check_contradictions
from microros_gen.selection.creation import with_creation
from microros_gen.selection.declared import at, check_holder, selecting_demands, stream_demands
from microros_gen.selection.model import Chosen, ChosenAxis, ChosenComponent, Selection
from microros_gen.selection.picker import Picker
from microros_gen.selection.profile_nodes import with_default_node, with_profile_nodes
from microros_gen.selection.profiles import signed, unique_changes
from microros_gen.selection.xrce import MICRO_ROS_COMPONENTS, OBJECT_KINDS, SUBMESSAGES, XRCE_PROFILES

# Objects that a CREATE makes; the client itself comes with CREATE_CLIENT.
_CREATED = frozenset(OBJECT_KINDS) - {"agent", "client"}
_LAYERS = ("micro-ROS", "middleware", "port")


def resolve_selection(
    application: Application,
    profiles: tuple[ResolvedProfile, ...],
    catalogue: Catalogue,
    middleware: Middleware,
    diagnostics: Diagnostics,
    parts: tuple[str, ...] = (),
    transport: str | None = None,
) -> Selection:
    """Return everything that the application and its profiles select, each item with its reasons.

    `parts` are the components of the target's platform (`Target.parts`). `transport` is what the target has where
    nobody else chooses (`Target.transport`).
    Contradictions and unknown components go to `diagnostics`, each with both places; then the selection is only
    good for showing. Planned components are selected like others: `check_ready` names them.
    """
    axes = choose_axes(application, profiles, middleware, diagnostics, transport)
    application = with_profile_nodes(application, profiles)
    application = with_creation(application, axes["transport"].value, axes["entities"].value)
    picker = Picker(catalogue, diagnostics)
    _pick_from_profiles(picker, application, profiles)
    if not picker.causes:
        _report_nothing(application, diagnostics)
    for choice in axes.values():
        _pick_axis(picker, choice, middleware)
    check_holder(application, picker.causes.keys(), diagnostics)
    for demand in selecting_demands(application):
        picker.pick(demand.component, demand.text, demand.span)
    picker.close()
    chosen = [picker.catalogue[name] for name in picker.causes]
    declared = with_default_node(application, chosen)
    for demand in stream_demands(declared, picker.open_to(application), axes["entities"].value):
        picker.pick(demand.component, demand.text, demand.span)
    if axes["transport"].value == "custom" and application.transport.framing is not False:
        picker.pick(
            "framing", "transport: {type: custom} without `framing: false`", application.transport.span
        )
    for name, text, span in _of_keys(application):
        picker.pick(name, text, span)
    picker.close()
    _pick_parts(picker, application, parts)
    check_contradictions(picker, application, profiles, axes, middleware)
    return _selection(picker, profiles, axes, middleware)


def _of_keys(application: Application) -> Iterator[tuple[str, str, Span | None]]:
    """Yield each component that the value of a key selects, with the key and its place."""
    transport = application.transport
    if application.hard_liveliness_ms:
        place = application.spans.get("session.hard_liveliness")
        yield "liveliness_hard", f"session: {{hard_liveliness}}{at(place)}", place
    if transport.discover is not None:
        yield "discovery", "transport: {agent: discover}", transport.agent_span
    if transport.seal:
        yield "seal", "transport: {seal}", application.spans.get("transport.seal")
    if transport.agents or transport.devices:
        yield "agents", "transport: {agents}", transport.agent_span


def _report_nothing(application: Application, diagnostics: Diagnostics) -> None:
    if not application.spans and not application.components:
        hint = "Give --profile pure_sender, or begin with `microros-gen init DIR`; `microros-gen profiles` lists them"
        diagnostics.error(
            "no application file microros.yaml in this folder, and no profile", None, hint, id="MG-4027"
        )
        return
    hint = "Add `profiles: [pure_sender]`, or --profile pure_sender"
    diagnostics.error("nothing is selected", None, hint, id="MG-4028")


def check_ready(selection: Selection, diagnostics: Diagnostics) -> None:
    """Report what is selected and planned only: an error for each choice of the user that leads to it."""
    requested: dict[Named, list[str]] = {}
    for chosen in selection.components:
        if not chosen.component.ready:
            for cause in chosen.causes:
                requested.setdefault(cause, []).append(chosen.component.name)
    for cause, names in sorted(requested.items(), key=lambda item: item[0].name):
        several = len(names) > 1
        diagnostics.error(
            f"{cause.name} needs the component{'s' if several else ''} {', '.join(names)}, which {NOT_READY}",
            cause.span,
            "`microros-gen profiles` shows what is ready, `microros-gen resolve` why each is needed",
            id="MG-4029",
        )


def _pick_from_profiles(
    picker: Picker, application: Application, profiles: tuple[ResolvedProfile, ...]
) -> None:
    own = unique_changes(application.components, picker.diagnostics)
    for profile in profiles:
        for add in profile.adds:
            if add.name not in own or own[add.name].add:
                picker.pick(add.name, f"profile {profile.name}", profile.place(add.span))
    _check_profile_drops(picker, profiles, own)
    for change in own.values():
        if change.add:
            picker.pick(change.name, f"components: {signed(change)}{at(change.span)}", change.span)
        elif change.name not in picker.catalogue:
            picker.unknown(change.name, f"components: {signed(change)}", change.span)
        elif not any(change.name == add.name for p in profiles for add in p.adds):
            picker.diagnostics.warning(
                f"'{signed(change)}' drops nothing: no selected profile has '{change.name}'",
                change.span,
                id="MG-4031",
            )


def _check_profile_drops(
    picker: Picker, profiles: tuple[ResolvedProfile, ...], own: Mapping[str, object]
) -> None:
    for dropping in profiles:
        for drop in dropping.drops:
            if drop.name not in picker.catalogue:
                picker.unknown(drop.name, f"profile {dropping.name}", drop.span)
            for adding in profiles:
                add = next((a for a in adding.adds if a.name == drop.name), None)
                if add is not None and drop.name not in own:
                    picker.diagnostics.error(
                        f"the profile '{dropping.name}' drops '{drop.name}' and the profile "
                        f"'{adding.name}' has it{at(add.span)}",
                        drop.span,
                        f"Decide in the application: `components: [+{drop.name}]` or `[-{drop.name}]`",
                        id="MG-4032",
                    )


def _pick_axis(picker: Picker, choice: AxisChoice, middleware: Middleware) -> None:
    about = middleware.axes[choice.axis]
    if about.several and choice.value == about.default and choice.reason == "default":
        return
    for each in (choice, *choice.further):
        needed = about.values[each.value].component
        if needed is not None:
            picker.pick(needed, each.text, each.span)


def _pick_parts(picker: Picker, application: Application, parts: tuple[str, ...]) -> None:
    """Select the parts of the platform that have something of use: for the application, a component, another part."""
    target = application.target
    waiting = list(parts)
    while waiting:
        asks = {ask.capability for name in picker.causes for ask in picker.catalogue[name].asks}
        chosen = (picker.catalogue[name] for name in parts if name in picker.causes)
        asks |= {ask.capability for part in chosen for provision in part.provides for ask in provision.asks}
        useful = [name for name in waiting if _is_useful(picker.catalogue[name], asks)]
        if not useful:
            return
        for name in useful:
            picker.pick(name, f"target: {target.name}{at(target.span)}", target.span)
        picker.close()
        waiting = [name for name in waiting if name not in useful]


def _is_useful(part: Component, requested: set[str]) -> bool:
    return (
        bool(part.sources)
        or not part.provides
        or any(provision.always or provision.capability in requested for provision in part.provides)
    )


def _selection(
    picker: Picker,
    profiles: tuple[ResolvedProfile, ...],
    axes: Mapping[str, AxisChoice],
    middleware: Middleware,
) -> Selection:
    components = tuple(_chosen(picker, name) for name in sorted(picker.causes, key=_component_order(picker)))
    values = _axis_values(axes, middleware)
    creates = axes["entities"].value != "preconfigured"
    parts = [c.component for c in components]
    xrce = [(n, p.name) for p in parts for n in (*p.xrce, *middleware.components.get(p.name, ()))]
    xrce += [(n, choice.text) for choice, value in values for n in value.xrce]
    objects = [(o, p.name) for p in parts for o in p.objects if creates or o not in _CREATED]
    return Selection(
        profiles=tuple(p.name for p in profiles),
        components=components,
        entities=axes["entities"].value,
        transport=axes["transport"].value,
        liveliness=axes["liveliness"].value,
        xrce_profiles=_gather(xrce, XRCE_PROFILES),
        agent_profiles=_gather(
            [(n, choice.text) for choice, value in values for n in value.agent], XRCE_PROFILES
        ),
        sends=_gather(((s, p.name) for p in parts for s in p.sends), tuple(SUBMESSAGES)),
        receives=_gather(((s, p.name) for p in parts for s in p.receives), tuple(SUBMESSAGES)),
        objects=_gather(objects, tuple(OBJECT_KINDS)),
        axes=tuple(ChosenAxis(c.axis, c.value, c.reason) for c, _ in values if _matters(picker, c)),
    )


def _matters(picker: Picker, choice: AxisChoice) -> bool:
    """Return whether to show an axis: one about a component counts when that is selected or it was chosen."""
    about_component = choice.axis in MICRO_ROS_COMPONENTS
    return not about_component or choice.span is not None or choice.axis in picker.causes


def _axis_values(
    axes: Mapping[str, AxisChoice], middleware: Middleware
) -> list[tuple[AxisChoice, AxisValue]]:
    """Return each choice, further ones of an axis included, with what it brings."""
    choices = [choice for first in axes.values() for choice in (first, *first.further)]
    return [(choice, middleware.axes[choice.axis].values[choice.value]) for choice in choices]


def _component_order(picker: Picker) -> Callable[[str], tuple[int, int, str]]:
    def key(name: str) -> tuple[int, int, str]:
        layer = _LAYERS.index(picker.catalogue[name].layer)
        place = (
            MICRO_ROS_COMPONENTS.index(name) if name in MICRO_ROS_COMPONENTS else len(MICRO_ROS_COMPONENTS)
        )
        return layer, place, name

    return key


def _chosen(picker: Picker, name: str) -> ChosenComponent:
    reasons = sorted({(r.needed_by is not None, r.text) for r in picker.causes[name]})
    texts = tuple(text for _, text in reasons)
    return ChosenComponent(picker.catalogue[name], texts, picker.roots(name))


def _gather(pairs: Iterable[tuple[str, str]], order: tuple[str, ...]) -> tuple[Chosen, ...]:
    reasons: dict[str, list[str]] = {}
    for name, reason in pairs:
        known = reasons.setdefault(name, [])
        if reason not in known:
            known.append(reason)
    return tuple(Chosen(name, tuple(reasons[name])) for name in sorted(reasons, key=order.index))
