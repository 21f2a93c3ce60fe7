# SPDX-License-Identifier: Apache-2.0
"""Messages inside one image: which ends of a topic agree, what waits where, and what a scripted agent sees of it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen.components.agentless.plan import AgentlessPlan
from microros_gen.components.loaned_messages.plan import LoansPlan
from microros_gen.components.local_delivery.plan import LocalPlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import SANITIZE, UNITS, planned, rendered, run
from tests.support.ids import without_id
from tests.support.patience import seconds
from tests.support.runtime.harness import SANITIZER, Tree, compile_merged, link

HEAD = """\
version: 1
profiles: [pure_sender, pure_reader]
limits: {"*": {string: 20, sequence: 2}}
"""
NUMBER = "type: std_msgs/msg/Int32"
APPLICATION = f"""\
{HEAD}
nodes:
  - name: device
    publishers:
      - {{topic: count, {NUMBER}, local: only}}
      - {{topic: joints, type: sensor_msgs/msg/JointState, local: only}}
      - {{topic: wide, type: example_interfaces/msg/WString, local: only}}
      - {{topic: mixed, {NUMBER}, local: only}}
      - {{topic: shout, {NUMBER}, local: also, qos: {{reliability: best_effort}}}}
    subscriptions:
      - {{topic: count, {NUMBER}, local: only, queue: 3}}
      - {{topic: joints, type: sensor_msgs/msg/JointState, local: only, queue: 2}}
      - {{topic: wide, type: example_interfaces/msg/WString, local: only, queue: 1}}
      - {{topic: mixed, {NUMBER}, local: also, qos: {{reliability: best_effort}}}}
      - {{topic: shout, {NUMBER}, local: only, qos: {{reliability: best_effort}}}}
  - name: other
    subscriptions:
      - {{topic: /count, {NUMBER}, local: only, qos: {{depth: 5}}}}
"""
ALONE = """\
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32, local: only}]
    subscriptions: [{topic: count, type: std_msgs/msg/Int32, local: only}]
"""
THREAD_SANITIZER = ("-std=gnu99", "-g", "-O0", "-fsanitize=thread", f"-I{UNITS}")


def local(folder: Path, text: str) -> LocalPlan:
    part = planned(folder, text).project.runtime.features.of("local_delivery")
    assert isinstance(part, LocalPlan)
    return part


def agentless(folder: Path, text: str) -> AgentlessPlan:
    part = planned(folder, text).project.runtime.features.of("agentless")
    assert isinstance(part, AgentlessPlan)
    return part


def program(out: Path, sources: list[Path], units: list[str], flags: tuple[str, ...]) -> Path:
    objects = compile_merged(Tree(out, ()), sources, [UNITS / unit for unit in units], SANITIZER, flags)
    return link(objects, SANITIZER, flags, out / "unit")


def test_what_waits_and_where_it_goes(tmp_path: Path) -> None:
    part = local(tmp_path, APPLICATION)
    assert [(q.receiver, q.topic, q.slots) for q in part.queues] == [
        (0, "/count", 3),
        (1, "/joints", 2),
        (2, "/wide", 1),
        (3, "/mixed", 10),
        (4, "/shout", 10),
        (5, "/count", 5),
    ]
    assert [(r.queues, r.only) for r in part.routes] == [
        ((0, 5), True),
        ((1,), True),
        ((2,), True),
        ((3,), True),
        ((4,), False),
    ]
    apart = agentless(tmp_path, APPLICATION)
    assert [place.name for place in apart.places if place.value == "false"] == [
        "/device",
        "/other",
        "publisher /shout",
        "subscription /mixed",
    ]
    assert not apart.alone


def test_an_image_without_other_endpoints_needs_no_agent(tmp_path: Path) -> None:
    assert agentless(tmp_path, HEAD + ALONE).alone
    assert local(tmp_path, HEAD + ALONE).shown == "/count (only); no agent is needed"
    assert not agentless(tmp_path, f"{HEAD}components: [+logger_services]\n{ALONE}").alone


def test_without_the_key_nothing_of_it_is_in_an_image(tmp_path: Path) -> None:
    selection = planned(tmp_path, HEAD + ALONE.replace("local: only", "local: never")).resolved.selection
    assert not selection.has("local_delivery")


@pytest.mark.parametrize(
    ("writer", "reader", "words"),
    [
        ("local: only", "queue: 1", "microros.yaml:7:22: error: the subscription of '/a' is not local"),
        ("qos: {depth: 2}", "local: also", "microros.yaml:6:19: error: the publisher of '/a' is not local"),
        ("local: also", "local: also", "would arrive twice: the publisher in line 6"),
        ("local: only, qos: {reliability: best_effort}", "local: only", "never matches the best effort"),
        ("local: only, qos: {history: keep_all}", "local: only", "has `history: keep_all`"),
        ("local: only", "local: only, qos: {durability: transient_local}", "`durability: transient_local`"),
        ("local: only, qos: {deadline: 1 s}", "local: only", "has a deadline"),
        ("local: only, qos: {lifespan: 1 s}", "local: only", "has a lifespan"),
        ("local: only, limits: {string: 4}", "local: only", "the limits of '/a' differ"),
        (
            "local: only",
            "local: only, qos: {depth: 1000}",
            "1000 local messages of '/a' are more than the 254",
        ),
    ],
)
def test_ends_that_do_not_agree(tmp_path: Path, writer: str, reader: str, words: str) -> None:
    text = f"""\
{HEAD}nodes:
  - name: device
    publishers: [ {{topic: a, type: std_msgs/msg/String, {writer}}}]
    subscriptions: [ {{topic: a, type: std_msgs/msg/String, {reader}}}]
