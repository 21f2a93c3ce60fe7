# SPDX-License-Identifier: Apache-2.0
"""What ping, time and the search for agents put on the stack, as the compiler reports it: no input buffer."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.plans import EXECUTOR, changed
from tests.support.runtime.harness import components, render
from tests.support.slices import first

FILES = (
    "rmw_ping.c",
    "xrce_ping.c",
    "rmw_inquiry.c",
    "rmw_discovery.c",
    "xrce_discovery.c",
    "xrce_discovery_info.c",
    "rmw_time_sync.c",
    "xrce_time_sync.c",
)
LARGEST = 4096
SAVED = 96
"""What the compiler saves of registers, and a port's arguments."""


def frames(folder: Path, transport: str, size: int) -> dict[str, int]:
    """Return the bytes of each function's frame, for an image whose messages have `size` bytes."""
    discovers = transport in ("udp", "tcp")
    plan = changed(
        EXECUTOR, transport__kind=transport, session__has_time_sync=True, transport__has_discovery=discovers
    )
    plan = changed(
        plan,
        streams__mtu=size,
        input__size=size,
        input__reliable_slot_size=size,
        streams__best_effort_size=size,
    )
    tree = render(folder, plan, components(plan))
    for source in tree.sources:
        if source.name in FILES:
            flags = ["-std=c99", "-Os", "-fno-inline", "-fstack-usage", f"-I{tree.include}"]
            command = ["gcc", *flags, "-c", str(source), "-o", str(folder / f"{source.stem}.o")]
            subprocess.run(command, check=True)
    lines = [line.split("\t") for report in folder.glob("*.su") for line in report.read_text().splitlines()]
    return {name.rpartition(":")[2]: int(size) for name, size, _ in lines}


@pytest.mark.system
@pytest.mark.parametrize("transport", first(["tcp", "serial", "udp", "custom"], 2))
def test_no_frame_grows_with_the_largest_message(transport: str, tmp_path: Path) -> None:
    small = frames(tmp_path / "small", transport, 64)
    large = frames(tmp_path / "large", transport, LARGEST)
    assert {"rmw_uros_ping_agent", "rmw_inquiry_run", "rmw_uros_sync_session"} <= set(small)
    grown = {name for name, size in large.items() if size != small[name]}
    # A connection contains the bytes that wait to be sent, also a separate connection for a request.
    assert grown == ({"ping_place", "discovery_reaches"} if transport == "tcp" else set())
    # That nothing else receives on the stack, port_fake.c watches in test_states.py.
    reading = {"inquiry_attempt", "inquiry_run_attempts", "rmw_inquiry_run", "xrce_discovery_search"}
    assert {name: small[name] for name in reading & set(small) if small[name] > SAVED} == {}
