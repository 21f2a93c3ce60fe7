# SPDX-License-Identifier: Apache-2.0
"""What every transport's command of the agent takes, and the configuration file; the command line wins."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import Any

import click

from microros_gen.agent.configuration.model import (
    AgentFile,
    NamedPath,
    PtyChoice,
    SerialChoice,
    TransportChoice,
)
from microros_gen.agent.configuration.parser import DISCOVERY_PORT, parse_agent_file
from microros_gen.agent.limits import Limits
from microros_gen.cli.agent.limit_options import limits_of
from microros_gen.cli.agent.types import ManifestOf
from microros_gen.cli.agent.worker_count import workers_option
from microros_gen.diagnostics import Diagnostic, Diagnostics, Source, Span, UserError
from microros_gen.documents.files import read_text
from microros_gen.records import dataclass

DEFAULTS = Limits()
MAXIMUM_DOMAIN = 232
"""Largest ROS domain id: the ports of larger ones do not exist (RTPS 2.2, 9.6.1)."""

NO_SOCKET = "none"
"""Value of --status-socket for an agent without one."""

_VERBOSITY = (-3, -2, -2, -1, 0, 1, 2)
"""Levels beyond INFO, by micro_ros_agent's: off, critical, error, warning, info, debug, trace."""


def _file_option(names: tuple[str, ...], text: str, metavar: str = "FILE") -> Callable[..., Any]:
    return click.option(
        *names,
        multiple=True,
        type=click.Path(path_type=Path),
        metavar=metavar,
        help=f"{text} Can be repeated.",
    )


_COMMON = (
    click.option(
        "-c",
        "--config",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Configuration file. Other options override it; transports replace those of the file.",
    ),
    click.option(
        "--domain",
        type=click.IntRange(0, MAXIMUM_DOMAIN),
        help="Put every client into this ROS domain. Default: the one that the client requests.",
    ),
    click.option(
        "-d",
        "--discovery",
        is_flag=True,
        help="Answer clients that search for agents in the multicast group 239.255.0.2.",
    ),
    click.option(
        "--discovery-port",
        type=click.IntRange(1, 65535),
        help=f"Port of --discovery, which this option implies. Default: {DISCOVERY_PORT}.",
    ),
    click.option(
        "--graph-server",
        is_flag=True,
        help="Also answer queries of the ROS graph, like `microros-gen graph-server`; in the domain of --domain,"
        " otherwise of ROS_DOMAIN_ID.",
    ),
    click.option(
        "--client-state",
        is_flag=True,
        help="Publish the state of the clients (connected, silent, lost messages, reconnects) on"
        " /microros_agent/client_states, and list them by service; in the domain of --domain, otherwise of"
        " ROS_DOMAIN_ID.",
    ),
    click.option(
        "--diagnostics",
        is_flag=True,
        help="Publish a status of each client on /diagnostics once a second, and when its level changes; in the domain"
        " of --domain, otherwise of ROS_DOMAIN_ID.",
    ),
    click.option(
        "--status-socket",
        metavar="PATH|none",
        help="Local socket at which `microros-gen agent status` asks this agent; none: no socket. Default:"
        " microros-agent-PID.sock in $RUNTIME_DIRECTORY, $XDG_RUNTIME_DIR/microros-gen or /tmp/microros-gen-UID.",
    ),
    click.option(
        "--metrics",
        metavar="[HOST:]PORT",
        help="Serve metrics for Prometheus at http://HOST:PORT/metrics. Default HOST: 127.0.0.1.",
    ),
    click.option(
        "--page",
        metavar="[HOST:]PORT",
        help="Serve a page that shows the clients live, for browsers. Default HOST: 127.0.0.1.",
    ),
    click.option(
        "--no-parameter-server",
        is_flag=True,
        help="Do not hold the parameters of clients whose application file says `parameters: {at: agent}`; another"
        " node does, such as `microros-gen parameter-server`.",
    ),
    click.option(
        "--parameter-file",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="File of the values of such parameters. Default: parameters-DOMAIN.json in"
        " ~/.local/state/microros-gen (XDG_STATE_HOME).",
    ),
    workers_option,
    click.option(
        "--client-timeout",
        type=click.FloatRange(min=0.1),
        metavar="SECONDS",
        help="A client that is silent for this long leaves the ROS graph, and returns with its next message. The agent"
        f" probes it before that. Default: {DEFAULTS.client_timeout_s:g}.",
    ),
    click.option(
        "--max-clients",
        type=click.IntRange(1, 65535),
        help=f"Maximum number of clients; further ones are refused. Default: {DEFAULTS.clients}.",
    ),
    click.option(
        "--limit",
        "limits",
        multiple=True,
        metavar="NAME=NUMBER",
        help="Any limit of the configuration file, such as message_bytes=65536. Can be repeated.",
    ),
    _file_option(
        ("-r", "--references", "--refs"),
        "XML profiles that clients refer to instead of describing their entities, in the format of the public agent"
        " (-r); `build` writes OUT/agent/references.xml.",
    ),
    _file_option(
        ("--entities",),
        "Entities (JSON) to create for clients that create none, when they open a session; `build` writes"
        " OUT/agent/entities.json.",
    ),
    click.option(
        "--policy",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="Policy (YAML): which clients may connect, and which topics, services and actions each may use; without"
        " it, all may use everything. SIGHUP reloads the file.",
    ),
    click.option(
        "--psk-file",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="Seal all messages with a key that each client shares with the agent, and refuse others (not over CAN FD)."
        " In each line of FILE: client key, and 64 hexadecimal digits; only its owner may read it. SIGHUP reloads the"
        " file.",
    ),
    click.option(
        "--check",
        is_flag=True,
        help="Check the files and end: status 2 if one has a fault. Needs no transport.",
    ),
    click.option(
        "--manifest",
        multiple=True,
        metavar="[KEY=]FILE",
        help="OUT/manifest.json of a client: of its nodes, or of the client with this key (0xA1B2C3D4). The agent"
        " announces its type hashes to ROS 2 and reports types that differ. Can be repeated.",
    ),
    _file_option(
        ("--interface-path",),
        "Package, folder of packages or colcon workspace with interface files, searched before the ament index, pip"
        " and the included interfaces.",
        "DIR",
    ),
    click.option(
        "--record",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="Record every message in this file (pcapng, for Wireshark and `agent replay`); an existing one is"
        " replaced.",
    ),
    click.option(
        "-v",
        "--verbose",
        count=True,
        help="-v: print a line for each message; -vv: print each message decoded and in hexadecimal.",
    ),
    click.option(
        "--verbosity",
        type=click.IntRange(0, 6),
        help="The same as a number, as micro_ros_agent's -v0 to -v6, which are understood too: 6 is -vv, 5 is -v, 4 the"
        " default, 3 warnings and errors, 1 and 2 errors, 0 nothing but the ready lines.",
    ),
    click.option(
        "--log-format",
        type=click.Choice(["text", "json"]),
        help="Readable lines, or one JSON object per line. Default: text.",
    ),
)


