# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent status`: asks a running agent."""

from __future__ import annotations

import json
import os
import pwd
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from microros_gen.agent.log import printable
from microros_gen.cli.options import format_option, json_text
from microros_gen.cli.ros_tools import until_interrupted
from microros_gen.diagnostics import Diagnostic, UserError

_CLEAR = "\x1b[2J\x1b[H"
_PERIOD_S = 1.0
"""Seconds between two questions of --watch: the agent measures rates once a second."""


@click.command()
@click.option(
    "--socket",
    "path",
    type=click.Path(path_type=Path),
    metavar="PATH",
    help="Socket of the agent, as its --status-socket. Default: that of the only agent that runs.",
)
@click.option("--pid", type=click.IntRange(1), metavar="N", help="Ask the agent with this process number.")
@click.option(
    "--watch",
    is_flag=True,
    help="Ask once a second: the table is replaced in a terminal; JSON is one line per answer.",
)
@click.option(
    "--check",
    is_flag=True,
    help="Print `ok`, or the transports and workers that are not ready, and say the same by the exit status.",
)
@format_option
@click.pass_context
def status_command(
    ctx: click.Context, path: Path | None, pid: int | None, watch: bool, check: bool, kind: str
) -> None:
    """Show the clients of a running agent: transport, round trip, traffic, losses, reconnects, last warning.

    Needs no ROS 2. Asks at the local socket of the agent, which only the user of the agent may use.

    \b
    microros-gen agent status
    microros-gen agent status --watch
    microros-gen agent status --format json
    microros-gen agent status --check

    Exit status 1: with --check, a transport or a worker is not ready, for example a serial device that is unplugged.
    2: no agent runs, several run and none is chosen, or the agent does not answer. SIGINT and SIGTERM end --watch with
    status 0.
    """
    if path is not None and pid is not None:
        raise click.UsageError("give --socket or --pid, not both", ctx)
    if check and watch:
        raise click.UsageError("give --check or --watch, not both", ctx)
    place = path or _socket_of(pid)
    if check:
        late = _not_ready(_asked(place))
        click.echo("\n".join(late) or "ok")
        ctx.exit(1 if late else 0)
    if not watch:
        click.echo(_shown(_asked(place), kind, once=True), nl=False)
        ctx.exit(0)
    _watch(place, kind)
    ctx.exit(0)


def _watch(place: Path, kind: str) -> None:
    clear = _CLEAR if sys.stdout.isatty() and kind != "json" else ""
    end = "" if kind == "json" or clear else "\n"
    with until_interrupted() as interrupted:
        while not interrupted:
            click.echo(f"{clear}{_shown(_asked(place), kind, once=False)}{end}", nl=False)
            interrupted.wait(_PERIOD_S)


def _not_ready(document: dict[str, Any]) -> list[str]:
    """Return a line for each transport that accepts no messages, and each worker that does not serve."""
    agent = document["agent"]
    names = [f"{each['kind']} {each['address']}" for each in agent["transports"] if not each["ready"]]
    names += [f"worker {each['number']}" for each in agent["workers"] if not each["ready"]]
    return [printable(f"{name} is not ready") for name in names]


def _shown(document: dict[str, Any], kind: str, once: bool) -> str:
    from microros_gen.cli.agent.status_table import status_table

    if kind == "json":
        return json_text(document) if once else json.dumps(document) + "\n"
    return "".join(f"{printable(line)}\n" for line in status_table(document).splitlines())


def _asked(place: Path) -> dict[str, Any]:
    """Return the status of the agent at a socket. Raises UserError."""
    from microros_gen.agent.monitoring.asking import NoAnswerError, ask_status
    from microros_gen.agent.monitoring.document import PATH, VERSION

    try:
        document = ask_status(place, PATH)
    except PermissionError as error:
        raise _of_another_user(place) from error
    except NoAnswerError as error:
        message = f"the agent at {place} does not answer: {error}"
        hint = "Look into the log of the agent"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9786")]) from error
    except OSError as error:
        reason = error.strerror or str(error)
        message = f"no agent listens at {place}: {reason}"
        hint = "Start one: microros-gen agent udp4"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9787")]) from error
    if document["version"] != VERSION:
        message = f"the agent at {place} speaks version {document['version']} of the protocol, not {VERSION}"
        raise UserError([Diagnostic(message, hint="Use the microros-gen of the agent", id="MG-9789")])
    return document


def _socket_of(pid: int | None) -> Path:
    """Return the socket of the agent with a process number, or of the only one. Raises UserError."""
    from microros_gen.agent.monitoring.sockets import known_sockets, pid_of

    known = known_sockets(pid=pid)
    own = [path for path in known if os.access(path, os.R_OK | os.W_OK)]
    if len(own) == 1:
        return own[0]
    if own:
        found = ", ".join(str(pid_of(path)) for path in own)
        message = f"several agents run: {found}"
        hint = f"Choose one: --pid {pid_of(own[0])}"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9784")])
    if known:
        raise _of_another_user(known[0])
    if pid is not None:
        hint = "Without --pid, the only agent that runs is asked"
        raise UserError(
            [Diagnostic(f"process {pid} is no agent with a status socket", hint=hint, id="MG-9785")]
        )
    hint = "Start one: microros-gen agent udp4; or give --socket, if its --status-socket has another name"
    raise UserError([Diagnostic("no agent with a status socket runs", hint=hint, id="MG-9783")])


def _of_another_user(place: Path) -> UserError:
    from microros_gen.agent.monitoring.sockets import pid_of

    owner = _owner_of(_places(place, pid_of(place)))
    hint = f"sudo -u {owner or 'USER'} microros-gen agent status --socket {place}"
    message = f"the agent at {place} belongs to {f'user {owner}' if owner else 'another user'}"
    return UserError([Diagnostic(message, hint=hint, id="MG-9790")])


def _places(place: Path, pid: int) -> list[Path]:
    return [place, *([Path("/proc") / str(pid)] if pid else [])]


def _owner_of(places: Sequence[Path]) -> str:
    """Return the name of the user to whom the first file belongs that can be seen; empty: none."""
    for path in places:
        try:
            number = path.stat().st_uid
        except OSError:
            continue
        try:
            return pwd.getpwuid(number).pw_name
        except KeyError:
            return f"#{number}"
    return ""
