# SPDX-License-Identifier: Apache-2.0
"""Where the functions that the compiler has inlined at an instruction were called (DWARF 5, 3.3.8.2)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from elftools.dwarf.ranges import BaseAddressEntry

from microros_gen.image.dwarf import file_name
from microros_gen.image.elf import Elf
from microros_gen.records import dataclass


@dataclass(frozen=True)
class _Call:
    """The code of an inlined function from `begin` up to `end`, called in a line of a file."""

    begin: int
    end: int
    file: str
    line: int


class Inlined:
    """The calls of an image that have no instruction."""

    def __init__(self, image: Elf) -> None:
        """Read them; without debugging information nothing is known."""
        self._calls = sorted(_calls(image), key=lambda call: call.end - call.begin)

    def calls(self, address: int) -> tuple[tuple[str, int], ...]:
        """Return file and line of the calls that an instruction is within, the innermost one first."""
        return tuple((c.file, c.line) for c in self._calls if c.begin <= address < c.end)


def _calls(image: Elf) -> Iterator[_Call]:
    dwarf = image.dwarf
    for unit in dwarf.iter_CUs() if dwarf is not None else ():
        assert dwarf is not None
        program = dwarf.line_program_for_CU(unit)
        for die in unit.iter_DIEs() if program is not None else ():
            attributes = die.attributes
            if die.tag != "DW_TAG_inlined_subroutine" or "DW_AT_call_line" not in attributes:
                continue
            file = file_name(unit, program, attributes["DW_AT_call_file"].value)
            for begin, end in _ranges(dwarf, unit, die):
                if image.is_code(begin):
                    yield _Call(begin, end, file, attributes["DW_AT_call_line"].value)


def _ranges(dwarf: Any, unit: Any, die: Any) -> Iterator[tuple[int, int]]:
    attributes = die.attributes
    if "DW_AT_ranges" in attributes:
        top = unit.get_top_DIE().attributes
        base = top["DW_AT_low_pc"].value if "DW_AT_low_pc" in top else 0
        for entry in dwarf.range_lists().get_range_list_at_offset(attributes["DW_AT_ranges"].value, unit):
            if isinstance(entry, BaseAddressEntry):
                base = entry.base_address
            else:
                start = 0 if getattr(entry, "is_absolute", False) else base
                yield start + entry.begin_offset, start + entry.end_offset
    elif "DW_AT_low_pc" in attributes and "DW_AT_high_pc" in attributes:
        low, high = attributes["DW_AT_low_pc"].value, attributes["DW_AT_high_pc"]
        yield low, high.value if high.form == "DW_FORM_addr" else low + high.value