def common_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add them; the command gets them as keyword arguments, to be handed on to `AgentOptions.of`."""
    for option in reversed(_COMMON):
        function = option(function)
    return function


@dataclass(frozen=True)
class AgentOptions:
    """What one agent is started with."""

    transports: tuple[TransportChoice, ...] = ()
    discovery: int | None = None
    domain: int | None = None
    graph_server: bool = False
    client_state: bool = False
    diagnostics: bool = False
    status_socket: str | None = None
    metrics: NamedPath | None = None
    page: NamedPath | None = None
    parameter_server: bool = True
    parameter_file: Path | None = None
    limits: Limits = DEFAULTS
    workers: int = 1
    references: tuple[Path, ...] = ()
    entities: tuple[Path, ...] = ()
    policy: Path | None = None
    psk_file: Path | None = None
    check: bool = False
    manifests: tuple[ManifestOf, ...] = ()
    interface_paths: tuple[Path, ...] = ()
    record: Path | None = None
    log_format: str = "text"
    verbose: int = 0
    places: Mapping[Path, Span] = field(default_factory=dict, compare=False)
    """Where the configuration file names a path."""

    @property
    def watches_clients(self) -> bool:
        """Whether the agent keeps its view of clients."""
        return self.client_state or self.diagnostics

    @property
    def is_monitored(self) -> bool:
        """Whether something asks for the status of the agent."""
        return self.status_socket != NO_SOCKET or bool(self.metrics or self.page)

    @staticmethod
    def of(sections: Sequence[dict[str, Any]], transports: Iterable[TransportChoice]) -> AgentOptions:
        """Return what the command line (`sections`: the common options of each place) and the file say together.

        UserError: a file or a limit that does not hold, an option with two values, or no transport.
        """
        options = _one_each(sections)
        file, folder = _read_file(options["config"])
        chosen = tuple(transports) or tuple(_near(folder, choice) for choice in file.transports)
        if not chosen and not options["check"]:
            hint = "Name one, as `microros-gen agent udp4 --port 8888`, or a --config that does"
            raise UserError([Diagnostic("the agent has no transport", hint=hint, id="MG-9701")])
        discovery_port = options["discovery_port"] or (DISCOVERY_PORT if options["discovery"] else None)
        return AgentOptions(
            transports=chosen,
            discovery=file.discovery if discovery_port is None else discovery_port,
            domain=file.domain if options["domain"] is None else options["domain"],
            graph_server=options["graph_server"] or file.graph_server,
            client_state=options["client_state"] or file.client_state,
            diagnostics=options["diagnostics"] or file.diagnostics,
            status_socket=options["status_socket"] or _own_socket(file, folder),
            metrics=_place(options["metrics"]) or file.metrics,
            page=_place(options["page"]) or file.page,
            parameter_server=file.parameter_server and not options["no_parameter_server"],
            parameter_file=options["parameter_file"] or _own_file(file, folder),
            limits=limits_of(file, options),
            workers=options["workers"] or file.workers or 1,
            references=_paths(folder, file.references, options["references"]),
            entities=_paths(folder, file.entities, options["entities"]),
            policy=options["policy"] or (None if file.policy is None else folder / file.policy.path),
            psk_file=options["psk_file"] or (None if file.psk_file is None else folder / file.psk_file.path),
            check=options["check"],
            manifests=(
                *(ManifestOf.of(named.path, folder, named.span) for named in file.manifests),
                *(ManifestOf.of(text, Path()) for text in options["manifest"]),
            ),
            interface_paths=_paths(folder, file.interface_paths, options["interface_path"]),
            record=options["record"] or (folder / file.record.path if file.record else None),
            log_format=options["log_format"] or file.log_format or "text",
            verbose=_verbose(options, file),
            places={folder / n.path: n.span for n in _named(file) if n.span is not None},
        )


def _verbose(options: dict[str, Any], file: AgentFile) -> int:
    """Return how many levels of the log beyond INFO are shown; negative: how many fewer."""
    verbosity: int | None = options["verbosity"]
    if verbosity is None:
        return options["verbose"] or file.verbose or 0
    return _VERBOSITY[verbosity]


def _one_each(sections: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Return one value of each option: lists joined, counts added; UserError for two that differ."""
    joined = dict(sections[0])
    for place in sections[1:]:
        for name, value in place.items():
            before = joined[name]
            if value is None or value is False:
                continue
            if isinstance(value, tuple) or name == "verbose":
                joined[name] = before + value
            elif before is None or before is False or before == value:
                joined[name] = value
            else:
                option = "--" + name.replace("_", "-")
                reason = f"{option} has two values, {before} and {value}: it applies to the whole agent"
                raise UserError([Diagnostic(reason, hint="Give it once", id="MG-9702")])
    return joined


