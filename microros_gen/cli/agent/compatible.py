# SPDX-License-Identifier: Apache-2.0
"""The command line of micro_ros_agent (humble to jazzy) in the words of this agent.

Most options are declared where this agent's own are. Here are those that Click cannot declare, as their value is
optional or attached (`-v6`, `-d 7400`), and those that this agent cannot do.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostic, Severity, UserError

_NUMBER = re.compile(r"\d+")
_VERBOSE = re.compile(r"(?:-v|--verbose=)(\d+)")
_DISCOVERY = re.compile(r"(?:-d|--discovery=)(\d+)")
_REFUSED = {
    "-I": "Leave it out: the agent answers each client with the identifier that it uses",
    "-P": "Leave it out: agents of one ROS domain share its topics through DDS",
    "-m": "Leave it out, or give dds: clients are in the ROS 2 graph",
}
_LONG = {"--id": "-I", "--p2p": "-P", "--middleware": "-m"}
_MIDDLEWARE = ("dds", "rtps")
"""Values of -m that this agent honors: both are DDS-RTPS on the network."""


def translated(words: Sequence[str]) -> list[str]:
    """Return the words of a command line with micro_ros_agent's ones replaced. Raises UserError for a refused one."""
    return list(_translated(_without_ros(words)))


def _translated(words: Sequence[str]) -> Iterator[str]:
    skip = False
    for word, after in zip(words, [*words[1:], ""], strict=False):
        if skip:
            skip = False
            continue
        number = after if _NUMBER.fullmatch(after) else None
        option, value = _parts(word)
        if option in _REFUSED:
            skip = not value
            _check(word, option, value or after)
        elif match := _VERBOSE.fullmatch(word):
            yield f"--verbosity={match[1]}"
        elif match := _DISCOVERY.fullmatch(word):
            yield f"--discovery-port={match[1]}"
        elif word in ("-v", "--verbose") and number:
            yield f"--verbosity={number}"
            skip = True
        elif word in ("-d", "--discovery"):
            yield f"--discovery-port={number}" if number else "--discovery"
            skip = number is not None
        else:
            yield word


def _parts(word: str) -> tuple[str, str]:
    """Return the short option of a word, and the value that is attached to it."""
    if word.startswith("--"):
        name, _, value = word.partition("=")
        return _LONG.get(name, ""), value
    return word[:2], word[2:]


def _check(word: str, short: str, value: str) -> None:
    if short == "-m" and value in _MIDDLEWARE:
        return
    shown = f"{word} {value}" if short == "-m" and value not in word else word
    raise UserError(
        [
            Diagnostic(
                f"{shown} of micro_ros_agent has no counterpart here", hint=_REFUSED[short], id="MG-9794"
            )
        ]
    )


def _without_ros(words: Sequence[str]) -> list[str]:
    """Return the words without `--ros-args … --`, which `ros2 launch` adds; a warning names them if there are any."""
    if "--ros-args" not in words:
        return list(words)
    begin = words.index("--ros-args")
    end = words.index("--", begin) if "--" in words[begin:] else len(words)
    rest = [*words[:begin], *words[end + 1 :]]
    if end == begin + 1:
        return rest
    left_out = " ".join(words[begin : min(end + 1, len(words))])
    warning = Diagnostic(
        f"{left_out} is ignored: the agent has the nodes of its clients, with their names",
        severity=Severity.WARNING,
        id="MG-9795",
    )
    echo_found(f"{warning.render()}\n")
    return rest
