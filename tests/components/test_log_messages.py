# SPDX-License-Identifier: Apache-2.0
"""rcutils_logging_format_message and arrays of characters do what librcutils of ROS 2 does (the wheels)."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.support.components.rendered import UNITS, program_of, rendered, run

APPLICATION = """\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32]
logging: callback
memory: {arena: 4096}
"""
WHEELS = Path(sys.prefix)


@pytest.mark.system
@pytest.mark.ros
def test_messages_are_formatted_as_by_librcutils(tmp_path: Path) -> None:
    source, libraries = UNITS / "log_messages.c", WHEELS / "lib"
    theirs = tmp_path / "theirs"
    include = f"-I{WHEELS / 'include' / 'rcutils'}"
    search = (f"-L{libraries}", "-lrcutils", f"-Wl,-rpath,{libraries}")
    run("gcc", "-std=gnu99", include, source, "-o", theirs, *search)
    out = rendered(tmp_path, APPLICATION)
    ours = program_of(out, source.name)
    expected = run(theirs)
    assert len(expected.splitlines()) > 40
    assert run(ours) == expected
