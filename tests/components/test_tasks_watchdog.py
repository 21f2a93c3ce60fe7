# SPDX-License-Identifier: Apache-2.0
"""The watchdog of tasks: fed while all of them are in time, also without the agent, and not while one is stuck."""

from __future__ import annotations

import socket
import threading
from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned, program_of, rendered, run
from tests.support.runtime.reading_agent import ReadingAgent

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+executor, +timers]
session: {{key: 7, liveliness_period: 50 ms}}
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
watchdog: {{margin: {margin}}}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32{local}}}]{more}
    timers: [{{name: beat, period: 20 ms}}]
    executors: [{{name: a}}, {{name: b, handles: [beat]}}]
tasks:
  - {{name: control, executor: a, period: {period}}}
  - {{name: worker, executor: b, deadline: 3 ms}}
"""
ALONE = APPLICATION.format(
    port=8888,
    margin="2 ms",
    local=", local: only",
    more="\n    subscriptions: [{topic: count, type: std_msgs/msg/Int32, local: only}]",
    period="1 ms",
).replace("pure_sender", "pure_sender, pure_reader")


def serve(agent: ReadingAgent, served: socket.socket) -> None:
    """Answer until the device has sent some messages, then never again."""
    while len(agent.values(0)) < 5:
        datagram, peer = served.recvfrom(2048)
        for answer in agent.receive(datagram):
            served.sendto(answer, peer)


def test_it_is_fed_while_every_task_is_in_time(tmp_path: Path) -> None:
    run(program_of(rendered(tmp_path, ALONE), "task_watched.c", without=("port_posix_tasks.c",)))


def test_it_is_fed_without_the_agent_and_not_while_a_callback_is_stuck(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(ReadingAgent(), served), daemon=True).start()
        port = served.getsockname()[1]
        out = rendered(
            tmp_path, APPLICATION.format(port=port, margin="100 ms", local="", more="", period="10 ms")
        )
        run(program_of(out, "task_watchdog.c", more=("-pthread",)))


def test_a_report_says_how_often_it_is_fed(tmp_path: Path) -> None:
    found = planned(tmp_path, ALONE)
    part = found.project.runtime.features.of("tasks")
    assert getattr(part, "watch", "") == "port_watchdog_feed() at least every 4 ms"
    assert "port_watchdog_feed" in {
        name for row in found.project.provisions.of_application for name in row.capability.functions
    }


@pytest.mark.parametrize(
    ("text", "place", "identifier"),
    [
        (ALONE.partition("tasks:")[0], "6:11", "MG-3216"),
        (ALONE.replace("margin: 2 ms", "margin: 99 us"), "6:20", "MG-3217"),
        (ALONE.replace("margin: 2 ms", "margin: 61 s"), "6:20", "MG-3217"),
    ],
)
def test_mistakes_have_place_and_hint(tmp_path: Path, text: str, place: str, identifier: str) -> None:
    with pytest.raises(UserError) as error:
        planned(tmp_path, text)
    (found,) = error.value.diagnostics
    assert (found.id, found.span and f"{found.span.line}:{found.span.column}") == (identifier, place)
    assert found.hint


def test_nothing_of_it_is_in_an_image_without_the_key(tmp_path: Path) -> None:
    out = rendered(tmp_path, ALONE.replace("watchdog: {margin: 2 ms}\n", ""))
    assert not (out / "src" / "tasks" / "rclc_tasks_watch.c").exists()
    assert "WATCHDOG" not in (out / "include" / "microros_config.h").read_text()
