# SPDX-License-Identifier: Apache-2.0
"""The sources of an rclc application → a proposed application file."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Set
from dataclasses import replace

from microros_gen.application import diagnosis_decl
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.migrate.c_program import Call, CFile, read_program
from microros_gen.migrate.c_tokens import Include, read_c
from microros_gen.migrate.c_values import Values, handle_of
from microros_gen.migrate.capacities import Fact, find_capacities
from microros_gen.migrate.diagnosis_checks import find_diagnosis
from microros_gen.migrate.draft import Draft, DraftNode, DraftValue, Remark, place
from microros_gen.migrate.missing import find_missing, selected_by
from microros_gen.migrate.parameter_clients import find_clients, owner, watches
from microros_gen.migrate.parameter_servers import SERVERS, server_limits, server_pools
from microros_gen.migrate.profiles import profiles_of
from microros_gen.migrate.rclc_actions import actions_of, find_actions
from microros_gen.migrate.rclc_calls import (
    ENDPOINT_CALLS,
    NODE_CALLS,
    TIMER_CALLS,
    FoundEndpoint,
    FoundNode,
    find_endpoints,
    find_nodes,
    find_timers,
)
from microros_gen.migrate.rclc_settings import find_settings, transport_calls
from microros_gen.records import dataclass
from microros_gen.selection.component import Catalogue

_STARTS = ("main", "appMain", "app_main", "setup")
_PREFIXES = ("RCUTILS_LOG_", "rcl_", "rclc_", "rmw_", "rcutils_", "rosidl_runtime_c__", "micro_ros_", "uxr_")
# rcl_interfaces__msg__Log__init, micro_ros_msgs__msg__Graph__fini: generated with their types
_OF_TYPE = re.compile(r"__(?:msg|srv|action)__")
# What starts a second task: POSIX, FreeRTOS, Zephyr, CMSIS-RTOS, NuttX
_TASKS = frozenset(
    (
        "pthread_create",
        "xTaskCreate",
        "xTaskCreateStatic",
        "xTaskCreatePinnedToCore",
        "k_thread_create",
        "osThreadNew",
        "task_create",
    )
)
_THREADS = frozenset(("std", "thread"))
_AXES = ("transport_", "entities_", "port_", "liveliness_", "clock_ros", "ping", "stream_")
_MOST_PLACES = 3
_HELD = ("rclc_parameter_check_held", "rclc_parameter_count_overruled")


@dataclass(frozen=True)
class Adopted:
    """The proposal, the capacities that the sources give to members of messages, and what the sources include.

    `implied`: types of the endpoints that the components open by themselves.
    """

    draft: Draft
    capacities: tuple[Fact, ...]
    includes: tuple[Include, ...] = ()
    implied: tuple[str, ...] = ()


def rclc_draft(
    sources: Iterable[Source],
    declared: Mapping[str, str],
    catalogue: Catalogue,
    diagnostics: Diagnostics,
    provided: Collection[str] = (),
) -> Adopted:
    """Return what the sources of one application propose.

    `declared` says which component declares a function; `provided` are functions of the platform. Errors
    where the sources are several applications, or none; the latter only if all sources could be read.
    """
    all_read = not diagnostics.has_errors()
    files = read_program(read_c(source) for source in sources)
    _check_one(files, diagnostics)
    values = Values(files)
    calls = [call for file in files for call in file.calls]
    nodes, remarks = _nodes(files, calls, values)
    profiles = profiles_of({endpoint.kind for node in nodes for endpoint in node.endpoints})
    own = {function.name for file in files for function in file.functions}
    selected = _selected(calls, declared, catalogue)
    called = [
        call
        for call in calls
        if call.name not in own and (call.name in selected or _is_of_library(call.name))
    ]
    remarks += find_missing(called, selected, catalogue)
    remarks += _macros(files)
    settings, more = find_settings(calls, values, transport_calls(catalogue), provided)
    pools = {**settings.get("pools", {}), **_executors(calls), **server_pools(calls, values)}
    limits, guesses = server_limits(calls, values)
    diagnosis, unlimited = find_diagnosis(calls)
    groups = {**settings, **{k: v for k, v in (("pools", pools), (diagnosis_decl.KEY, diagnosis)) if v}}
    draft = Draft(
        profiles=profiles.names,
        components=_components(
            _wanted(files, called, selected, catalogue) | ({"subscribe"} if watches(calls) else set()),
            catalogue,
            profiles.components,
        ),
        interfaces=_types_without_entity(nodes),
        nodes=nodes,
        groups=groups,
        limits=limits,
        remarks=(*remarks, *more, *guesses, *unlimited),
    )
    if all_read and not nodes and not called:
        diagnostics.error(
            "these sources call no function of rclc or rcl",
            hint="Give the folder of one application: it calls rclc_support_init",
            id="MG-9011",
        )
    includes = tuple(include for file in files for include in file.text.includes)
    implied = _implied(draft.components, catalogue)
    return Adopted(draft, tuple(find_capacities(files, calls, values)), includes, implied)


def _implied(components: Iterable[str], catalogue: Catalogue) -> tuple[str, ...]:
    named = {name.removeprefix("+") for name in components}
    all_of_them = named.union(*(_below(name, catalogue) for name in named))
    return tuple(sorted({end.type for name in all_of_them for end in catalogue[name].implies}))


def _is_of_library(function: str) -> bool:
    return function.startswith(_PREFIXES) and _OF_TYPE.search(function) is None


def _selected(
    calls: Iterable[Call], declared: Mapping[str, str], catalogue: Catalogue
) -> dict[str, tuple[str, ...]]:
    """Return the components that each function selects, by any of its calls."""
    selected: dict[str, tuple[str, ...]] = {}
    for call in calls:
        names = selected_by(call.name, declared, catalogue, call.texts)
        if names:
            selected[call.name] = tuple(sorted({*selected.get(call.name, ()), *names}))
    return selected


def _types_without_entity(nodes: Iterable[DraftNode]) -> tuple[str, ...]:
    """Return the types of endpoints whose name, or whose node's name, is unknown: the sources use them, too."""
    owned = [(node.name and e.name, e.type) for node in nodes for e in node.endpoints]
    owned += [(node.name and action.name, action.type) for node in nodes for action in node.actions]
    named = {kind for name, kind in owned if name}
    return tuple(sorted({kind for _, kind in owned if kind} - named))


