# SPDX-License-Identifier: Apache-2.0
"""tests/runtime/c/client_parameters.c for an application file."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from tests.support.runtime.harness import build
from tests.support.runtime.surface import write_application

IDENTITY_SIZE = 24
WRAP_MS = 256
"""port_fake.c begins so long before the milliseconds wrap."""
STEP_MS = 20


@dataclass(frozen=True)
class Program:
    """The program of an application, and the largest message that it takes."""

    path: Path
    input_size: int


def program_of(folder: Path, text: str, source: str = "client_parameters.c") -> Program:
    tree = write_application(folder, text)
    path = build(tree.without_port("port_posix_storage.c"), ["port_fake.c", source], "parameters")
    config = (tree.include / "microros_config.h").read_text()
    (size,) = re.findall(r"MICROROS_INPUT_SIZE (\d+)u", config)
    return Program(path, int(size))


def is_acknowledgement(datagram: bytes) -> bool:
    return datagram[4] == 0x0A and datagram[-1] == 0x80
