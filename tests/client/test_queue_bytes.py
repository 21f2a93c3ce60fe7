# SPDX-License-Identifier: Apache-2.0
"""`queue_bytes`: what it makes of the queues, what else follows from it, and how it is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder

NODES = """\
version: 1
profiles: [pure_reader]
components: [+services]
nodes:
  - name: ear
    subscriptions:
      - {{topic: words, type: std_msgs/msg/String, queue: 8{}}}
      - {{topic: number, type: std_msgs/msg/Int32, queue: 3}}
    services: [{{name: set, type: std_srvs/srv/SetBool, queue: 5{}}}]
limits: {{"*": {{string: 1000}}}}
"""
LARGEST, REQUEST = 1008, 28
POOL = """\
version: 1
profiles: [pure_reader]
components: [+services]
interfaces: [std_msgs/msg/String, std_msgs/msg/Int32, std_srvs/srv/SetBool]
limits: {{"*": {{string: 1000}}}}
transport: {{mtu: 2000}}
pools: {{queue: 4{}}}
"""


def planned(folder: Path, text: str) -> compiler.Planned:
    config = folder / "microros.yaml"
    config.write_text(text, encoding="utf-8")
    return compiler.plan(
        compiler.resolve(compiler.read(compiler.Options(config=config, interface_paths=(shipped_folder(),))))
    )


def test_a_declared_queue_has_its_bytes(tmp_path: Path) -> None:
    runtime = planned(tmp_path, NODES.format(", queue_bytes: 1501", ", queue_bytes: 60")).project.runtime
    assert runtime.input.queues == (
        QueuePlan(8, LARGEST, 1504),
        QueuePlan(3, 4),
        QueuePlan(5, REQUEST, 60),
    ), "rounded up to four"
    assert (runtime.input.queues_size, runtime.input.queue_slots) == (1504 + 12 + 60, 16)
    assert [row.offset for row in runtime.input.queue_rows] == [0, 1504, 1516]
    assert runtime.input.queue_mode == "bytes"


def test_nothing_else_of_the_plan_knows_it(tmp_path: Path) -> None:
    """Without the key the files are there as they were; with it, others, and another plan."""
    without, shared = (planned(tmp_path, NODES.format(key, "")) for key in ("", ", queue_bytes: 2100"))
    assert "src/read/xrce_read_queue.c" in compiler.render(without)
    assert "src/read/xrce_read_bytes.c" not in compiler.render(without)
    assert "src/read/xrce_read_bytes.c" in compiler.render(shared)
    assert "src/read/xrce_read_queue.c" not in compiler.render(shared)
    assert without.project.runtime.plan_id != shared.project.runtime.plan_id
    assert without.project.streams == shared.project.streams


def test_a_sample_that_waits_alone_arrives_in_fragments(tmp_path: Path) -> None:
    """As with `queue: 1`: below two of the largest the input buffer is smaller, too."""
    sizes = [
        planned(tmp_path, NODES.format(f", queue_bytes: {size}", "")).project.streams.input_size
        for size in (LARGEST, 2 * LARGEST - 4, 2 * LARGEST)
    ]
    assert sizes[0] == sizes[1] < sizes[2]


def test_the_manifest_and_the_configuration_say_it(tmp_path: Path) -> None:
    files = compiler.render(planned(tmp_path, NODES.format(", queue_bytes: 1500", "")))
    words, number = json.loads(files["manifest.json"])["entities"]["subscriptions"]
    assert (words["queue"], words["slot_size"], words["queue_bytes"]) == (8, LARGEST, 1500)
    assert "queue_bytes" not in number


def test_a_pool_has_it_for_each_place(tmp_path: Path) -> None:
    """Kinds whose queues are smaller anyway keep them."""
    runtime = planned(tmp_path, POOL.format(", queue_bytes: 1050")).project.runtime
    assert runtime.input.queues == (
        *[QueuePlan(4, LARGEST, 1052)] * 2,
        QueuePlan(4, REQUEST),
        QueuePlan(4, 1016, 1052),
    )
    assert runtime.input.queues_size == 3 * 1052 + 4 * REQUEST


@pytest.mark.parametrize(
    ("text", "place", "words", "hint"),
    [
        (
            NODES.format(", queue_bytes: 1004", ""),
            "7:74",
            "'queue_bytes' is 1004 and the largest sample takes 1008 bytes (std_msgs/msg/String on /words)",
            "Set queue_bytes: 1008 or more, or lower its limits",
        ),
        (
            NODES.format("", ", queue_bytes: 24"),
            "9:79",
            "'queue_bytes' is 24 and the largest sample takes 28 bytes (the request of std_srvs/srv/SetBool on /set)",
            "Set queue_bytes: 28 or more, or lower its limits",
        ),
        (
            POOL.format(", queue_bytes: 1000"),
            "7:19",
            "'pools.queue_bytes' is 1000 and the largest sample takes 1008 bytes (std_msgs/msg/String)",
            "Set queue_bytes: 1008 or more, or lower its limits",
        ),
    ],
)
def test_bytes_for_less_than_one_sample_are_refused(
    tmp_path: Path, text: str, place: str, words: str, hint: str
) -> None:
    with pytest.raises(UserError) as refused:
        planned(tmp_path, text)
    first = refused.value.diagnostics[0]
    assert (f"{first.span.line}:{first.span.column}" if first.span else "", first.message, first.hint) == (
        place,
        words,
        hint,
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            NODES.format(", queue_bytes: 8064", ""),
            "'queue_bytes' has no effect: 8 of the largest samples take 8064 bytes",
        ),
        (
            POOL.format(", queue_bytes: 9000"),
            "'pools.queue_bytes' has no effect: no queue takes more than 4064 bytes",
        ),
    ],
)
def test_bytes_that_save_nothing_are_reported(tmp_path: Path, text: str, words: str) -> None:
    found = planned(tmp_path, text)
    assert found.project.runtime.input.queue_mode == "slots"
    assert words in [warning.message for warning in found.warnings]


def test_next_to_nodes_the_key_of_pools_has_no_effect(tmp_path: Path) -> None:
    found = planned(tmp_path, NODES.format("", "") + "pools: {queue_bytes: 2000}\n")
    found_warnings = [warning.message for warning in found.warnings if "has no effect" in warning.message]
    assert found_warnings == ["'pools.queue_bytes' has no effect: `nodes` decides what is created"]
    assert found.project.runtime.input.queue_mode == "slots"
