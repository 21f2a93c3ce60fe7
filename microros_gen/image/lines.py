# SPDX-License-Identifier: Apache-2.0
"""The line of the source that each instruction is from (DWARF 4, 6.2)."""

from __future__ import annotations

import itertools
from bisect import bisect_right
from collections.abc import Iterable, Mapping

from microros_gen.image.dwarf import file_name
from microros_gen.image.elf import Elf


class Lines:
    """The line table of an image; without one nothing is known."""

    def __init__(self, image: Elf) -> None:
        """Read it."""
        found: dict[int, tuple[int, str, int]] = {}
        for unit in image.dwarf.iter_CUs() if image.dwarf else ():
            is_kept = False
            program = image.dwarf.line_program_for_CU(unit) if image.dwarf else None
            states = [e.state for e in program.get_entries() if e.state is not None] if program else []
            names: dict[int, str] = {}
            begins = True
            for here, after in itertools.pairwise(states):
                if begins:
                    is_kept = image.is_code(here.address)
                begins = here.end_sequence
                if is_kept and not here.end_sequence and here.address < after.address:
                    if here.file not in names:
                        names[here.file] = file_name(unit, program, here.file)
                    found[here.address] = (after.address, names[here.file], here.line)
        self._begins = sorted(found)
        self._found = found

    def place(self, address: int) -> tuple[str, int] | None:
        """Return file and line of an instruction, or None where the table has none."""
        at = bisect_right(self._begins, address) - 1
        if at < 0:
            return None
        end, file, line = self._found[self._begins[at]]
        return (file, line) if address < end else None


def source_places(lines: Lines, addresses: Iterable[int]) -> Mapping[int, str]:
    """Return `file:line` of each of these addresses of code, where the line table has it."""
    found = ((address, lines.place(address)) for address in addresses)
    return {address: f"{place[0]}:{place[1]}" for address, place in found if place is not None}
