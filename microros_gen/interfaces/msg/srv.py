# SPDX-License-Identifier: Apache-2.0
"""Reads .srv files as ROS 2 Jazzy does (rosidl_adapter): request and response, with a line `---` between."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Source, reads
from microros_gen.interfaces.derived import SERVICE_PARTS
from microros_gen.interfaces.msg.parts import parse_parts
from microros_gen.interfaces.types import Service, TypeName


@reads
def parse_srv(source: Source, name: TypeName, diagnostics: Diagnostics) -> Service | None:
    """Return the service that `source` declares as type `name`, or None when it has an error.

    Every error and warning goes to `diagnostics`, with its line and columns. Fields of messages' types are
    named and not looked up.
    """
    declared = parse_parts(source, name, SERVICE_PARTS, diagnostics)
    return declared if isinstance(declared, Service) else None
