# SPDX-License-Identifier: Apache-2.0
"""A device and a model of rclpy with the same life cycle, side by side."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.lifecycle_peer import MODEL, LifecyclePeer, lifecycle_peer
from tests.support.e2e.relay import Relay

APPLICATION = """\
version: 1
profiles: [managed_service]
session: {connect_timeout: 20 s, create_timeout: 10 s}
nodes: [{name: device, namespace: /arm}]
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
DEVICE = "/arm/device"
BOTH = (DEVICE, MODEL)
CALLBACKS = ("configure", "activate", "deactivate", "cleanup", "shutdown", "error")
RETURNED = {"SUCCESS": 0, "FAILURE": 1, "ERROR": 99}
PATHS: dict[str, tuple[int, ...]] = {
    "unconfigured": (),
    "inactive": (1,),
    "active": (1, 3),
    "finalized": (5,),
}


class Pair:
    """The device and the model, in the same state."""

    def __init__(self, program: CommandedProgram, peer: LifecyclePeer) -> None:
        self.program, self.peer = program, peer
        for name in CALLBACKS:
            self.returns(name, "SUCCESS")
        self.begin()

    def begin(self, *path: int) -> None:
        """Let both begin again, and go a way."""
        code, error, _ = self.program.call("reset")
        assert code == 0, error
        self.peer.ask(do="reset")
        for node in BOTH:
            self.peer.await_services(node)
        for identifier in path:
            assert self.changed(identifier) == [True, True]

    def returns(self, name: str, outcome: str) -> None:
        self.program.call(f"outcome {CALLBACKS.index(name)} {RETURNED[outcome]}")
        self.peer.ask(do="outcome", name=name, value=outcome)

    def changed(self, identifier: int, label: str = "") -> list[bool | None]:
        return [self.peer.change(node, identifier, label) for node in BOTH]

    def both(self, what: str) -> Any:
        """Return what both answer alike."""
        found = [self.peer.get(node, what) for node in BOTH]
        assert found[0] == found[1], what
        return found[0]

    def both_by_api(self, identifier: int) -> bool:
        """Return whether both applications can go through the transition: the goal is the same."""
        exists, goal = self.peer.ask(do="api", id=identifier)
        code, error, _ = self.program.call(f"change {identifier}")
        assert (code, bool(error)) == ((0, False) if exists else (1, True)), identifier
        assert self.program.call("state")[2][0].split()[0] == str(goal), identifier
        return bool(exists)

    def calls(self) -> list[str]:
        """Return the callbacks that both have called since; the order is that of `CALLBACKS`."""
        _, _, (line,) = self.program.call("calls")
        counts = [int(word) for word in line.split()[1:]]
        found = [name for name, count in zip(CALLBACKS, counts, strict=True) for _ in range(count)]
        assert found == sorted(self.peer.ask(do="calls"), key=CALLBACKS.index)
        return found


def program_of(images: Images, port: Relay, folder: Path) -> Path:
    """Build the program of c/lifecycle.c."""
    image = images.build(port.port, APPLICATION)
    return image.application(C_FILES / "lifecycle.c", folder / "cycle", *STRICT)


@contextmanager
def running_pair(program: Path, domain: int) -> Iterator[Pair]:
    """Run device and model; the device must end without a fault."""
    with lifecycle_peer(domain) as peer, started(program) as process:
        yield Pair(CommandedProgram(process), peer)
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)
