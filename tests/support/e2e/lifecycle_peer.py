# SPDX-License-Identifier: Apache-2.0
"""An rclpy process that drives nodes with a life cycle, and has one of rclpy as the model: /model/device.

One JSON object a line; `do` is the name of a method of `_Peer`. The answer of a call is the response, null without one
in time.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.line_process import LineProcess, serving
from tests.support.patience import deadline, seconds

MODEL = "/model/device"
WHATS = ("state", "available_states", "available_transitions", "transition_graph")


class LifecyclePeer(LineProcess):
    """The test's side."""

    def change(self, node: str, identifier: int, label: str = "") -> bool | None:
        answer = self.ask(do="change", node=node, id=identifier, label=label, timeout=seconds(30))
        return None if answer is None else bool(answer)

    def get(self, node: str, what: str) -> Any:
        return self.ask(do="get", node=node, what=what, timeout=seconds(30))

    def state(self, node: str) -> Any:
        return self.get(node, "state")

    def await_services(self, node: str) -> None:
        """Ask until each service answers: what goes to one that was just made, or to its predecessor, is lost."""
        end = deadline(60)
        label = "no_transition"
        commands: tuple[dict[str, Any], ...] = (
            {"do": "change", "node": node, "id": 0, "label": label},
            *({"do": "get", "node": node, "what": what} for what in WHATS),
        )
        for command in commands:
            while self.ask(**command, timeout=seconds(1)) is None:
                assert time.monotonic() < end, command


@contextmanager
def lifecycle_peer(domain: int) -> Iterator[LifecyclePeer]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.lifecycle_peer", domain) as process:
        yield LifecyclePeer(process)


def _state(state: Any) -> list[Any]:
    return [state.id, state.label]


def _kinds() -> dict[str, Any]:
    from lifecycle_msgs import srv

    transitions = srv.GetAvailableTransitions
    return dict(zip(WHATS, (srv.GetState, srv.GetAvailableStates, transitions, transitions), strict=True))


def _content(what: str, response: Any) -> Any:
    if what == "state":
        return _state(response.current_state)
    if what == "available_states":
        return [_state(state) for state in response.available_states]
    return [
        [*_state(t.transition), *_state(t.start_state), *_state(t.goal_state)]
        for t in response.available_transitions
    ]


_PATHS: tuple[list[int], ...] = (
    *([], [1], [1, 10], [1, 10, 2], [1, 10, 3], [1, 10, 3, 30], [1, 10, 3, 30, 4]),
    *([5], [5, 50], [1, 12]),
)
"""Transitions by id: to each state that a machine can be in."""


