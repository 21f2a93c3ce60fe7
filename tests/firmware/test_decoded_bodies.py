# SPDX-License-Identifier: Apache-2.0
"""Instructions that decoding takes on a Cortex-M4, for bodies of every kind, against the bound of the call graph.

The bound has a part for each byte of a body. So it must hold for each body with its own size.
"""

from __future__ import annotations

import random
import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import pytest

from microros_gen.records import dataclass
from tests.support.firmware.board import C_FILES, Builds
from tests.support.firmware.bounds import bounds_of, measured_calls
from tests.support.firmware.tasks import BOARD

AROUND = 12
"""Instructions of the program between the marks: the call, and the ends of the marks."""
CLOSE = 10
"""How far above the heaviest of the bodies the bound may be: each copy supposes the worst addresses, and each element
every way to refuse it."""
LARGEST = 3000
"""Bytes of a body."""
RANDOM_BODIES = 64
TYPES: Mapping[str, str] = {
    "diagnostic_msgs__msg__DiagnosticArray": "wws(bsss(ss))",
    "tf2_msgs__msg__TFMessage": "(wwssddddddd)",
    "visualization_msgs__msg__MarkerArray": "(wwsswwwddddddddddwwwwwwb(ddd)(wwww)swwss(b)(ww)sss(b)b)",
    "sensor_msgs__msg__JointState": "wws(s)(d)(d)(d)",
}
"""The members: w 4 bytes, d 8, b 1, s a string, (…) a sequence."""

APPLICATION = """\
version: 1
profiles: [pure_reader]
errors: code
nodes:
  - name: device
    subscriptions:
      - {topic: diagnostics, type: diagnostic_msgs/msg/DiagnosticArray}
      - {topic: frames, type: tf2_msgs/msg/TFMessage}
      - {topic: shapes, type: visualization_msgs/msg/MarkerArray}
      - {topic: joints, type: sensor_msgs/msg/JointState}
limits: {"*": {string: 40, sequence: 2}}
"""


@dataclass(frozen=True)
class Body:
    """What is decoded as the type of an index of TYPES. `whole`: it is a complete message."""

    type: int
    bytes: bytes
    swap: bool
    whole: bool


class Writer:
    """A message of random contents; the `elements` of each sequence, and the characters of each text, at most."""

    def __init__(self, rng: random.Random, swap: bool, elements: int, characters: int) -> None:
        self._rng, self._order, self._most = rng, ">" if swap else "<", (elements, characters)
        self.out = bytearray()

    def members(self, members: str) -> None:
        """Append the members."""
        at = 0
        while at < len(members):
            sign, at = members[at], at + 1
            if sign == "(":
                end, depth = at, 1
                while depth:
                    depth += {"(": 1, ")": -1}.get(members[end], 0)
                    end += 1
                self._sequence(members[at : end - 1])
                at = end
            elif sign == "s":
                self._text()
            else:
                self._number({"w": 4, "d": 8, "b": 1}[sign])

    def _number(self, width: int) -> None:
        self.out += bytes(-len(self.out) % width) + self._rng.randbytes(width)

    def _length(self, length: int) -> None:
        self.out += bytes(-len(self.out) % 4) + struct.pack(f"{self._order}I", length)

    def _sequence(self, members: str) -> None:
        """Append no element, as many as there may be, or any number; fewer where the body is full."""
        most = 0 if len(self.out) > LARGEST // 3 else self._most[0]
        count = self._rng.choice((0, most, self._rng.randint(0, most)))
        self._length(count)
        for _ in range(count):
            self.members(members)

    def _text(self) -> None:
        """Append an empty text without a terminator, one with it, or one of any length, perhaps without it."""
        size = self._rng.choice((0, 0, 1, self._rng.randint(1, self._most[1] + 1)))
        self._length(size)
        if size:
            last = self._rng.choice((b"\0", b"\0", b"b"))
            self.out += b"a" * (size - 1) + last


def whole_bodies(rng: random.Random) -> Iterator[Body]:
    """Yield complete messages: of no elements, few large ones, and as many empty ones as there is room for."""
    for number in range(RANDOM_BODIES):
        elements, characters = rng.choice(((2, 0), (3, 100), (5, 8), (20, 0), (63, 0)))
        index, swap = number // 2 % len(TYPES), number % 2 == 1
        writer = Writer(rng, swap, elements, characters)
        writer.members(tuple(TYPES.values())[index])
        if len(writer.out) <= LARGEST:
            yield Body(index, bytes(writer.out), swap, True)


def bodies() -> Sequence[Body]:
    """Return complete messages, each also cut off anywhere, so that a member is refused."""
    rng = random.Random(17)
    whole = [*whole_bodies(rng)]
    cut = [Body(b.type, b.bytes[: rng.randrange(len(b.bytes))], b.swap, False) for b in whole if b.bytes]
    return [*whole, *cut]


def header(found: Sequence[Body]) -> str:
    """Return decoded_bodies.h."""
    rows, content = [], bytearray()
    for body in found:
        swap, whole = (str(each).lower() for each in (body.swap, body.whole))
        rows.append(f"{{{len(content)}u, {len(body.bytes)}u, {body.type}u, {swap}, {whole}}}")
        content += body.bytes
    numbers = ",".join(map(str, content))
    return (
        "#include <stdbool.h>\n#include <stdint.h>\n"
        "typedef struct body_t { uint32_t first; uint32_t size; uint32_t type; bool swap; bool whole; } body_t;\n"
        f"static const body_t table[] = {{{','.join(rows)}}};\n"
        f"static const uint8_t bodies[] = {{{numbers}}};\n"
    )


@pytest.mark.system
def test_no_body_takes_more_instructions_than_the_call_graph_says(builds: Builds, tmp_path: Path) -> None:
    built = builds.build(BOARD, APPLICATION)
    found = bodies()
    (tmp_path / "decoded_bodies.h").write_text(header(found))
    image = built.link(C_FILES / "decoded_bodies.c", tmp_path / "bodies.elf", f"-I{tmp_path}")
    lengths = bounds_of(built, image, [f"{name}__decode" for name in TYPES])
    bounds = [lengths[f"{name}__decode"] for name in TYPES]
    assert [bound.open for bound in bounds] == [frozenset()] * len(TYPES)
    counted = measured_calls(built, image)
    assert len(counted) == len(found)
    closest = [0.0] * len(TYPES)
    for body, instructions in zip(found, counted, strict=True):
        bound = bounds[body.type].of(len(body.bytes)).count
        assert instructions <= bound + AROUND, (body, instructions, bound)
        closest[body.type] = max(closest[body.type], instructions / bound)
    assert all(each > 1 / CLOSE for each in closest), closest
