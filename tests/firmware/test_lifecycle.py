# SPDX-License-Identifier: Apache-2.0
"""A node with a life cycle on a board: rclpy drives it over the serial line. Its size, with all kinds of entities."""

from __future__ import annotations

import pytest

from tests.support.agent.process import agent_options
from tests.support.e2e.lifecycle_peer import MODEL, lifecycle_peer
from tests.support.firmware.board import BOARDS, Builds, board, need
from tests.support.firmware.footprint import bounded_stack, image_sections
from tests.support.firmware.lifecycle import APPLICATION, work
from tests.support.firmware.running import started
from tests.support.profile_with_diagnostics import ENTITIES
from tests.support.slices import beyond, only

NAME = "qemu-mps2-an386"
DEVICE = "/arm/device"
SIZES = {
    "qemu-microbit": (21_456, 3_676, 1_032),
    NAME: (19_068, 3_676, 1_176),
    "qemu-mps2-an505": (19_952, 3_676, 1_180),
}
"""Flash, RAM without the stack, worst stack; the goals on the Cortex-M4 are 20,000, 5,000 and 1,200."""
SIZES_OF_ENTITIES = {"xml": (20_432, 4_268), "reference": (19_476, 3_140), "preconfigured": (17_916, 3_012)}


@pytest.mark.variant  # of tests/e2e/test_lifecycle.py; test_modes.py drives a board, too
@pytest.mark.system
@pytest.mark.ros
@pytest.mark.parametrize("entities", only({"binary"}, ["binary", *SIZES_OF_ENTITIES]))
def test_rclpy_drives_it(builds: Builds, domain: int, entities: str) -> None:
    """The states, callbacks and lists are those of rclpy's node; the whole graph comes in fragments over the line."""
    need(NAME, emulator=True)
    built = builds.build(NAME, f"{APPLICATION}entities: {entities}\n")
    image = builds.application(built, "lifecycle.c")
    options = agent_options(built.out)
    assert bool(options) == (entities in ("reference", "preconfigured"))
    with (
        lifecycle_peer(domain) as peer,
        board(built, image) as running,
        started(
            *("agent", "serial", "--dev", running.device, "--domain", str(domain), *options), domain=domain
        ) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        peer.ask(do="reset")
        for node in (DEVICE, MODEL):
            peer.await_services(node)
        for what in ("available_states", "transition_graph"):
            assert peer.get(DEVICE, what) == peer.get(MODEL, what)
        for identifier, label in (
            (1, ""),
            (0, "activate"),
            (2, ""),
            (4, ""),
            (2, ""),
            (1, ""),
            (6, ""),
            (1, ""),
        ):
            transitions = [t[:2] for t in peer.get(MODEL, "available_transitions")]
            exists = any(t[1] == label if label else t[0] == identifier for t in transitions)
            assert peer.change(DEVICE, identifier, label) is exists
            if exists:
                assert peer.change(MODEL, identifier, label)
            assert peer.state(DEVICE) == peer.state(MODEL)
        report = running.words("lifecycle_report", 5)
    assert report == [4, 2, 1, 1, 1]


@pytest.mark.system
@pytest.mark.parametrize(("name", "limits"), beyond(SIZES, {"qemu-mps2-an505"}, {"qemu-microbit"}))
def test_its_size(builds: Builds, name: str, limits: tuple[int, int, int]) -> None:
    """Five services, a publisher, executor, over a serial line."""
    need(name)
    built = builds.build(name, APPLICATION)
    image = builds.application(built, "lifecycle.c")
    size = image_sections(built, image)
    found = (size.text + size.data, size.ram, bounded_stack(built, image))
    assert all(value <= limit for value, limit in zip(found, limits, strict=True)), found


@pytest.mark.system
@pytest.mark.parametrize(
    ("entities", "limits"), beyond(SIZES_OF_ENTITIES, (), {"xml", "preconfigured"}), ids=SIZES_OF_ENTITIES
)
def test_its_size_by_entities(builds: Builds, entities: str, limits: tuple[int, int]) -> None:
    need(NAME)
    built = builds.build(NAME, f"{APPLICATION}entities: {entities}\n")
    size = image_sections(built, builds.application(built, "lifecycle.c"))
    found = (size.text + size.data, size.ram)
    assert all(value <= limit for value, limit in zip(found, limits, strict=True)), found


@pytest.mark.system
def test_its_instructions(builds: Builds) -> None:
    """Of init, and from request to reply."""
    need(NAME, emulator=True)
    found = work(builds, NAME)
    assert found.init <= 11_892
    assert found.change <= 7_043
    assert found.get <= 3_197


@pytest.mark.long
@pytest.mark.parametrize("name", ["host", *BOARDS])
@pytest.mark.parametrize("entities", ENTITIES)
def test_the_profile_alone_builds(builds: Builds, name: str, entities: str) -> None:
    """Its own node has a service and a managed publisher."""
    need(name)
    built = builds.build(name, f"version: 1\nprofiles: [managed_service]\nentities: {entities}\n")
    assert built.image.is_file()
