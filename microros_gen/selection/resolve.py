# SPDX-License-Identifier: Apache-2.0
"""From profiles and application to components, XRCE profiles, submessages and objects, with reasons.

Pure: everything that is read comes in as data. The order of profiles, components and keys in the input does
not change the result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from microros_gen.application.model import Application
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.named import Named
from microros_gen.records import dataclass
from microros_gen.selection.axes import AxisChoice, choose_axes
from microros_gen.selection.clock import CLOCK_ROS
from microros_gen.selection.component import (
    NOT_READY,
    AxisValue,
    Catalogue,
    Component,
    Middleware,
    ResolvedProfile,
)
from microros_gen.selection.declared import STREAM_RELIABLE, declared_components, stream_demands
from microros_gen.selection.model import Chosen, ChosenAxis, ChosenComponent, Selection
from microros_gen.selection.profiles import at, signed, unique_changes
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
    picker = _Picker(catalogue, diagnostics)
    _pick_from_profiles(picker, application, profiles)
    if not picker.causes:
        _report_nothing(application, diagnostics)
    for choice in axes.values():
        _pick_axis(picker, choice, middleware)
    picker.close()
    for demand in stream_demands(application, picker.open_to(application), axes["entities"].value):
        picker.pick(demand.component, demand.text, demand.span)
    if axes["transport"].value == "custom" and application.transport.framing is not False:
        picker.pick(
            "framing", "transport: {type: custom} without `framing: false`", application.transport.span
        )
    if application.hard_liveliness_ms:
        place = application.spans.get("session.hard_liveliness")
        picker.pick("liveliness_hard", f"session: {{hard_liveliness}}{at(place)}", place)
    if application.transport.discover is not None:
        picker.pick("discovery", "transport: {agent: discover}", application.transport.agent_span)
    picker.close()
    _pick_parts(picker, application, parts)
    _check(picker, application, profiles, axes, middleware)
    return _selection(picker, profiles, axes, middleware)


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
    asked: dict[Named, list[str]] = {}
    for chosen in selection.components:
        if not chosen.component.ready:
            for cause in chosen.causes:
                asked.setdefault(cause, []).append(chosen.component.name)
    for cause, names in sorted(asked.items(), key=lambda item: item[0].name):
        several = len(names) > 1
        diagnostics.error(
            f"{cause.name} needs the component{'s' if several else ''} {', '.join(names)}, which {NOT_READY}",
            cause.span,
            "`microros-gen profiles` shows what is ready, `microros-gen resolve` why each is needed",
            id="MG-4029",
        )


@dataclass(frozen=True)
class _Reason:
    """One reason of a component: a choice of the user, or (`needed_by`) another component."""

    text: str
    span: Span | None = None
    needed_by: str | None = None


class _Picker:
    """Components on their way in, with reasons. An unknown component is reported once per place."""

    def __init__(self, catalogue: Catalogue, diagnostics: Diagnostics) -> None:
        self.catalogue = catalogue
        self.diagnostics = diagnostics
        self.causes: dict[str, list[_Reason]] = {}

    def pick(self, name: str, text: str, span: Span | None, needed_by: str | None = None) -> None:
        """Select `name` because of `text`."""
        if name not in self.catalogue:
            self.unknown(name, text, span)
            return
        reason = _Reason(text, span, needed_by)
        reasons = self.causes.setdefault(name, [])
        if reason not in reasons:
            reasons.append(reason)

    def unknown(self, name: str, text: str, span: Span | None) -> None:
        """Report an unknown component."""
        hint = nearest(name, self.catalogue) or f"There are {', '.join(MICRO_ROS_COMPONENTS)}"
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
        own = [] if application.nodes else [_Reason(f"needed by {CLOCK_ROS}", None, CLOCK_ROS)]
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


def _pick_from_profiles(
    picker: _Picker, application: Application, profiles: tuple[ResolvedProfile, ...]
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
    picker: _Picker, profiles: tuple[ResolvedProfile, ...], own: Mapping[str, object]
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


def _pick_axis(picker: _Picker, choice: AxisChoice, middleware: Middleware) -> None:
    brought = middleware.axes[choice.axis][choice.value].component
    if brought is not None:
        picker.pick(brought, choice.text, choice.span)


def _pick_parts(picker: _Picker, application: Application, parts: tuple[str, ...]) -> None:
    """Select the parts of the platform that have something of use: for the application, a component, another part."""
    target = application.target
    waiting = list(parts)
    while waiting:
        asks = {ask.capability for name in picker.causes for ask in picker.catalogue[name].asks}
        chosen = (picker.catalogue[name] for name in parts if name in picker.causes)
        asks |= {ask.capability for part in chosen for one in part.provides for ask in one.asks}
        useful = [name for name in waiting if _is_useful(picker.catalogue[name], asks)]
        if not useful:
            return
        for name in useful:
            picker.pick(name, f"target: {target.name}{at(target.span)}", target.span)
        picker.close()
        waiting = [name for name in waiting if name not in useful]


def _is_useful(part: Component, asked: set[str]) -> bool:
    return (
        bool(part.sources)
        or not part.provides
        or any(one.always or one.capability in asked for one in part.provides)
    )


def _check(
    picker: _Picker,
    application: Application,
    profiles: tuple[ResolvedProfile, ...],
    axes: Mapping[str, AxisChoice],
    middleware: Middleware,
) -> None:
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


def _check_drop(picker: _Picker, name: str, span: Span | None, text: str) -> None:
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


def _check_declarations(picker: _Picker, application: Application) -> None:
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


def _check_axis_components(picker: _Picker, axes: Mapping[str, AxisChoice], middleware: Middleware) -> None:
    for axis, choice in axes.items():
        chosen = middleware.axes[axis][choice.value].component
        for other in middleware.axes[axis].values():
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


def _check_liveliness(picker: _Picker, choice: AxisChoice) -> None:
    by_itself = "liveliness_acknack"
    streams = [r for r in picker.causes.get(STREAM_RELIABLE, ()) if r.needed_by != by_itself]
    if choice.value == "acknack" and not streams:
        picker.diagnostics.error(
            f"{choice.text} needs a reliable stream, and nothing that is selected has one",
            choice.span,
            "Make a publisher reliable, or write `liveliness: ping`",
            id="MG-4038",
        )


def _check_creation(picker: _Picker, application: Application, choice: AxisChoice) -> None:
    creation = application.creation
    if creation is not None and creation.name == "reliable" and choice.value == "preconfigured":
        picker.diagnostics.error(
            f"creation: reliable{at(creation.span)} contradicts {choice.text}: the client creates nothing",
            creation.span,
            "Remove `creation:`, or write `entities: reference`",
            id="MG-4039",
        )


def _check_discovery(picker: _Picker, choice: AxisChoice) -> None:
    if "discovery" in picker.causes and choice.value in ("serial", "custom"):
        root = picker.roots("discovery")[0]
        picker.diagnostics.error(
            f"{choice.text} contradicts the component 'discovery' ({placed(root)}): agents are searched for "
            f"by UDP multicast",
            choice.span or root.span,
            "Write `transport: {type: udp}`, or drop it: `components: [-discovery]`",
            id="MG-4040",
        )


def _check_sleep(picker: _Picker, choice: AxisChoice) -> None:
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
            " searched for with each start",
            found.span or root.span,
            'Say where the agent is: `transport: {agent: "192.168.1.10:8888"}`',
            id="MG-4042",
        )


def _selection(
    picker: _Picker,
    profiles: tuple[ResolvedProfile, ...],
    axes: Mapping[str, AxisChoice],
    middleware: Middleware,
) -> Selection:
    components = tuple(_chosen(picker, name) for name in sorted(picker.causes, key=_component_order(picker)))
    values = [middleware.axes[choice.axis][choice.value] for choice in axes.values()]
    creates = axes["entities"].value != "preconfigured"
    parts = [c.component for c in components]
    xrce = [(n, p.name) for p in parts for n in (*p.xrce, *middleware.components.get(p.name, ()))]
    xrce += [(n, axes[v.axis].text) for v in values for n in v.xrce]
    objects = [(o, p.name) for p in parts for o in p.objects if creates or o not in _CREATED]
    return Selection(
        profiles=tuple(p.name for p in profiles),
        components=components,
        entities=axes["entities"].value,
        transport=axes["transport"].value,
        liveliness=axes["liveliness"].value,
        xrce_profiles=_gather(xrce, XRCE_PROFILES),
        agent_profiles=_gather(_agent_side(values, axes), XRCE_PROFILES),
        sends=_gather(((s, p.name) for p in parts for s in p.sends), tuple(SUBMESSAGES)),
        receives=_gather(((s, p.name) for p in parts for s in p.receives), tuple(SUBMESSAGES)),
        objects=_gather(objects, tuple(OBJECT_KINDS)),
        axes=tuple(ChosenAxis(c.axis, c.value, c.reason) for c in axes.values() if _matters(picker, c)),
    )


def _matters(picker: _Picker, choice: AxisChoice) -> bool:
    """Return whether to show an axis: one about a component counts when that is selected or it was chosen."""
    about_component = choice.axis in MICRO_ROS_COMPONENTS
    return not about_component or choice.span is not None or choice.axis in picker.causes


def _agent_side(values: Iterable[AxisValue], axes: Mapping[str, AxisChoice]) -> list[tuple[str, str]]:
    return [(name, axes[value.axis].text) for value in values for name in value.agent]


def _component_order(picker: _Picker) -> Callable[[str], tuple[int, int, str]]:
    def key(name: str) -> tuple[int, int, str]:
        layer = _LAYERS.index(picker.catalogue[name].layer)
        place = (
            MICRO_ROS_COMPONENTS.index(name) if name in MICRO_ROS_COMPONENTS else len(MICRO_ROS_COMPONENTS)
        )
        return layer, place, name

    return key


def _chosen(picker: _Picker, name: str) -> ChosenComponent:
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