def _check_one(files: Iterable[CFile], diagnostics: Diagnostics) -> None:
    starts = [f for file in files for f in file.functions if f.name in _STARTS and f.is_free]
    alike = [start for start in starts if start.name == starts[0].name]
    if len(alike) > 1:
        places = [place(start.span) for start in (alike[0], *alike[2:])]
        more = f" and {len(places) - _MOST_PLACES} more" if len(places) > _MOST_PLACES else ""
        diagnostics.error(
            f"several applications in these sources: {alike[0].name}() is also in "
            f"{', '.join(places[:_MOST_PLACES])}{more}",
            alike[1].span,
            "Give the folder or file of one of them",
            id="MG-9012",
        )


def _nodes(
    files: tuple[CFile, ...], calls: list[Call], values: Values
) -> tuple[tuple[DraftNode, ...], list[Remark]]:
    """Return the nodes with what they own."""
    found = _unique(find_nodes(calls, values))
    endpoints = find_endpoints(calls, values)
    timers = tuple(timer.draft for timer in find_timers(calls, values))
    remarks: list[Remark] = []
    owned: dict[int, list[FoundEndpoint]] = {index: [] for index in range(len(found))}
    for endpoint in endpoints if found else ():
        index = _owner(endpoint, found)
        if index is None:
            reason = f"which node the {endpoint.draft.kind} is of: `{endpoint.node}` may be one of several"
            mark = Remark(reason, endpoint.call.span)
            endpoint = replace(
                endpoint, draft=replace(endpoint.draft, remarks=(*endpoint.draft.remarks, mark))
            )
        owned[index or 0].append(endpoint)
    clients, actions = find_clients(files, calls, values), find_actions(calls, values)
    servers = [handle_of(call.arguments[1]) for call in calls if call.name in SERVERS and call.arguments[1:]]
    is_held = any(call.name in _HELD for call in calls)
    nodes: list[DraftNode] = []
    for index, node in enumerate(found):
        own = tuple(endpoint.draft for endpoint in _once(owned[index]))
        domain = _domain(calls, values, remarks) if index == 0 else nodes[0].domain_id
        nodes.append(
            replace(
                node.draft,
                endpoints=own,
                timers=() if index else timers,
                clients=tuple(client.draft for client in clients if owner(client, found) == index),
                actions=actions_of(index, found, actions),
                at_agent=is_held,
                may_be_at_agent=node.handle in servers or (len(found) == 1 and bool(servers)),
                domain_id=domain,
            )
        )
    return tuple(nodes), remarks