"""
    with pytest.raises(UserError) as caught:
        planned(tmp_path, text)
    assert words in without_id(str(caught.value))


@pytest.mark.parametrize(
    ("kind", "missing"), [("publishers", "subscribes to"), ("subscriptions", "publishes")]
)
def test_one_end_alone(tmp_path: Path, kind: str, missing: str) -> None:
    text = f"{HEAD}nodes: [{{name: device, {kind}: [{{topic: a, {NUMBER}, local: only}}]}}]\n"
    with pytest.raises(UserError, match=f"nothing in the image {missing} '/a'"):
        planned(tmp_path, text)


def test_the_component_without_the_key(tmp_path: Path) -> None:
    text = f"{HEAD}components: [+local_delivery]\n{ALONE.replace('local: only', 'local: never')}"
    with pytest.raises(UserError, match="is for endpoints with `local:`"):
        planned(tmp_path, text)


def test_preconfigured_entities_exist_at_the_agent(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="'entities: preconfigured' creates the publisher of '/count'"):
        planned(tmp_path, f"{HEAD}entities: preconfigured\nsession: {{key: 7}}\n{ALONE}")


def test_local_subscriptions_lend_nothing(tmp_path: Path) -> None:
    """Their messages of the image are no bytes in the queue of the agent's samples."""
    names = "  - name: device\n    publishers: [{{topic: near, {0}, local: {1}}}]\n"
    names += "    subscriptions: [{{topic: near, {0}, local: {2}}}, {{topic: far, {0}}}]\n"
    text = f"{HEAD}components: [+loaned_messages]\nnodes:\n"
    for ends in (("only", "also"), ("also", "only")):
        nodes = names.format("type: std_msgs/msg/String", *ends)
        (tmp_path / ends[0]).mkdir()
        part = planned(tmp_path / ends[0], text + nodes).project.runtime.features.of("loaned_messages")
        assert isinstance(part, LoansPlan)
        assert [(row.topic, bool(row.c_types)) for row in part.subscriptions] == [
            ("/near", False),
            ("/far", True),
        ]


def test_its_behavior(tmp_path: Path) -> None:
    out = rendered(tmp_path, APPLICATION)
    sources = [p for p in sorted((out / "src").rglob("*.c")) if not p.parent.name.startswith("port_posix")]
    run(program(out, sources, ["unit_local.c", "port_agent.c"], SANITIZE))


def test_two_tasks_without_an_agent(tmp_path: Path) -> None:
    """One publishes while others spin: nothing is lost, nothing races, and nobody waits for an agent."""
    out = rendered(tmp_path, f"{HEAD}components: [+multithread]\n{ALONE}")
    sources = sorted((out / "src").rglob("*.c"))
    done = subprocess.run(
        [program(out, sources, ["local_threads.c"], THREAD_SANITIZER)],
        capture_output=True,
        text=True,
        timeout=seconds(60),
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
