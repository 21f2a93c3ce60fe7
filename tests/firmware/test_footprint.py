# SPDX-License-Identifier: Apache-2.0
"""The footprint that was promised and the one that was reached: growth is seen in the change that causes it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from _pytest.mark import ParameterSet

from tests.support.firmware.board import Builds, need
from tests.support.firmware.ceilings import CORTEX_M4, OTHER_COMPILER, cases, compiler_of, load, measure
from tests.support.firmware.footprint import (
    LIKE_FOR_LIKE,
    Sender,
    bounded_stack,
    buffers,
    measured_stack,
    sections,
    work,
)

CEILINGS = load()


SLICE = f"{CORTEX_M4} pure_sender binary reliable code"
"""What `make system` measures."""
MORE = (
    f"{CORTEX_M4} pure_sender binary best_effort code",
    "qemu-microbit pure_sender binary reliable code",
    "qemu-riscv32-virt pure_sender binary reliable code",
)
"""What `make lint` measures besides; the long run has them all."""


def _params() -> Iterator[ParameterSet]:
    for name, sender in cases():
        label = f"{name} {sender.label}"
        others = [pytest.mark.lint if label in MORE else pytest.mark.long]
        yield pytest.param(name, sender, id=label, marks=[pytest.mark.system] if label == SLICE else others)


@pytest.mark.parametrize(("name", "sender"), list(_params()))
def test_nothing_grows_unseen(builds: Builds, name: str, sender: Sender) -> None:
    """A figure above its ceiling, or far below: then `make footprint` shall write the new one down."""
    need(name, emulator=True)
    kept = CEILINGS[name]
    same = compiler_of(name) == kept["compiler"]
    measured = measure(builds, name, sender)
    for what, ceiling in kept["senders"][sender.label].items():
        assert measured[what] <= ceiling * (1 if same else OTHER_COMPILER), f"{what} of {measured}"
        if same:
            assert measured[what] >= ceiling * 0.98, f"{what} shrank: run `make footprint`"


@pytest.mark.system
def test_the_promise_for_the_cortex_m4(builds: Builds) -> None:
    """The mission's goals for the reliable sender of Int32, `errors: code`, streams as planned."""
    need(CORTEX_M4, emulator=True)
    built = builds.build(CORTEX_M4, Sender().application)
    size, figures = sections(built), measure(builds, CORTEX_M4, Sender())
    assert size.text + size.data <= 9000
    assert size.ram <= 1500
    assert figures["ready"] <= 12000
    assert figures["publish"] <= 600
    assert work(builds, CORTEX_M4, Sender(reliability="best_effort")).publish <= 350


@pytest.mark.system
def test_the_measured_stack_is_within_the_proven_bound(builds: Builds) -> None:
    """What an image used in the emulator, against the bound over its call graph and the goal of 700 bytes."""
    need(CORTEX_M4, emulator=True)
    built = builds.build(CORTEX_M4, Sender().application)
    used = measured_stack(built)
    assert 100 < used <= min(bounded_stack(built), 700)


@pytest.mark.system
def test_with_the_buffers_of_the_existing_stack(builds: Builds) -> None:
    """MTU 512 and a history of four: at most 1,500 bytes of RAM above the buffers."""
    need(CORTEX_M4)
    built = builds.build(CORTEX_M4, LIKE_FOR_LIKE.application)
    of_buffers = buffers(built)
    assert of_buffers >= 4 * 512 + 2 * 512
    assert sections(built).ram - of_buffers <= 1500


JOINTS = """\
version: 1
profiles: [pure_sender]
errors: code
nodes: [{name: arm, publishers: [{topic: joint_states, type: sensor_msgs/msg/JointState}]}]
limits:
  sensor_msgs/msg/JointState:
    {header: {frame_id: 16}, name: {sequence: 6, string: 16}, position: 6, velocity: 6, effort: 6}
"""


@pytest.mark.system
def test_the_memory_of_a_message_is_there_once(builds: Builds) -> None:
    """A JointState of six joints bound to storage, on a reliable stream as planned: no blocks for __assign besides, and
    nothing of it in the rings of the line.
    """
    need(CORTEX_M4)
    built = builds.build(CORTEX_M4, JOINTS)
    size = sections(built)
    assert size.text + size.data <= 10_000
    assert size.ram <= 2_000
    assert not [symbol for symbol in built.symbols() if symbol.startswith("microros_pool_")]
