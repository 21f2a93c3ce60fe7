# SPDX-License-Identifier: Apache-2.0
"""Random models: the proof of stable rules and the simulation agree with trying every combination of failures."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from fnmatch import fnmatchcase
from itertools import combinations, pairwise, product

import pytest
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.mode_manager.simulation import simulate
from microros_gen.modes import Event, Manager, Model, Status, parse_model
from microros_gen.modes.behavior import settle_all
from microros_gen.modes.properties import check_inference
from microros_gen.modes.reachability import check_reachable
from microros_gen.modes.report import OPEN, PROVEN, REFUTED
from microros_gen.modes.stability import MOST_COMBINATIONS, check_stability, trace
from tests.support.examples import examples
from tests.support.modes.oracle import (
    STUCK,
    Levels,
    OscillatesError,
    PlainModel,
    PlainRule,
    PlainSystem,
    configurations,
    looking_the_same,
    reached,
    reached_in_time,
    settle,
)
from tests.support.modes.random_models import (
    HARDWARE,
    REPORTED,
    diagnosed_models,
    outside_models,
    plain_models,
)

_FEW = settings(max_examples=examples(40), deadline=None, suppress_health_check=[HealthCheck.too_slow])


def parsed(plain: PlainModel) -> Model:
    diagnostics = Diagnostics()
    model = parse_model(Source("random.yaml", plain.text()), diagnostics)
    assert model is not None, [d.render() for d in diagnostics]
    return model


def status(text: str) -> Status:
    state, _, mode = text.partition(".")
    return Status(state, mode)


def oscillating(plain: PlainModel, every_level: Callable[[], Iterable[Levels]] = lambda: ({},)) -> set[str]:
    """Return the lowest system whose rules never end, for some failures, levels and nodes that are configured."""
    for name, system in plain.systems.items():
        for levels, failures in product(every_level(), plain.failures()):
            for configured, target in product(configurations(plain, failures), system.targets):
                try:
                    settle(plain, name, target, failures, None, levels, set(configured))
                except OscillatesError as error:
                    return {str(error)}
    return set()


def check_oscillations(plain: PlainModel, every_level: Callable[[], Iterable[Levels]]) -> None:
    """Check that the proof finds the lowest system that trying finds, and shows it."""
    model = parsed(plain)
    found = settle_all(model, MOST_COMBINATIONS).oscillations
    assert {o.system for o in found[:1]} == oscillating(plain, every_level)
    for oscillation in found[:1]:
        lines = trace(model, oscillation)
        assert "oscillates: " in "\n".join(lines), lines


@_FEW
@given(plain_models())
def test_the_proof_finds_exactly_the_oscillations(plain: PlainModel) -> None:
    settled = settle_all(parsed(plain), MOST_COMBINATIONS)
    assert settled.open == ()
    found = [o.system for o in settled.oscillations]
    assert set(found[:1]) == oscillating(plain)


def reported_names(plain: PlainModel) -> list[str]:
    """Return the names of statuses that some rule wants."""
    wanted = [rule.wanted.split()[1] for s in plain.systems.values() for rule in s.rules if rule.wanted]
    return [name for name in REPORTED if any(fnmatchcase(name, pattern) for pattern in wanted)]


def all_levels(plain: PlainModel) -> Iterator[dict[str, dict[str, str]]]:
    """Yield every level of every status that can tell rules apart, of the nodes that rules want statuses of."""
    wanted = {rule.part for system in plain.systems.values() for rule in system.rules if rule.wanted}
    levels = ("ok", "warn", "error", "stale")
    names = reported_names(plain)
    of_node = [dict(zip(names, each, strict=True)) for each in product(levels, repeat=len(names))]
    for chosen in product(of_node, repeat=len(wanted)):
        yield dict(zip(sorted(wanted), chosen, strict=True))


@settings(max_examples=examples(400, part=10), deadline=None, suppress_health_check=list(HealthCheck))
@given(diagnosed_models())
def test_the_proof_finds_exactly_the_oscillations_with_diagnostics(plain: PlainModel) -> None:
    """Each combination of levels of all statuses with each of failures, of models with one or two such nodes."""
    diagnosed = {rule.part for s in plain.systems.values() for rule in s.rules if rule.wanted}
    assume(diagnosed and len(plain.nodes) < 3)
    assume(4 ** (len(reported_names(plain)) * len(diagnosed)) * 16 ** len(plain.nodes) <= 5000)
    check_oscillations(plain, lambda: all_levels(plain))


def outside_levels() -> Iterator[dict[str, dict[str, str]]]:
    """Yield every level of every status of no part that can tell rules apart."""
    names = ("heat", "he")
    for chosen in product(("ok", "warn", "error", "stale"), repeat=len(names) * len(HARDWARE)):
        each = iter(chosen)
        yield {f"hardware {hardware}": {name: next(each) for name in names} for hardware in HARDWARE}


@pytest.mark.system
@settings(max_examples=examples(150, 15, part=10), deadline=None, suppress_health_check=list(HealthCheck))
@given(outside_models(systems=1))
def test_the_proof_finds_exactly_the_oscillations_with_what_is_no_part(plain: PlainModel) -> None:
    assume(len(plain.nodes) < 3 and any(r.wanted for s in plain.systems.values() for r in s.rules))
    check_oscillations(plain, outside_levels)


@pytest.mark.system
@settings(max_examples=examples(60, 6, part=10), deadline=None, suppress_health_check=list(HealthCheck))
@given(outside_models())
def test_the_proof_finds_exactly_the_oscillations_where_two_systems_see_what_is_no_part(
    plain: PlainModel,
) -> None:
    """Each system for itself misses none, and may find more; both together find those that exist."""
    assume(len(plain.nodes) < 3)
    model, diagnostics = parsed(plain), Diagnostics()
    settled = settle_all(model, MOST_COMBINATIONS)
    tried = oscillating(plain, outside_levels)
    assert not tried or settled.oscillations
    result = check_stability(model, settled, MOST_COMBINATIONS, diagnostics).result
    assert result == (REFUTED if tried else PROVEN)
    assert {d.id for d in diagnostics} == ({"MG-8844"} if tried else set())


Drawn = tuple[PlainModel, str, Levels, frozenset[str]]
"""A model, a target of its topmost system, levels of nodes or of no part, and the nodes that are configured before."""


@st.composite
def requests(draw: st.DrawFn, models: st.SearchStrategy[PlainModel], is_outside: bool) -> Drawn:
    """Draw a request and what is before it."""
    plain = draw(models)
    owners = [f"hardware {hardware}" for hardware in HARDWARE] if is_outside else list(plain.nodes)
    levels = {
        owner: {name: draw(st.sampled_from(("ok", "warn", "error", "stale"))) for name in REPORTED}
        for owner in owners
    }
    target = draw(st.sampled_from(list(plain.systems.values())[-1].targets))
    return plain, target, levels, draw(st.frozensets(st.sampled_from(sorted(plain.nodes))))


def reporting(owner: str, name: str, level: str) -> Event:
    if owner.startswith("hardware "):
        return Event(0, "hardware", owner.removeprefix("hardware "), level=level, name=name)
    return Event(0, "diagnose", owner, level=level, name=name)


def check_ends(drawn: Drawn) -> None:
    """Check that the simulation of the proof, and the decisions of the manager, end where trying ends."""
    plain, target, levels, configured = drawn
    model, top = parsed(plain), list(plain.systems)[-1]
    try:
        expected = settle(plain, top, target, {}, None, levels, set(configured))
    except OscillatesError:
        return
    statuses = [(owner, name, level) for owner, own in levels.items() for name, level in own.items()]
    manager = Manager(model)
    for owner, name, level in statuses:
        list(manager.diagnose(owner, name, level))
    for node in configured:
        list(manager.change(node, Status("inactive")))
    assert "oscillation" not in [step.kind for step in manager.request(top, status(target))]
    assert str(manager.statuses()[top]) == expected
    events = [reporting(*each) for each in statuses]
    events += [Event(0, "change", node, Status("inactive")) for node in sorted(configured)]
    played = simulate(model, [*events, Event(1, "request", top, status(target))])
    assert str({end.part: end.status for end in played.ends}[top]) == expected, played.text()


_STAYING = PlainRule("r", "inactive", "n0", "inactive", "active.__DEFAULT__", "", "warn heat board")
_RESTING = PlainModel(
    {"n0": ("__DEFAULT__",)}, {"low": PlainSystem({"__DEFAULT__": {"n0": "inactive"}}, (_STAYING,))}
)
"""A node that is unconfigured stays so, which counts as inactive for the mode, but not for the rule."""
_HOT = {"hardware board": {"heat": "warn"}}


@_FEW
@given(requests(outside_models(), is_outside=True))
@example((_RESTING, "inactive", _HOT, frozenset()))
@example((_RESTING, "inactive", _HOT, frozenset({"n0"})))
def test_the_simulations_end_with_what_is_no_part_where_trying_ends(drawn: Drawn) -> None:
    check_ends(drawn)


@_FEW
@given(requests(diagnosed_models(), is_outside=False))
def test_the_simulations_end_with_diagnostics_where_trying_ends(drawn: Drawn) -> None:
    check_ends(drawn)


@_FEW
@given(plain_models())
def test_modes_look_the_same_as_trying_says(plain: PlainModel) -> None:
    diagnostics = Diagnostics()
    result = check_inference(parsed(plain), diagnostics).result
    words = [d.message.split("'") for d in diagnostics if d.id == "MG-8841"]
    for name in plain.systems:
        groups: dict[str, set[str]] = {}
        for _, first, _, second, _, system, _ in words:
            if system == name:
                groups.setdefault(first, {first}).add(second)
        found = {frozenset(pair) for group in groups.values() for pair in combinations(group, 2)}
        assert found == looking_the_same(plain, name)
    assert (result == PROVEN) == (not words)


@_FEW
@given(plain_models())
def test_modes_are_reached_as_trying_says(plain: PlainModel) -> None:
    """What is proven is reached by one request, what is refuted never, in whatever order nodes fail and recover."""
    model, diagnostics = parsed(plain), Diagnostics()
    settled = settle_all(model, MOST_COMBINATIONS)
    result = check_reachable(model, settled, MOST_COMBINATIONS, diagnostics).result
    names = list(plain.systems)
    for name, above in pairwise(names):
        surely = {target for target in reached(plain, name, above) if target != "inactive"}
        found = {d.message.split("'")[1]: d.id for d in diagnostics if d.message.split("'")[3] == name}
        unreached = {mode for mode in plain.systems[name].modes if f"active.{mode}" not in surely}
        assert unreached <= found.keys()
        assert settled.oscillations or unreached == found.keys()
        failures = list(plain.failures())
        in_time = reached_in_time(plain, names[-1], failures[:: 1 + len(failures) // 250])[name]
        assert not {f"active.{mode}" for mode, identity in found.items() if identity == "MG-8843"} & in_time
        assert result != PROVEN or not unreached


def test_a_mode_whose_rule_follows_from_changing_failures_is_not_refuted() -> None:
    """b leads to C only while q alone has failed after p."""
    rules = (
        PlainRule("a", "active.A", "p", "inactive", "active.B"),
        PlainRule("b", "active.B", "q", "inactive", "active.C"),
        PlainRule("c", "active.A", "q", "inactive", "inactive"),
    )
    idle = {"p": "inactive", "q": "inactive"}
    modes = {"__DEFAULT__": idle, **{m: {"p": "active", "q": f"active.{m}"} for m in "ABC"}}
    top = PlainSystem({"__DEFAULT__": {"low": "active.A"}}, ())
    nodes = {"p": ("__DEFAULT__",), "q": ("__DEFAULT__", "A", "B", "C")}
    plain = PlainModel(nodes, {"low": PlainSystem(modes, rules), "top": top})
    model, diagnostics = parsed(plain), Diagnostics()
    settled = settle_all(model, MOST_COMBINATIONS)
    assert check_reachable(model, settled, MOST_COMBINATIONS, diagnostics).result == OPEN
    found = {d.message: d for d in diagnostics}
    assert "the mode 'B' of 'q' is never reached" not in found
    assert found["not proven: the mode 'C' of 'low' is reached"].id == "MG-8846"
    assert "active.C" not in reached(plain, "low", "top")
    assert "active.C" in reached_in_time(plain, "top", list(plain.failures()))["low"]


@_FEW
@given(plain_models())
def test_the_trace_of_an_oscillation_shows_it(plain: PlainModel) -> None:
    model = parsed(plain)
    for oscillation in settle_all(model, MOST_COMBINATIONS).oscillations[:1]:
        lines = trace(model, oscillation)
        assert "oscillates: " in "\n".join(lines)
        assert all(any(f"rule {rule}: " in line for line in lines) for rule in oscillation.rules)


@_FEW
@given(plain_models(), st.integers(0, 10**6))
def test_the_simulation_ends_where_trying_ends(plain: PlainModel, skipped: int) -> None:
    model = parsed(plain)
    for failures in map(plain.failure, range(skipped, skipped + 25)):
        top = list(plain.systems)[-1]
        for target in plain.systems[top].targets:
            try:
                expected = settle(plain, top, target, failures)
            except OscillatesError:
                continue
            manager = Manager(model)
            for node, state in failures.items():
                assert {step.kind for step in manager.fail(node, status(state))} <= {"status"}
            steps = list(manager.request(top, status(target)))
            assert "oscillation" not in [step.kind for step in steps]
            assert str(manager.statuses()[top]) == expected


@st.composite
def histories(draw: st.DrawFn) -> tuple[PlainModel, tuple[Event, ...]]:
    """Draw a model and what happens to it."""
    plain = draw(plain_models())
    plain = replace(plain, alike=draw(st.frozensets(st.sampled_from(sorted(plain.nodes)))))
    events = []
    for i in range(draw(st.integers(1, 8))):
        kind = draw(st.sampled_from(("request", "fail", "repair", "change")))
        if kind == "request":
            part = draw(st.sampled_from(sorted(plain.systems)))
            events.append(Event(i, kind, part, status(draw(st.sampled_from(plain.systems[part].targets)))))
            continue
        part = draw(st.sampled_from(sorted(plain.nodes)))
        states = (*STUCK, *(f"active.{mode}" for mode in plain.nodes[part]))
        found = None if kind == "repair" else status(draw(st.sampled_from(states)))
        events.append(Event(i, kind, part, found))
    return plain, tuple(events)


@settings(max_examples=examples(300), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(histories())
def test_what_is_proven_is_stable_whatever_happens(history: tuple[PlainModel, tuple[Event, ...]]) -> None:
    """Requests, failures, repairs and changes by others, in any order and one after another."""
    plain, events = history
    model = parsed(plain)
    settled = settle_all(model, MOST_COMBINATIONS)
    if check_stability(model, settled, MOST_COMBINATIONS, Diagnostics()).result == PROVEN:
        assert simulate(model, events).is_stable


def test_parts_that_wait_for_each_other_rest_in_the_end() -> None:
    """A node between two states waits for another that has to stop first, and that one has failed."""
    systems = {
        "low": PlainSystem(modes={"__DEFAULT__": {"n0": "inactive"}}, rules=()),
        "top": PlainSystem(
            modes={"__DEFAULT__": {"low": "active.__DEFAULT__", "extra": "inactive"}}, rules=()
        ),
    }
    plain = PlainModel(nodes={"n0": ("__DEFAULT__",), "extra": ("__DEFAULT__",)}, systems=systems)
    events = (
        Event(0, "request", "top", status("active.__DEFAULT__")),
        Event(1, "change", "n0", status("unknown")),
        Event(2, "fail", "extra", status("errorprocessing")),
    )
    assert simulate(parsed(plain), events).is_stable
