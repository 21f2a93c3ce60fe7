# SPDX-License-Identifier: Apache-2.0
"""Encode and decode against Fast CDR of the wheels, by instructions, which repeat exactly: what `make bench` prints."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.bench import codec

pytestmark = [pytest.mark.ros, pytest.mark.builds, pytest.mark.system]

# The goals of verification/figures.md: a third where all after the header's string has a fixed layout, else not more.
MOST = {"Int32": 1 / 3, "Imu": 1 / 3, "TwistStamped": 1 / 3}


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The program of each side."""
    for needed in ("valgrind", "cc", "c++"):
        if shutil.which(needed) is None:
            pytest.skip(f"{needed} is not installed")
    work = tmp_path_factory.mktemp("codec")
    here, peer = codec.build_here(work), codec.build_fast_cdr(work)
    if peer is None:
        pytest.skip("the ROS 2 wheels are not installed")
    return here, peer


TELLING = ("Imu", "JointState", "PointCloud2")
"""Messages that `make check` counts the instructions of: plain fields, sequences of several types, many bytes."""


@pytest.mark.parametrize("message", codec.MESSAGES, ids=lambda message: message.name)
def test_both_write_the_same(programs: tuple[Path, Path], message: codec.Message) -> None:
    """The comparison is of the same bytes, and each side reads them back."""
    assert codec.first_line(programs[0], message) == codec.first_line(programs[1], message)


@pytest.mark.parametrize("call", ["codec_encode", "codec_decode"])
@pytest.mark.parametrize(
    "message",
    [
        pytest.param(message, marks=() if message.name in TELLING else pytest.mark.variant)
        for message in codec.MESSAGES
    ],
    ids=lambda message: message.name,
)
def test_fewer_instructions_than_the_peers(
    programs: tuple[Path, Path], message: codec.Message, call: str, tmp_path: Path
) -> None:
    calls = 50
    here, peer = (codec.collected(program, message, call, calls, tmp_path) for program in programs)
    assert here <= peer * MOST.get(message.name, 1.0)
    if message.micro_cdr:
        assert here <= (calls + 2) * message.micro_cdr[call == "codec_decode"]
