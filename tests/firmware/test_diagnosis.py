# SPDX-License-Identifier: Apache-2.0
"""What a board reports of itself over its serial line, compared with its memory."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.diagnosis import APPLICATION
from tests.support.firmware.footprint import bounded_stack, image_sections, touched_stack
from tests.support.firmware.running import started
from tests.support.patience import deadline
from tests.support.slices import first

NAME = "qemu-mps2-an386"
DONE = 1
"""The state of the program once its node and timer are there."""
USED = 3000
"""Bytes of the stack that the program uses after some seconds."""


def statuses(
    observer: Observer, name: str, seen: Callable[[dict[str, str], dict[str, Any]], object]
) -> dict[str, Any]:
    end = deadline(60)
    while True:
        for topic, array in observer.ask(do="samples"):
            for status in array["status"] if topic == "/diagnostics" else ():
                values = {pair["key"]: pair["value"] for pair in status["values"]}
                if status["name"] == f"arm/device: {name}" and seen(values, status):
                    return {**status, "values": values}
        assert time.monotonic() < end, name
        time.sleep(0.02)


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.parametrize("name", first([NAME, "qemu-riscv32-virt"]))
def test_the_stack_is_what_the_memory_says(
    builds: Builds, domain: int, observer: Observer, name: str
) -> None:
    """The paint of the stack is looked at from outside; the share of the processor is that of a board that waits."""
    need(name, emulator=True)
    built = builds.merged(name, APPLICATION)
    image = builds.application(built, "diagnosis.c")
    observer.subscribe("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
    with (
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        # A program that finds no agent in time ends, and nothing would be reported.
        running.wait_for(lambda: running.words("diagnosis_report", 1)[0] != 0, 120)
        assert running.words("diagnosis_report", 1) == [DONE]
        before = statuses(observer, "stack", lambda values, status: int(values["peak"]) > 0)
        heat = statuses(observer, "heat", lambda values, status: True)
        executor = statuses(observer, "executor", lambda values, status: values["cpu_percent"] != "unknown")
        reset = statuses(observer, "reset", lambda values, status: True)
        tick = statuses(observer, "callback tick", lambda values, status: int(values["runs"]) > 0)
        running.wait_for(lambda: running.words("diagnosis_report", 2)[1] > 200, 60)
        # `before` may already be after: the emulator does not wait for this process.
        after = statuses(  # the percentage is that of the start of a report, the rows that of its message
            observer,
            "stack",
            lambda values, status: int(values["peak"]) > USED and int(values["used_percent"]) > USED // 100,
        )
        touched = touched_stack(running, built, image)
        symbols = built.symbols(image)
    assert int(after["values"]["size"]) == symbols["port_stack_high"] - symbols["port_stack_low"]
    assert 0 <= touched - int(after["values"]["peak"]) <= 64, "an interrupt may have used more since"
    assert USED <= int(after["values"]["peak"]) <= USED + int(before["values"]["peak"])
    percent = int(after["values"]["used_percent"])
    assert abs(percent - 100 * int(after["values"]["peak"]) // int(after["values"]["size"])) <= 1
    assert after["level"] == (1 if percent > 35 else 0)
    assert heat["values"] == {"value": "-40", "error": "80"}
    assert int(executor["values"]["cpu_percent"]) <= 100
    assert int(executor["values"]["rounds"]) > 0
    assert reset["values"] == {"cause": "unknown"}
    times = {key: int(value) for key, value in tick["values"].items()}
    assert times.keys() == {"runs", "last_us", "longest_us", "overruns"}
    assert times["last_us"] <= times["longest_us"]


@pytest.mark.system
def test_what_an_image_with_diagnosis_takes(builds: Builds) -> None:
    """Ceilings on the Cortex-M4: executor, timer, a check and a measured callback; figures.md has all processors."""
    need(NAME)
    built = builds.build(NAME, APPLICATION)
    image = builds.application(built, "diagnosis.c")
    size = image_sections(built, image)
    assert size.text + size.data <= 14_700
    assert size.ram <= 2_500
    assert bounded_stack(built, image) <= 3_700, "3,000 bytes of it are those of use_stack"
