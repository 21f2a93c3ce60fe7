# SPDX-License-Identifier: Apache-2.0
"""Reads .action files as ROS 2 Jazzy does (rosidl_adapter): goal, result and feedback, with a line `---` between."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Source, reads
from microros_gen.interfaces.derived import ACTION_PARTS
from microros_gen.interfaces.msg.parts import parse_parts
from microros_gen.interfaces.types import Action, TypeName


@reads
def parse_action(source: Source, name: TypeName, diagnostics: Diagnostics) -> Action | None:
    """Return the action that `source` declares as type `name`, or None when it has an error.

    Every error and warning goes to `diagnostics`, with its line and columns. Fields of messages' types are
    named and not looked up.
    """
    declared = parse_parts(source, name, ACTION_PARTS, diagnostics)
    return declared if isinstance(declared, Action) else None
