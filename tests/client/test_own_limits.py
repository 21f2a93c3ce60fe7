# SPDX-License-Identifier: Apache-2.0
"""Limits of entities: sets that equal ones share, names, sizes of types and streams, errors, and no cost elsewhere."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen import compiler
from microros_gen.application.model import LimitRule
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.interfaces.find import shipped_folder
from microros_gen.interfaces.types import Field, Message, NamedType, SequenceType, StringType, TypeName
from microros_gen.typesupport.plan.capacity import Capacities, Defaults, Entity, Root, plan_capacities
from microros_gen.typesupport.plan.own_limits import without_topic
from microros_gen.typesupport.plan.types import TypePlan, plan_types

NOTE = TypeName("pkg", "msg", "Note")
NOTES = TypeName("pkg", "msg", "Notes")
MESSAGES = {
    NOTE: Message(NOTE, (Field("text", StringType()),)),
    NOTES: Message(NOTES, (Field("notes", SequenceType(NamedType(NOTE))), Field("tail", StringType()))),
}


def root(index: int, topic: str, limit: int, name: TypeName = NOTE, sends: bool = True) -> Root:
    rule = LimitRule(("*",), limit, 2)
    return Root(name, (rule,), None, None, Entity("publisher", index, topic, "/node", sends))


def planned(*roots: Root) -> tuple[Capacities, dict[TypeName, TypePlan]]:
    diagnostics = Diagnostics()
    capacities = plan_capacities(MESSAGES, roots, (), Defaults(), diagnostics)
    plans = plan_types(MESSAGES, capacities, lambda _: "RIHS01_0", diagnostics)
    diagnostics.check()
    return capacities, {plan.name: plan for plan in plans}


def test_entities_with_equal_limits_share_a_set() -> None:
    _, plans = planned(root(0, "/a", 3), root(1, "/b", 5), root(2, "/c", 9), root(3, "/d", 5))
    note = plans[NOTE]
    assert [(s.name, [e.topic for e in s.entities]) for s in note.limit_sets] == [
        ("pkg__msg__Note__on__a", ["/a"]),
        ("pkg__msg__Note__on__b", ["/b", "/d"]),
    ]
    assert [note.largest("publisher", i) for i in range(4)] == [8, 10, 14, 10]
    assert note.limit_set("publisher", 2) is None, "its limits are those of the type"
    assert note.limit_set("subscription", 0) is None, "another kind counts for itself"


def test_the_type_has_the_larger_limits_member_by_member() -> None:
    """No entity has the limits of the type then, and each keeps its own."""
    first = replace(root(0, "/a", 2, NOTES), rules=(LimitRule(("tail",), 9, None), LimitRule(("*",), 2, 2)))
    _, plans = planned(first, root(1, "/b", 6, NOTES))
    notes = plans[NOTES]
    assert [len(s.entities) for s in notes.limit_sets] == [1, 1]
    assert all(s.max_encoded_size < notes.max_encoded_size for s in notes.limit_sets)


def test_a_set_is_a_further_use_of_every_type_in_it() -> None:
    """The nested type is called with a table; alone it would have constants."""
    _, alone = planned(root(0, "/a", 3, NOTES))
    constants = alone[NOTE].wire
    assert constants is not None
    assert constants.limit_members == ()
    _, plans = planned(root(0, "/a", 3, NOTES), root(1, "/b", 5, NOTES))
    for name, members in ((NOTE, ["text"]), (NOTES, ["notes", "notes__limits", "tail"])):
        wire = plans[name].wire
        assert wire is not None
        assert [m.name for m in wire.limit_members] == members


def test_what_is_only_received_changes_no_encoder() -> None:
    """An entity that does not send has its own size, and storage by topic; its type's encoder stays as it is."""
    capacities, plans = planned(root(0, "/a", 9), root(1, "/b", 5, sends=False))
    _, alone = planned(root(0, "/a", 9))
    assert plans[NOTE].wire == alone[NOTE].wire
    assert [(s.sends, s.max_encoded_size) for s in plans[NOTE].limit_sets] == [(False, 10)]
    assert [t.topic for t in capacities.topics] == ["/b"]


