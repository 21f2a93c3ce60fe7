# SPDX-License-Identifier: Apache-2.0
"""Which templates of types and of the example the selection of a component brings, besides the component's own."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

PRINTED_WITH = {
    "cdr_decode": ("types/decode.h.j2", "types/decode.c.j2", "types/storage.h.j2", "types/storage.c.j2"),
    "executor": ("example/services.c.j2", "example/running.c.j2"),
    "micro_ros_utilities": ("types/members.c.j2", "types/tables.h.j2", "types/tables.c.j2"),
}
"""Component → templates that few projects print without it."""


def printed_with(components: Iterable[str]) -> Iterator[str]:
    """Yield the templates for a project with these components."""
    for name in components:
        yield from PRINTED_WITH.get(name, ())
