# SPDX-License-Identifier: Apache-2.0
"""The serial devices that a command line names, or a file does."""

from __future__ import annotations

from pathlib import Path

import click

from microros_gen.cli.agent.options import read_sources
from microros_gen.diagnostics import Diagnostics


def devices_of(named: tuple[str, ...], file: Path | None) -> tuple[str, ...]:
    """Return the devices of the command line, then those of the file, one a line; each once.

    Raises UserError if the file cannot be read, click.UsageError without any device.
    """
    diagnostics = Diagnostics()
    sources = [] if file is None else read_sources([file], diagnostics)
    diagnostics.check()
    lines = (line.strip() for source in sources for line in source.text.splitlines())
    devices = tuple(dict.fromkeys((*named, *(line for line in lines if line))))
    if not devices:
        raise click.UsageError("no serial device: give -D PATH, or -f FILE with one a line")
    return devices
