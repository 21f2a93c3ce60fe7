# SPDX-License-Identifier: Apache-2.0
"""Small random models for property tests."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import strategies as st

from tests.support.modes.oracle import DEFAULT, STUCK, PlainModel, PlainRule, PlainSystem

MODES = ("__DEFAULT__", "A", "B")


@st.composite
def plain_models(draw: st.DrawFn) -> PlainModel:
    """Draw a system of one to three nodes, or one or two above it, each with the next one below and perhaps a node."""
    above = draw(st.sampled_from(((), ("top",), ("mid", "top"))))
    count = draw(st.integers(1, 3 - len(above)))
    nodes = {f"n{i}": MODES[: draw(st.integers(1, 3))] for i in range(count)}
    systems = {"low": draw(_system(nodes))}
    for name in above:
        below, system = list(systems.items())[-1]
        parts = {below: tuple(system.modes)}
        if draw(st.booleans()):
            parts[f"extra_{name}"] = nodes[f"extra_{name}"] = MODES[:2]
        systems[name] = draw(_system(parts, systems=(below,)))
    return PlainModel(nodes, systems)


@st.composite
def _system(draw: st.DrawFn, parts: dict[str, tuple[str, ...]], systems: tuple[str, ...] = ()) -> PlainSystem:
    names = MODES[: draw(st.integers(1, 3))]
    modes = {mode: {p: draw(_command(modes, p in systems)) for p, modes in parts.items()} for mode in names}
    targets = st.sampled_from(("inactive", *(f"active.{mode}" for mode in names)))
    rules = [
        PlainRule(
            f"r{i}",
            draw(targets),
            part,
            draw(_status(part, parts, systems)),
            draw(targets),
            draw(_recovery(parts, systems)),
        )
        for i, part in enumerate(draw(st.lists(st.sampled_from(sorted(parts)), max_size=6)))
    ]
    return PlainSystem(modes, tuple(rules))


def _recovery(parts: dict[str, tuple[str, ...]], systems: tuple[str, ...]) -> st.SearchStrategy[str]:
    """Draw when a rule is undone; often never."""
    found = st.sampled_from(sorted(parts)).flatmap(
        lambda part: _status(part, parts, systems).map(lambda status: f"{part} {status}")
    )
    return st.one_of(st.just(""), found)


def _command(modes: tuple[str, ...], is_system: bool) -> st.SearchStrategy[str]:
    resting = ("inactive",) if is_system else ("inactive", "unconfigured")
    return st.sampled_from((*resting, "active", *(f"active.{mode}" for mode in modes)))


def _status(part: str, parts: dict[str, tuple[str, ...]], systems: tuple[str, ...]) -> st.SearchStrategy[str]:
    states = ("activating", "deactivating", "inactive", "errorprocessing") if part in systems else STUCK
    return st.sampled_from((*states, *(f"active.{mode}" for mode in parts[part])))


WANTED = ("warn heat", "warn he*", "stale heat", "warn *", "error heat", "error motor", "stale h*")
REPORTED = ("heat", "he", "motor")
"""Names that are enough to let every pattern of WANTED hold without, and with, each other one."""


@st.composite
def diagnosed_models(draw: st.DrawFn) -> PlainModel:
    """Draw a small model with rules of which most want statuses of nodes, often while these are what is commanded."""
    plain = draw(plain_models())
    systems = {
        name: replace(system, rules=tuple(draw(_diagnosed(rule, plain, system)) for rule in system.rules))
        for name, system in plain.systems.items()
    }
    return replace(plain, systems=systems)


@st.composite
def _diagnosed(draw: st.DrawFn, rule: PlainRule, plain: PlainModel, system: PlainSystem) -> PlainRule:
    wanted = draw(st.sampled_from(("", *WANTED))) if rule.part in plain.nodes else ""
    if not wanted:
        return rule
    if wanted.startswith("error"):
        return replace(rule, wanted=wanted, status="errorprocessing")
    status = draw(st.sampled_from((rule.status, *[_commanded(system, rule.if_target, rule.part)] * 3)))
    part = draw(st.sampled_from(sorted(plain.nodes.keys() & system.modes["__DEFAULT__"].keys())))
    recover = draw(st.sampled_from((rule.recover, f"{part} {_commanded(system, rule.new_target, part)}")))
    return replace(rule, wanted=wanted, status=status, recover=recover)


def _commanded(system: PlainSystem, target: str, part: str) -> str:
    command = system.modes.get(target.removeprefix("active."), {}).get(part, "inactive")
    return DEFAULT if command == "active" else command


OTHERS = (
    "warn heat board",
    "warn he* board",
    "stale heat *",
    "error he* b*",
    "warn heat b*",
    "error heat board",
)
"""What rules want of what is no part: level, name and hardware."""
HARDWARE = ("board", "b")


@st.composite
def outside_models(draw: st.DrawFn, systems: int = 2) -> PlainModel:
    """Draw a small model with rules of which most want statuses of no part, in at most `systems` systems."""
    plain = draw(plain_models())
    chosen = draw(st.lists(st.sampled_from(sorted(plain.systems)), min_size=1, max_size=systems, unique=True))
    found = {
        name: replace(system, rules=tuple(draw(_outside(rule, system)) for rule in system.rules))
        if name in chosen
        else system
        for name, system in plain.systems.items()
    }
    return replace(plain, systems=found)


@st.composite
def _outside(draw: st.DrawFn, rule: PlainRule, system: PlainSystem) -> PlainRule:
    wanted = draw(st.sampled_from(("", *OTHERS)))
    if not wanted:
        return rule
    status = draw(st.sampled_from((rule.status, *[_commanded(system, rule.if_target, rule.part)] * 3)))
    recover = draw(
        st.sampled_from((rule.recover, f"{rule.part} {_commanded(system, rule.new_target, rule.part)}"))
    )
    return replace(rule, wanted=wanted, status=status, recover=recover)
