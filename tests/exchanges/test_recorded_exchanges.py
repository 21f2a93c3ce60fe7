# SPDX-License-Identifier: Apache-2.0
"""What each application of the corpus says on the wire is what was recorded: the same bytes at the same times.

`make golden` records again. A change of the runtime that does not concern the protocol leaves the files as they are.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.support.exchanges.exchange import record
from tests.support.exchanges.recorded import (
    GOLDEN,
    build_clock,
    exchange_of,
    files,
    held_exchanges,
    recorded,
)
from tests.support.patience import seconds
from tests.support.runtime.serving_agent import ServingAgent
from tests.support.slices import only


@pytest.fixture(scope="module")
def still_time(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_clock(tmp_path_factory.mktemp("clock"))


SHORT = (
    *(
        "best_effort",
        "declared",
        "discovery",
        "graph",
        "graph_topic",
        "hard_liveliness",
        "large",
        "lent_serial",
    ),
    *("logging", "parameter_client", "parameters", "parameters_held", "pool", "preconfigured", "reader"),
    *("reference", "reliable_creation", "rosout", "serial", "services", "session_states", "sleep_reader"),
    *("simulation_timers", "tcp", "threads", "timers", "types", "xml"),
)
"""Those of `make test`: each component, transport and way to create entities."""


@pytest.mark.parametrize("name", only(SHORT, recorded()))
def test_an_exchange_equals_its_recording(name: str, tmp_path: Path, still_time: Path) -> None:
    assert exchange_of(name, tmp_path, still_time) == held_exchanges()[name]


class _Unknown(ServingAgent):
    def receive(self, datagram: bytes) -> list[bytes]:
        raise LookupError(datagram.hex())


def test_an_agent_that_does_not_know_a_message_ends_the_recording(tmp_path: Path) -> None:
    """The program waited for an answer forever, and the error was never seen: so it was with TIMESTAMP."""
    ended, image = tmp_path / "ended", tmp_path / "image"
    image.write_text(
        f"#!{sys.executable}\n"
        "import os, pathlib, select\n"
        "peer = int(os.environ['EXCHANGE_FD'])\n"
        "os.write(peer, b'S 5 0e00\\n')\n"
        f"if select.select([peer], [], [], {seconds(5)})[0] and not os.read(peer, 1):\n"
        f"    pathlib.Path({str(ended)!r}).touch()\n"
    )
    image.chmod(0o755)
    with pytest.raises(LookupError, match="0e00"):
        record(image, Path(), "udp", 1000, _Unknown())
    assert ended.exists()


def test_each_recording_belongs_to_an_application() -> None:
    assert held_exchanges().keys() == set(recorded())


def test_an_exchange_of_several_applications_is_stored_once() -> None:
    stored = {path.name: path.read_text(encoding="utf-8") for path in GOLDEN.glob("*.txt")}
    assert files(held_exchanges().items()) == stored


FEW = {"local", "transforms"}
"""Of these only the session or the node is opened: messages stay in the image, or belong to no generated example."""


def test_applications_say_something() -> None:
    """Both sides speak in each recording, in a session (0x81): a recording of nothing would hold nothing."""
    for name, text in held_exchanges().items():
        assert text.count(" > 8") >= 2, name
        assert text.count(" < 81") >= (2 if name in FEW else 3), name
