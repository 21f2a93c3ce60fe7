# SPDX-License-Identifier: Apache-2.0
"""The endpoints of action clients, and the memory of their goals.

Source of names, types and quality of service: rcl_action of ROS 2 Jazzy, and design.ros2.org, "Actions".
"""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.action_decl import ActionClientDecl
from microros_gen.application.model import Application, EndpointDecl, LimitRule, NodeDecl, Qos
from microros_gen.client.plan.declared import full_name, type_name
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.components.actions.plan import ActionEnds, own_limits, place_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import c_name

_CANCEL = "action_msgs/srv/CancelGoal"
SERVICES = ("send_goal", "cancel_goal", "get_result")
FEEDBACK = "feedback"


@dataclass(frozen=True)
class ActionClient:
    """A client: `c_type` begins the C names of its type; `places` in the table of declared endpoints.

    They are in the order of SERVICES, then the feedback.
    """

    index: int
    node: int
    name: str
    package: str
    type: str
    c_type: str
    places: tuple[int, ...]
    goals: int
    response_timeout_ms: int
    result_timeout_ms: int


@dataclass(frozen=True, kw_only=True)
class ActionClientPlan(ActionEnds):
    """The clients in the order of the file."""

    clients: tuple[ActionClient, ...]

    @property
    def ends(self) -> tuple[ActionClient, ...]:
        """Return the clients."""
        return self.clients


def endpoints(node: NodeDecl) -> Iterator[EndpointDecl]:
    """Yield three clients and a subscription of each action; one of them has the handle in an executor.

    As many requests of a client are under way as its queue has places.
    """
    for action in node.action_clients:
        types = {"send_goal": f"{action.type}_SendGoal", "cancel_goal": _CANCEL}
        for service in SERVICES:
            yield EndpointDecl(
                *("client", f"{action.name}/_action/{service}"),
                types.get(service, f"{action.type}_GetResult"),
                queue=action.goals,
                usual_limits=() if service == "cancel_goal" else action.limits,
                stored=service == "get_result",
                of_the_library=True,
                executed=service == SERVICES[0],
                span=action.span,
                type_span=action.type_span,
            )
        yield EndpointDecl(
            *("subscription", f"{action.name}/_action/{FEEDBACK}", f"{action.type}_FeedbackMessage", Qos()),
            queue=1,
            usual_limits=action.limits,
            of_the_library=True,
            span=action.span,
            type_span=action.type_span,
        )


def plan(context: PlanContext, diagnostics: Diagnostics) -> ActionClientPlan:
    """Return the clients in the order of the file."""
    application = context.application
    refuse_own_limits(context, "action_client", diagnostics)
    declared = [
        (i, node, action) for i, node in enumerate(application.nodes) for action in node.action_clients
    ]
    if not declared:
        message = "the component 'action_client' has no client: no node declares one"
        span = application.spans.get("components") or application.spans.get("profiles")
        hint = (
            "Add to a node: `action_clients: [{name: fibonacci, type: example_interfaces/action/Fibonacci}]`"
        )
        diagnostics.error(message, span, hint, id="MG-7094")
    return ActionClientPlan(clients=tuple(_client(context, i, *item) for i, item in enumerate(declared)))


def _client(
    context: PlanContext, index: int, at: int, node: NodeDecl, action: ActionClientDecl
) -> ActionClient:
    action_type = type_name(action.type)
    parts = [*(("client", service) for service in SERVICES), ("subscription", FEEDBACK)]
    return ActionClient(
        index=index,
        node=at,
        name=full_name(node, EndpointDecl("client", action.name, action.type)),
        package=action_type.package,
        type=action_type.name,
        c_type=c_name(action_type),
        places=tuple(place_of(context, at, kind, f"{action.name}/_action/{part}") for kind, part in parts),
        goals=action.goals,
        response_timeout_ms=action.response_timeout_ms,
        result_timeout_ms=action.result_timeout_ms,
    )


def record(part: ActionClientPlan) -> object:
    """Return what the plan id is made of."""
    return [
        [c.node, c.name, c.c_type, list(c.places), c.goals, c.response_timeout_ms, c.result_timeout_ms]
        for c in part.clients
    ]


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limit of what a server says to a cancel request, and those of clients beside a server of their type.

    The limits of other clients are those of their endpoints.
    """
    declared = [action for node in application.nodes for action in node.action_clients]
    served = {action.type for node in application.nodes for action in node.actions}
    goals = max((action.goals for action in declared), default=0)
    if not goals:
        return ()
    cancel = LimitRule((f"{_CANCEL}_Response", "goals_canceling"), goals, goals, single=True)
    configured = {rule.path for rule in application.limits}
    return tuple(
        rule
        for rule in (cancel, *own_limits(action for action in declared if action.type in served))
        if rule.path not in configured
    )