class _Peer:
    """The peer's side: a node that asks, and the model, which is made again by `reset`."""

    def __init__(self, executor: Any) -> None:
        import rclpy

        self._executor = executor
        self._asker = rclpy.create_node("asker")
        executor.add_node(self._asker)
        self._clients: dict[str, Any] = {}
        self._events: list[Any] = []
        self._watched: list[Any] = []
        self._model: Any = None
        self._outcomes: dict[str, str] = {}
        self._calls: list[str] = []
        self._inside: dict[str, Any] = {}
        self._seen: list[Any] = []
        self._released = threading.Event()
        self._responses: dict[str, Any] = {}
        self._turn = threading.Lock()

    def spin(self) -> None:
        """Run callbacks; nodes come and go between two turns."""
        while True:
            with self._turn:
                self._executor.spin_once(timeout_sec=0.02)
            time.sleep(0.001)

    def reset(self) -> bool:
        """Make a model in its first state."""
        with self._turn:
            if self._model is not None:
                self._executor.remove_node(self._model)
                self._model.destroy_node()
            self._model = self._new_model()
            self._executor.add_node(self._model)
        return True

    def _new_model(self) -> Any:
        from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

        peer = self

        def callback(name: str) -> Any:
            def run(_node: Any, _state: Any) -> Any:
                peer._calls.append(name)
                if name in peer._inside:
                    peer._inside.pop(name)()
                return getattr(TransitionCallbackReturn, peer._outcomes.get(name, "SUCCESS"))

            return run

        names = ("configure", "activate", "deactivate", "cleanup", "shutdown", "error")
        model = type("Model", (LifecycleNode,), {f"on_{name}": callback(name) for name in names})
        return model("device", namespace="/model")

    def outcome(self, name: str, value: str) -> bool:
        """Set what a callback of the model returns."""
        self._outcomes[name] = value
        return True

    def calls(self) -> list[str]:
        """Return the callbacks of the model that were called."""
        found, self._calls = self._calls, []
        return found

    def api(self, id: int) -> list[Any]:
        """Let the model change its state by itself; return whether the transition exists, and the state."""
        from rclpy.impl.implementation_singleton import rclpy_implementation

        try:
            self._model._LifecycleNodeMixin__change_state(id)
        except rclpy_implementation.RCLError:
            return [False, self._model._state_machine.current_state[0]]
        return [True, self._model._state_machine.current_state[0]]

    def change_inside(self, name: str, ids: list[int]) -> bool:
        """Let the next call of a callback change the state by each id; `seen` has id, whether it moved, and state."""
        self._inside[name] = lambda: self._change_inside(ids)
        return True

    def _change_inside(self, ids: list[int]) -> None:
        for identifier in ids:
            before = self._model._state_machine.current_state
            self.api(identifier)
            after = self._model._state_machine.current_state
            self._seen.append([identifier, after != before, after[0]])

    def ask_inside(self, name: str, changes: list[list[Any]]) -> bool:
        """Let the next call of a callback ask the node's own services, as another thread's request would.

        `seen` has the four lists, and for each change, id and label, `success` (false where it raises) and the state.
        """
        self._inside[name] = lambda: self._ask_inside(changes)
        return True

    def _ask_inside(self, changes: list[list[Any]]) -> None:
        from lifecycle_msgs.msg import Transition
        from lifecycle_msgs.srv import ChangeState
        from rclpy.impl.implementation_singleton import rclpy_implementation

        for what, kind in _kinds().items():
            answer = getattr(self._model, f"_LifecycleNodeMixin__on_get_{what}")
            self._seen.append(_content(what, answer(kind.Request(), kind.Response())))
        for identifier, label in changes:
            request = ChangeState.Request(transition=Transition(id=identifier, label=label))
            try:
                answer = self._model._LifecycleNodeMixin__on_change_state(request, ChangeState.Response())
                success = bool(answer.success)
            except rclpy_implementation.RCLError:
                success = False
            self._seen.append([success, self._model._state_machine.current_state[0]])

    def wait_inside(self, name: str) -> bool:
        """Let the next call of a callback wait for `release`, while its executor does nothing else."""
        self._released.clear()
        self._inside[name] = lambda: self._released.wait(seconds(60))
        return True

    def release(self) -> bool:
        self._released.set()
        return True

    def seen(self) -> list[Any]:
        """Return what callbacks have seen since the last call."""
        found, self._seen = self._seen, []
        return found

    def table(self, labels: list[str]) -> list[Any]:
        """Let a machine of librcl_lifecycle go from each state by each id, and by each label: what exists.

        Each is state, id or label, and goal.
        """
        from rclpy.impl.implementation_singleton import rclpy_implementation

        def machine_in(path: list[int]) -> Any:
            machine = rclpy_implementation.LifecycleStateMachine(self._model.handle, False)
            for step in path:
                machine.trigger_transition_by_id(step, False)
            return machine

        found: list[Any] = []
        for path in _PATHS:
            machine = machine_in(path)
            start = machine.current_state[1]
            for trigger in (*range(256), *labels):
                by = "label" if isinstance(trigger, str) else "id"
                try:
                    getattr(machine, f"trigger_transition_by_{by}")(trigger, False)
                except rclpy_implementation.RCLError:
                    continue
                found.append([start, trigger, machine.current_state[1]])
                machine = machine_in(path)
        return found

    def state_of_machine(self) -> list[Any]:
        return list(self._model._state_machine.current_state)

    def graph_of_machine(self) -> list[Any]:
        """Return the transitions of librcl_lifecycle."""
        return [list(transition) for transition in self._model._state_machine.transition_graph]

    def watch(self, node: str) -> bool:
        """Keep events of a node."""
        from lifecycle_msgs.msg import TransitionEvent

        topic = f"{node}/transition_event"
        self._watched.append(
            self._asker.create_subscription(
                TransitionEvent, topic, lambda event: self._keep(node, event), 100
            )
        )
        return True

    def _keep(self, node: str, event: Any) -> None:
        transition = [event.timestamp, event.transition.id, event.transition.label]
        self._events.append([node, transition, _state(event.start_state), _state(event.goal_state)])

    def matched(self, node: str) -> int:
        return int(self._asker.count_publishers(f"{node}/transition_event"))

    def events(self) -> list[Any]:
        """Return the events since the last call."""
        found, self._events = self._events, []
        return found

    def services(self, node: str) -> list[Any]:
        """Return the services of a node for its life cycle, with their types."""
        namespace, _, name = node.rpartition("/")
        end = deadline(20)
        while (
            name,
            namespace or "/",
        ) not in self._asker.get_node_names_and_namespaces():  # names arrive late
            assert time.monotonic() < end
            time.sleep(0.05)
        found = self._asker.get_service_names_and_types_by_node(name, namespace)
        return sorted([s, t] for s, t in found if t[0].startswith("lifecycle_msgs"))

    def change(self, node: str, id: int, label: str, timeout: float) -> bool | None:
        from lifecycle_msgs.msg import Transition
        from lifecycle_msgs.srv import ChangeState

        request = ChangeState.Request(transition=Transition(id=id, label=label))
        response = self._call(ChangeState, f"{node}/change_state", request, timeout)
        return None if response is None else bool(response.success)

    def get(self, node: str, what: str, timeout: float) -> Any:
        kind = _kinds()[what]
        response = self._call(kind, f"{node}/get_{what}", kind.Request(), timeout)
        return None if response is None else _content(what, response)

    def begin_change(self, node: str, id: int, label: str = "") -> bool:
        """Request a change without waiting for its response: `changed`."""
        from lifecycle_msgs.msg import Transition
        from lifecycle_msgs.srv import ChangeState

        client = self._client(ChangeState, f"{node}/change_state")
        request = ChangeState.Request(transition=Transition(id=id, label=label))
        self._responses.setdefault(node, []).append(client.call_async(request))
        return True

    def changed(self, node: str) -> list[bool | None]:
        """Return `success` of the changes that were begun; None: no response yet."""
        futures = self._responses.get(node, [])
        return [bool(future.result().success) if future.done() else None for future in futures]

    def switch(self, service: str, value: bool, timeout: float) -> bool | None:
        """Call a std_srvs/srv/SetBool; return whether a response came."""
        from std_srvs.srv import SetBool

        return self._call(SetBool, service, SetBool.Request(data=value), timeout) is not None

    def _client(self, kind: Any, name: str) -> Any:
        if name not in self._clients:
            self._clients[name] = self._asker.create_client(kind, name)
        return self._clients[name]

    def _call(self, kind: Any, name: str, request: Any, timeout: float) -> Any:
        client = self._client(kind, name)
        if not client.wait_for_service(timeout):
            return None
        done = threading.Event()
        future = client.call_async(request)
        future.add_done_callback(lambda _: done.set())
        return future.result() if done.wait(timeout) else None


def main() -> None:
    """Serve commands from stdin; callbacks run in a thread."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    executor = SingleThreadedExecutor()
    peer = _Peer(executor)
    threading.Thread(target=peer.spin, daemon=True).start()
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(peer, command.pop("do"))(**command)), flush=True)


if __name__ == "__main__":
    main()
