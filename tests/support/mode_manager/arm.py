# SPDX-License-Identifier: Apache-2.0
"""The arm of the models: two nodes, a manager, and one that asks."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import Any

from microros_gen.mode_manager.diagnosis import TOPIC, TYPE
from microros_gen.ros.endpoints import Publisher
from microros_gen.ros.peer import Peer
from tests.support.mode_manager.processes import Asking, manager, node
from tests.support.modes.models import MODELS
from tests.support.ros.running import Running

ARM = str(MODELS / "arm.yaml")
GRIPPER = {"force": 0.5}
JOINT = {"speed": 0.1, "law": "TORQUE"}


def start(stack: ExitStack, domain: int, *arguments: str, **nodes: dict[str, Any]) -> tuple[Asking, Running]:
    """Start nodes, a manager and one that asks; wait until the manager knows the nodes."""
    for name, values in nodes.items():
        stack.enter_context(node(domain, name, **values))
    managing = stack.enter_context(manager(domain, *arguments))
    managing.wait_for("mode manager ready")
    asking = Asking(stack.enter_context(Peer("asking")))
    asking.until(lambda: all(n in asking.rows and asking.rows[n].actual != "unknown" for n in nodes))
    return asking, managing


def start_diagnosed(stack: ExitStack, domain: int, model: Path) -> tuple[Asking, Running, Publisher]:
    """Start the arm of a model file in its mode QUICK; the publisher on /diagnostics has its subscriptions."""
    asking, managing = start(stack, domain, str(model), gripper=GRIPPER, joint=JOINT)
    publisher = asking.peer.publisher(TOPIC, TYPE)
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK")
    asking.until(lambda: publisher.subscriptions() == 2)
    return asking, managing, publisher