def _unique(found: list[FoundNode]) -> list[FoundNode]:
    """Return the nodes, each once: an application that connects again creates its node again."""
    kept: dict[tuple[str, str, str], FoundNode] = {}
    for node in found:
        key = (node.draft.name, node.draft.namespace, "" if node.draft.name else node.handle)
        kept.setdefault(key, node)
    return list(kept.values())


def _once(endpoints: Iterable[FoundEndpoint]) -> Iterable[FoundEndpoint]:
    """Yield each endpoint once: an application that connects again creates it again; turns of a loop are several."""
    seen = set()
    for endpoint in endpoints:
        draft = endpoint.draft
        key = (draft.kind, draft.name, draft.type, endpoint.call.turn)
        if key not in seen or not all(key[:3]):
            seen.add(key)
            yield endpoint


def _owner(endpoint: FoundEndpoint, nodes: list[FoundNode]) -> int | None:
    """Return the index of the node that an endpoint is of; None where it can be more than one."""
    named = [i for i, node in enumerate(nodes) if node.handle and node.handle == endpoint.node]
    alike = [i for i in named if nodes[i].call.function == endpoint.call.function]
    for found in (alike, named, list(range(len(nodes)))):
        if len(found) == 1:
            return found[0]
    return None


def _domain(calls: Iterable[Call], values: Values, remarks: list[Remark]) -> int:
    for call in calls:
        if call.name == "rcl_init_options_set_domain_id" and len(call.arguments) == 2:
            domain = values.number(call.arguments[1], call)
            if isinstance(domain, int):
                return domain
            remarks.append(Remark(f"the domain: {domain.reason}", call.span))
    return 0


def _macros(files: Iterable[CFile]) -> list[Remark]:
    """Return a remark for each macro with arguments whose body creates something: such calls are not followed."""
    creating = {*ENDPOINT_CALLS, *NODE_CALLS, *TIMER_CALLS}
    return [
        Remark(
            f"the macro {macro.name} creates something; what its uses create is not known here", macro.span
        )
        for file in files
        for macro in file.macros
        if macro.has_arguments and any(token.text in creating for token in macro.body)
    ]


def _executors(calls: Iterable[Call]) -> dict[str, DraftValue]:
    """Return `pools.executors` where the sources have more than one: a declared application has one by default."""
    inits = {
        handle_of(call.arguments[0]): call
        for call in calls
        if call.name == "rclc_executor_init" and call.arguments
    }
    if len(inits) < 2:
        return {}
    last = list(inits.values())[-1]
    return {"executors": DraftValue(len(inits), f"{last.name} ({place(last.span)})")}


def _wanted(
    files: Iterable[CFile],
    called: Iterable[Call],
    selected: Mapping[str, tuple[str, ...]],
    catalogue: Catalogue,
) -> set[str]:
    """Return the components that have what is called, have the headers that are included, or serve several tasks."""
    headers = {header: component.name for component in catalogue.values() for header in component.headers}
    found = {name for call in called for name in selected.get(call.name, ())}
    found |= {headers[i.name] for file in files for i in file.text.includes if i.name in headers}
    starts = {call.name for file in files for call in file.calls} & _TASKS
    names = {token.text for file in files for token in file.text.tokens if token.kind == "name"}
    return found | ({"multithread"} if starts or names >= _THREADS else set())


def _components(wanted: set[str], catalogue: Catalogue, of_profiles: Set[str]) -> tuple[str, ...]:
    """Return the components that have to be named: without those that others bring along."""
    wanted = {name for name in wanted | {"node"} if catalogue[name].ready and not name.startswith(_AXES)}
    needed = {below for name in wanted | of_profiles for below in _below(name, catalogue)}
    return tuple(f"+{name}" for name in sorted(wanted - needed - of_profiles))


def _below(name: str, catalogue: Catalogue) -> set[str]:
    found: set[str] = set()
    pending = list(catalogue[name].needs)
    while pending:
        needed = pending.pop()
        if needed not in found:
            found.add(needed)
            pending += catalogue[needed].needs
    return found
