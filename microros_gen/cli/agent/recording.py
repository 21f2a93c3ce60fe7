# SPDX-License-Identifier: Apache-2.0
"""The option `--record`."""

from __future__ import annotations

from dataclasses import replace

from microros_gen.agent.log import EventLog
from microros_gen.agent.recording.recorder import Recorder
from microros_gen.agent.server import Server
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


def begin(recorder: Recorder | None, server: Server) -> bool:
    """Begin to record, after all that may fail: it replaces what the file holds. False: `server` is to end already."""
    if server.stops:
        return False
    if recorder is not None:
        recorder.begin()
    return True


def end(recorder: Recorder | None, has_begun: bool) -> None:
    """End what `begin` began, or leave the file as it was."""
    if recorder is None:
        return
    if has_begun:
        recorder.close()
    else:
        recorder.give_up()
