# SPDX-License-Identifier: Apache-2.0
"""Limits → capacities: precedence, bounds, defaults, and what is refused."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest

from microros_gen.application.limit_tree import PROPOSED_LIMITS
from microros_gen.application.model import LimitRule
from microros_gen.diagnostics import Diagnostics, Source, Span, UserError
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.types import Field, Message, StringType, TypeName
from microros_gen.typesupport.plan.capacity import Capacities, Defaults, Entity, Origin, Root, plan_capacities
from microros_gen.typesupport.plan.size import WireSizes
from microros_gen.typesupport.plan.types import plan_types
from tests.support.ids import without_id

FILES = {
    "Leaf": "string text\nstring<=10 brief\nuint8[] raw\n",
    "Middle": "Leaf leaf\nLeaf[<=4] leaves\n",
    "Root": "Middle middle\nstring[] names\nint32 number\nLeaf leaf\n",
}
ROOT = TypeName("pkg", "msg", "Root")


@pytest.fixture(scope="module")
def messages() -> Mapping[TypeName, Message]:
    diagnostics = Diagnostics()
    found = {}
    for name, text in FILES.items():
        type_name = TypeName("pkg", "msg", name)
        message = parse_msg(Source(f"{name}.msg", text), type_name, diagnostics)
        assert message is not None
        found[type_name] = message
    diagnostics.check()
    return found


def rule(
    path: str, string: int | None = None, sequence: int | None = None, single: bool = False
) -> LimitRule:
    text = f"{path}: here"
    return LimitRule(
        tuple(path.split(".")), string, sequence, Span(Source("microros.yaml", text), 1, 1), single
    )


def plan(
    messages: Mapping[TypeName, Message],
    *rules: LimitRule,
    defaults: Defaults | None = None,
    roots: tuple[Root, ...] = (Root(ROOT),),
) -> Capacities:
    diagnostics = Diagnostics()
    capacities = plan_capacities(messages, roots, rules, defaults or Defaults(), diagnostics)
    diagnostics.check()
    return capacities


def value(capacities: Capacities, path: str, kind: str = "string") -> int:
    (found,) = [c for c in capacities.decided if ".".join(c.path) == path and c.kind == kind]
    return found.value


def errors(messages: Mapping[TypeName, Message], *rules: LimitRule, **options: object) -> list[str]:
    with pytest.raises(UserError) as caught:
        plan(messages, *rules, **options)  # type: ignore[arg-type]
    return [without_id(d.headline()) for d in caught.value.diagnostics]


def test_defaults_hold_and_are_recorded(messages: Mapping[TypeName, Message]) -> None:
    capacities = plan(messages)
    assert value(capacities, "names", "sequence") == 16
    assert value(capacities, "names") == 64
    assert value(capacities, "leaf.brief") == 10
    assert value(capacities, "middle.leaves", "sequence") == 4
    assert {".".join(c.path) for c in capacities.defaulted} == {
        "names",
        "leaf.text",
        "leaf.raw",
        "middle.leaf.text",
        "middle.leaf.raw",
        "middle.leaves.text",
        "middle.leaves.raw",
    }
    assert capacities.defaulted[0].key.startswith("pkg/msg/Root: {")


@pytest.mark.parametrize(
    ("added", "expected"),
    [
        ("*", 1),
        ("pkg/msg/Root", 2),
        ("pkg/msg/Middle", 3),
        ("pkg/msg/Leaf", 4),
        ("pkg/msg/Leaf.text", 5),
        ("pkg/msg/Middle.leaf.text", 6),
        ("pkg/msg/Root.middle", 7),
        ("pkg/msg/Root.middle.leaf", 8),
        ("pkg/msg/Root.middle.leaf.text", 9),
    ],
)
def test_each_rule_wins_over_those_before_it(
    messages: Mapping[TypeName, Message], added: str, expected: int
) -> None:
    """The rules of the list up to `added`, in any order of the file: the last one decides."""
    order = [
        "*",
        "pkg/msg/Root",
        "pkg/msg/Middle",
        "pkg/msg/Leaf",
        "pkg/msg/Leaf.text",
        "pkg/msg/Middle.leaf.text",
        "pkg/msg/Root.middle",
        "pkg/msg/Root.middle.leaf",
        "pkg/msg/Root.middle.leaf.text",
    ]
    rules = [rule(path, string=1 + i) for i, path in enumerate(order[: order.index(added) + 1])]
    assert value(plan(messages, *rules), "middle.leaf.text") == expected
    assert value(plan(messages, *reversed(rules)), "middle.leaf.text") == expected


def test_an_entity_has_its_own_and_types_share_the_larger(messages: Mapping[TypeName, Message]) -> None:
    roots = (
        Root(ROOT, (rule("*", string=5), rule("leaf.text", string=90))),
        Root(ROOT, (rule("*", string=6), rule("pkg/msg/Root.names", sequence=3))),
    )
    capacities = plan(messages, rule("pkg/msg/Root.middle.leaf.text", string=50), roots=roots)
    assert value(capacities, "middle.leaf.text") == 6
    assert value(capacities, "leaf.text") == 90
    assert value(capacities, "names", "sequence") == 16
    limits = capacities.limits[ROOT]
    assert limits is not None
    assert limits.fields[3] is not None
    assert limits.fields[3].nested is not None
    assert limits.fields[3].nested.fields[0] is not None
    assert limits.fields[3].nested.fields[0].string == 90


def test_one_number_means_what_the_field_is(messages: Mapping[TypeName, Message]) -> None:
    capacities = plan(
        messages, rule("pkg/msg/Leaf.raw", 7, 7, single=True), rule("pkg/msg/Leaf.text", 8, 8, True)
    )
    assert value(capacities, "leaf.raw", "sequence") == 7
    assert value(capacities, "leaf.text") == 8


def test_one_number_for_a_sequence_of_messages_counts_them_and_nothing_below(
    messages: Mapping[TypeName, Message],
) -> None:
    leaf = (rule("*", string=30, sequence=5), rule("pkg/msg/Leaf.raw", 7, 7, single=True))
    of_root = rule("pkg/msg/Root.middle.leaves", 2, 2, single=True)
    of_middle = rule("pkg/msg/Middle.leaves", 2, 2, single=True)
    own = (Root(ROOT, (rule("middle.leaves", 2, 2, single=True),)),)
    for capacities in (
        plan(messages, *leaf, of_root),
        plan(messages, *leaf, of_middle),
        plan(messages, *leaf, roots=own),
    ):
        assert value(capacities, "middle.leaves", "sequence") == 2
        assert value(capacities, "middle.leaves.text") == 30
        assert value(capacities, "middle.leaves.raw", "sequence") == 7
    one_for_all = plan(messages, *leaf, rule("pkg/msg/Root.middle.leaf", 3, 3, single=True))
    assert value(one_for_all, "middle.leaf.text") == value(one_for_all, "middle.leaf.raw", "sequence") == 3


def test_bounds_cap_general_rules(messages: Mapping[TypeName, Message]) -> None:
    capacities = plan(messages, rule("*", string=99, sequence=99))
    assert value(capacities, "leaf.brief") == 10
    assert value(capacities, "middle.leaves", "sequence") == 4
    assert value(plan(messages, rule("*", string=3)), "leaf.brief") == 3


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (rule("pkg/msg/Leaf.brief", string=11), "the limit 11 for pkg/msg/Leaf.brief is above its bound 10"),
        (rule("pkg/msg/Root.middle.leaves", sequence=5), "is above its bound 4"),
        (rule("pkg/msg/Root.nmaes", sequence=5), "has no member 'nmaes'. Did you mean 'names'?"),
        (rule("pkg/msg/Root.number", sequence=5), "pkg/msg/Root.number has a fixed size"),
        (rule("pkg/msg/Leaf.raw", string=5), "pkg/msg/Leaf.raw is not a string"),
        (rule("pkg/msg/Leaf.text", sequence=5), "pkg/msg/Leaf.text is not a sequence"),
        (rule("pkg/msg/Root.names", 5, 5, single=True), "is ambiguous: it is a sequence of strings"),
        (rule("pkg/msg/Root.names.x", string=5), "a primitive has no members"),
        (rule("pkg/msg/Leaf.text", string=-1), "a string limit of -1 is out of range"),
    ],
)
def test_rules_that_cannot_hold(messages: Mapping[TypeName, Message], bad: LimitRule, message: str) -> None:
    (found,) = errors(messages, bad)
    assert found.startswith("microros.yaml:1:1: error: ")
    assert message in found


def test_a_rule_for_an_unused_type_is_a_warning(messages: Mapping[TypeName, Message]) -> None:
    diagnostics = Diagnostics()
    rules = (rule("pkg/msg/Laef", string=1),)
    plan_capacities(messages, (Root(ROOT),), rules, Defaults(), diagnostics)
    (found,) = diagnostics
    assert "warning: the limit for 'pkg/msg/Laef' has no effect" in without_id(found.headline())
    assert "Did you mean 'pkg/msg/Leaf'?" in without_id(found.headline())


def test_a_rule_for_a_service_is_a_warning_with_the_names_of_its_messages() -> None:
    text = Field("text", StringType())
    parts = {
        name: Message(name, (text,))
        for name in (TypeName("pkg", "srv", "Ask_Request"), TypeName("pkg", "srv", "Ask_Response"))
    }
    diagnostics = Diagnostics()
    plan_capacities(parts, tuple(map(Root, parts)), (rule("pkg/srv/Ask", string=1),), Defaults(), diagnostics)
    (found,) = diagnostics
    assert without_id(found.headline()).endswith(
        "is not used. Limits are those of pkg/srv/Ask_Request and pkg/srv/Ask_Response"
    )


def test_without_defaults_every_unset_field_is_named(messages: Mapping[TypeName, Message]) -> None:
    off = Defaults(None, None)
    found = errors(messages, rule("pkg/msg/Leaf", string=3, sequence=2), defaults=off)
    (line,) = found
    assert "pkg/msg/Root has no limit for names" in line
    assert line.endswith('Add `"*": {string: 32, sequence: 8}` to `limits:`')
    capacities = plan(messages, rule("*", string=3, sequence=2), defaults=off)
    assert all(c.origin is not Origin.DEFAULT for c in capacities.decided)


@pytest.mark.parametrize("room", [400, 1000, 4000, 65000])
def test_the_suggested_numbers_fit(messages: Mapping[TypeName, Message], room: int) -> None:
    found = errors(messages, defaults=Defaults(None, None), roots=(Root(ROOT, room=room),))
    string, sequence = (int(number) for number in re.findall(r": ([0-9]+)", found[0].split("Add ")[1]))
    sizes = WireSizes(messages)
    capacities = plan(messages, rule("*", string=string, sequence=sequence))
    assert sizes.largest(ROOT, capacities.limits[ROOT]) <= room
    at = PROPOSED_LIMITS.index((string, sequence))
    for larger in PROPOSED_LIMITS[:at]:
        capacities = plan(messages, rule("*", string=larger[0], sequence=larger[1]))
        assert sizes.largest(ROOT, capacities.limits[ROOT]) > room, "the largest pair that fits"


def test_a_default_value_above_the_limit_is_refused(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    name = TypeName("pkg", "msg", "D")
    text = "string greeting \"hello\"\nint32[] three [1, 2, 3]\nwstring wide 'abc'\n"
    message = parse_msg(Source("D.msg", text), name, diagnostics)
    assert message is not None
    rules = (rule("*", string=2, sequence=2),)
    capacities = plan_capacities({name: message}, (Root(name),), rules, Defaults(), diagnostics)
    plan_types({name: message}, capacities, lambda _: "RIHS01_0", diagnostics)
    found = [without_id(d.headline()) for d in diagnostics]
    assert [line.split(": ")[0] for line in found] == ["D.msg:1:1", "D.msg:2:1", "D.msg:3:1"]
    assert (
        "default value of 'greeting' needs a string limit of 5, but the limit of pkg/msg/D.greeting is 2"
        in found[0]
    )


def test_a_default_value_above_a_limit_names_the_use_and_the_topic() -> None:
    diagnostics = Diagnostics()
    texts = {"In": 'string word "hello"\n', "Out": "In[] parts\nIn one\n"}
    messages: dict[TypeName, Message] = {}
    for short, text in texts.items():
        name = TypeName("pkg", "msg", short)
        message = parse_msg(Source(f"{short}.msg", text), name, diagnostics)
        assert message is not None
        messages[name] = message
    name = TypeName("pkg", "msg", "Out")
    low = Root(name, (rule("one.word", string=4),), entity=Entity("publisher", 0, "/low", "/n"))
    roots = (Root(name, entity=Entity("publisher", 1, "/all", "/n")), low)
    rules = (rule("*", string=9, sequence=2), rule("pkg/msg/Out.parts.word", string=3))
    capacities = plan_capacities(messages, roots, rules, Defaults(), diagnostics)
    plan_types(messages, capacities, lambda _: "RIHS01_0", diagnostics)
    found = "\n".join(without_id(d.headline()) for d in diagnostics)
    assert "limit of 5, but the limit of pkg/msg/Out.parts.word is 3" in found
    assert "limit of 5, but the limit of pkg/msg/Out.one.word on /low is 4" in found


def test_a_message_beyond_32_bits_is_refused(messages: Mapping[TypeName, Message]) -> None:
    diagnostics = Diagnostics()
    rules = (rule("*", string=2**31 - 1, sequence=2**31 - 1),)
    capacities = plan_capacities(messages, (Root(ROOT),), rules, Defaults(), diagnostics)
    plan_types(messages, capacities, lambda _: "RIHS01_0", diagnostics)
    assert any("Lower its limits" in without_id(d.headline()) for d in diagnostics)
