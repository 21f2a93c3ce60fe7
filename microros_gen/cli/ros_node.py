# SPDX-License-Identifier: Apache-2.0
"""ROS nodes of commands."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.ros.errors import RosUnusableError
from microros_gen.ros.peer import Peer


def node_of(
    name: str,
    domain: int | None,
    refused: Callable[[RosUnusableError], Diagnostic],
    interface_paths: Iterable[Path] = (),
) -> Peer:
    """Return a node; `domain` None: ROS_DOMAIN_ID.

    Raises UserError with what `refused` says without a usable ROS 2.
    """
    try:
        return Peer(name, domain=domain, interface_paths=interface_paths)
    except RosUnusableError as error:
        raise UserError([refused(error)]) from error
