# SPDX-License-Identifier: Apache-2.0
"""The option `--record`."""

from __future__ import annotations

import time
from dataclasses import replace

from microros_gen.agent.log import EventLog
from microros_gen.agent.readiness import notify
from microros_gen.agent.recording.recorder import Recorder
from microros_gen.agent.server import Ready, Server
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.diagnostics import UserError


def open_recorder(options: AgentOptions, log: EventLog) -> Recorder | None:
    """Return the recorder that the options ask for; UserError if it cannot write."""
    if options.record is None:
        return None
    try:
        return Recorder(options.record, log)
    except UserError as error:
        span = options.places.get(options.record)
        raise UserError([replace(d, span=d.span or span) for d in error.diagnostics]) from error


def run(server: Server, recorder: Recorder | None, announce: Ready) -> bool:
    """Run `server`, which records; call it after all that may fail. Return whether the recording has begun.

    A recording replaces what its file holds, so it does not begin if the server is to end already.
    """
    has_begun = not server.stops
    if has_begun:
        if recorder is not None:
            recorder.begin()
        notify("READY=1")
    server.run(announce, time.monotonic)
    return has_begun


def end(recorder: Recorder | None, has_begun: bool) -> None:
    """End what `run` began, or leave the file as it was."""
    if recorder is None:
        return
    if has_begun:
        recorder.close()
    else:
        recorder.give_up()