def test_one_topic_of_several_entities_stores_the_larger_of_both() -> None:
    capacities, plans = planned(root(0, "/a", 3), root(1, "/a", 5), root(2, "/b", 9))
    assert [(t.topic, t.limits.fields[0].string) for t in capacities.topics if t.limits.fields[0]] == [
        ("/a", 5)
    ]
    assert [s.name for s in plans[NOTE].limit_sets] == ["pkg__msg__Note__on__a", "pkg__msg__Note__on__a__2"]


_TOPICS = st.lists(st.sampled_from(["/a/b", "/a_b", "/a", "/a/b/_2", "/a_b_/2", "/a_b/_3"]), max_size=6)


@given(st.data())
def test_names_are_different(data: st.DataObject) -> None:
    """Topics whose names in C are the same, among them one that looks like a numbered name."""
    topics = data.draw(_TOPICS)
    limits = data.draw(st.lists(st.integers(1, 4), min_size=len(topics), max_size=len(topics)))
    roots = [root(i, *pair) for i, pair in enumerate(zip(topics, limits, strict=True))]
    _, plans = planned(*roots, root(len(topics), "/long", 5))
    names = [s.name for s in plans[NOTE].limit_sets]
    assert {without_topic(name) for name in names} <= {"pkg__msg__Note"}
    storages = [unit.name for unit in plans[NOTE].storage]
    assert len(names) == len(set(limits))
    assert len(set(names)) == len(names)
    assert len(set(storages)) == len(storages) == 1 + len(set(topics))


APPLICATION = """\
version: 1
profiles: [pure_sender]
transport: {{mtu: {mtu}}}
nodes:
  - name: arm
    publishers:
      - {{topic: small, type: std_msgs/msg/String, limits: {{data: {small}}}, qos: {{reliability: best_effort}}}}
      - {{topic: large, type: std_msgs/msg/String, limits: {{data: {large}}}}}
"""


def application(folder: Path, small: int, large: int, mtu: int = 256) -> compiler.Planned:
    path = folder / "microros.yaml"
    path.write_text(APPLICATION.format(small=small, large=large, mtu=mtu))
    return compiler.plan(
        compiler.resolve(compiler.read(compiler.Options(config=path, interface_paths=(shipped_folder(),))))
    )


@pytest.mark.parametrize(
    ("small", "large", "best_effort", "reliable"), [(103, 200, 120, 220), (200, 103, 220, 120)]
)
def test_each_stream_is_sized_for_those_that_write_to_it(
    tmp_path: Path, small: int, large: int, best_effort: int, reliable: int
) -> None:
    """A body of `limit` + 5 bytes after 12, rounded up to four."""
    runtime = application(tmp_path, small, large).project.runtime
    assert (runtime.streams.best_effort_size, runtime.streams.reliable_slot_size) == (best_effort, reliable)
    assert [bool(p.limited) for p in runtime.entities.publishers.declared] == [small < large, large < small]


def test_a_message_must_fit_its_own_stream_under_its_own_limits(tmp_path: Path) -> None:
    """The large one goes in fragments; the best-effort one, which cannot, has low limits and is no error."""
    assert application(tmp_path, 20, 400).project.runtime.streams.fragments
    with pytest.raises(UserError) as reported:
        application(tmp_path, 240, 400)
    (found,) = reported.value.diagnostics
    assert "std_msgs/msg/String on /small takes up to 260 bytes in its stream" in found.message


def test_nothing_is_there_where_publishers_agree(tmp_path: Path) -> None:
    found = application(tmp_path, 30, 30)
    assert (found.capacities.entities, found.capacities.topics) == ((), ())
    assert found.project.runtime.entities.limited_headers == ()
    assert all(not t.limit_sets for t in found.project.types)