def _read_file(path: Path | None) -> tuple[AgentFile, Path]:
    if path is None:
        return AgentFile(), Path()
    diagnostics = Diagnostics()
    sources = read_sources([path], diagnostics)
    diagnostics.check()
    file = parse_agent_file(sources[0], diagnostics)
    diagnostics.check()
    return file, path.parent


def _named(file: AgentFile) -> tuple[NamedPath, ...]:
    policy = () if file.policy is None else (file.policy,)
    others = tuple(named for named in (file.record, file.psk_file) if named is not None)
    return (*file.references, *file.entities, *policy, *file.interface_paths, *others)


def read_sources(
    paths: Sequence[Path], diagnostics: Diagnostics, places: Mapping[Path, Span] | None = None
) -> list[Source]:
    """Return the texts of some files; one that cannot be read is an error, at its place where somebody named it."""
    known = places or {}
    sources = []
    for path in dict.fromkeys(paths):
        try:
            sources.append(Source(str(path), read_text(path, encoding="utf-8-sig")))
        except OSError as error:
            message = f"{path} cannot be read: {error.strerror}"
            diagnostics.error(message, known.get(path), "Name a file that this user may read", id="MG-9703")
        except UnicodeDecodeError as error:
            diagnostics.error(
                f"{path} is not UTF-8 (byte {error.start})", known.get(path), "Save it as UTF-8", id="MG-9704"
            )
    return sources


def _near(folder: Path, choice: TransportChoice) -> TransportChoice:
    if isinstance(choice, SerialChoice):
        return replace(choice, device=str(folder / choice.device))
    if isinstance(choice, PtyChoice) and choice.link:
        return replace(choice, link=str(folder / choice.link))
    return choice


def _own_file(file: AgentFile, folder: Path) -> Path | None:
    return None if file.parameter_file is None else folder / file.parameter_file


def _place(text: str | None) -> NamedPath | None:
    return None if text is None else NamedPath(text)


def _own_socket(file: AgentFile, folder: Path) -> str | None:
    named = file.status_socket
    return named if named in (None, NO_SOCKET) else str(folder / named)


def _paths(folder: Path, of_file: Sequence[NamedPath], of_options: Sequence[Path]) -> tuple[Path, ...]:
    return tuple(dict.fromkeys((*(folder / named.path for named in of_file), *of_options)))
