# SPDX-License-Identifier: Apache-2.0
"""A board with a parameter server: its application file, what it takes, and what a parameter more takes."""

from __future__ import annotations

from dataclasses import dataclass

from tests.support.firmware.board import Builds, target
from tests.support.firmware.footprint import (
    AGENT_FUNCTIONS,
    INTERRUPTS,
    Sections,
    bounded_stack,
    image_sections,
)
from tests.support.firmware.instructions import counted_regions

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: enabled, type: bool}
      - {name: motor.steps, type: integer, default: 10, range: {min: 0, max: 120, step: 2}}
      - {name: motor.gain, type: double}
      - {name: version, type: integer, read_only: true}
"""
"""That of c/parameters.c and c/measured_parameters.c."""
ADDED = ("-DPARAMETERS_ADDED",)
"""The program adds the parameters by itself."""
_TIMES = 8
"""Of c/measured_parameters.c."""
TYPES = ("bool", "integer", "double", "string")
SIZE = "size: 16"
"""Of strings."""
MORE = 4
FOUR = """\
limits:
  rcl_interfaces/srv/DescribeParameters_Request: {names: {sequence: 4, string: 2}}
  rcl_interfaces/srv/DescribeParameters_Response: {descriptors: 4}
  rcl_interfaces/srv/GetParameterTypes_Request: {names: {sequence: 4, string: 2}}
  rcl_interfaces/srv/GetParameterTypes_Response: {types: 4}
  rcl_interfaces/srv/GetParameters_Request: {names: {sequence: 4, string: 2}}
  rcl_interfaces/srv/GetParameters_Response: {values: 4}
  rcl_interfaces/srv/ListParameters_Request: {prefixes: {sequence: 4, string: 2}}
  rcl_interfaces/msg/ListParametersResult:
    names: {sequence: 4, string: 2}
    prefixes: {sequence: 4, string: 2}
  rcl_interfaces/srv/SetParameters_Request: {parameters: 4}
  rcl_interfaces/srv/SetParameters_Response: {results: 4}
  rcl_interfaces/srv/SetParametersAtomically_Request: {parameters: 4}
  rcl_interfaces/msg/ParameterEvent: {changed_parameters: 4}
"""
"""Limits of messages that do not follow from the number of parameters."""


@dataclass(frozen=True)
class Taken:
    """Bytes of an image; `stack` is proven."""

    size: Sections
    stack: int

    @property
    def flash(self) -> int:
        """All that is written to the board."""
        return self.size.text + self.size.data


@dataclass(frozen=True)
class Work:
    """Instructions of the client alone.

    `init`: the server with its six services, publisher and four parameters, added to an executor. `get` and `set`:
    from a request that waits to its reply, with the event of the change. `get_call`, `set_call`: by the program.
    """

    init: int
    get: int
    set: int
    get_call: int
    set_call: int


def taken(builds: Builds, name: str, flags: tuple[str, ...] = (), application: str = APPLICATION) -> Taken:
    """Build the image of c/parameters.c and return what it takes."""
    built = builds.build(name, application)
    image = builds.application(built, "parameters.c", *flags)
    return Taken(image_sections(built, image), bounded_stack(built, image))


def work(builds: Builds, name: str, entities: str = "binary") -> Work:
    """Count the instructions on a board, with the agent of c/measured.h."""
    udp = f"{APPLICATION}transport: {{type: udp}}\nentities: {entities}\n"
    image = builds.application(builds.build(name, udp), "measured_parameters.c")
    empty, _, init, *others = counted_regions(target(name), image, (*AGENT_FUNCTIONS, *INTERRUPTS))
    assert len(others) == 8 * _TIMES + 1, "the program ended early"
    services, calls = others[: 4 * _TIMES], others[4 * _TIMES : -1]
    last = (services[-3], services[-1], calls[-1], calls[-3])
    return Work(init - empty, *(count - empty for count in last))


def cost(builds: Builds, name: str, kind: str, messages: bool) -> tuple[float, float]:
    """Return the flash and RAM of one more declared parameter of a type, its name of two characters.

    Every scalar is in both images, and a string where one more is added, so that none brings code with it. Without
    `messages` requests, replies and events have room for four parameters; with them for all, which is the default.
    """
    types = TYPES if kind == "string" else TYPES[:-1]
    lines = [_line(f"{other[0]}z", other) for other in types]
    more = [_line(f"{kind[0]}{i}", kind) for i in range(MORE)]
    before, after = (
        _of_types(builds, name, lines, messages),
        _of_types(builds, name, [*lines, *more], messages),
    )
    flash = after.text + after.data - before.text - before.data
    return flash / MORE, (after.ram - before.ram) / MORE


def _of_types(builds: Builds, name: str, lines: list[str], messages: bool) -> Sections:
    head, _, _ = APPLICATION.partition("      - ")
    text = "\n".join([head.rstrip(), *lines]) + "\n"
    built = builds.build(name, text + ("" if messages else FOUR))
    return image_sections(built, builds.application(built, "parameters.c"))


def _line(name: str, kind: str) -> str:
    return f"      - {{name: {name}, type: {kind}{f', {SIZE}' if kind == 'string' else ''}}}"
