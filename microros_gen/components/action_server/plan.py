# SPDX-License-Identifier: Apache-2.0
"""The endpoints of action servers, and the memory of their goals.

Source of names, types and quality of service: rcl_action of ROS 2 Jazzy, and design.ros2.org, "Actions".
"""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.action_decl import ActionDecl
from microros_gen.application.model import Application, EndpointDecl, LimitRule, NodeDecl, Qos
from microros_gen.client.plan.declared import full_name, type_name
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.client.plan.receiving import buffers_of
from microros_gen.components.actions.plan import ActionEnds, own_limits, place_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.dds_names import dds_type
from microros_gen.interfaces.derived import ACTION_PARTS, derived_name
from microros_gen.interfaces.types import Primitive, SequenceType, TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import c_name, include_path

_CANCEL = "action_msgs/srv/CancelGoal"
_STATUS = "action_msgs/msg/GoalStatusArray"
_STATUS_QOS = Qos(durability="transient_local", depth=1)
"""rcl_action_qos_profile_status_default; the feedback has rmw_qos_profile_default."""
_NUMBERS = [("sequence", SequenceType(Primitive.INT32))]
_FIBONACCI = [[("order", Primitive.INT32)], _NUMBERS, _NUMBERS]
"""Members of goal, result and feedback of a Fibonacci action, in whichever package."""
_MOST_NUMBERS = 47
"""So many Fibonacci numbers are below 2^31."""
SERVICES = ("send_goal", "cancel_goal", "get_result")
TOPICS = ("feedback", "status")


@dataclass(frozen=True)
class GoalStorage:
    """Storage of goal requests: `name` begins its C names, and `buffers` are those that a request must not have."""

    name: str
    header: str
    buffers: tuple[str, ...]


@dataclass(frozen=True)
class ActionServer:
    """A server: `c_type` begins the C names of its type; `send_goal` and `get_result` are DDS names of service types.

    `places` in the table of declared endpoints, in the order of SERVICES and TOPICS. `storages` has one element, or
    none where a goal request has no variable size. `numbers` has one for a Fibonacci action: how many of them its
    example computes at most.
    """

    index: int
    node: int
    name: str
    package: str
    type: str
    c_type: str
    send_goal: str
    get_result: str
    places: tuple[int, ...]
    goals: int
    result_timeout_ms: int
    storages: tuple[GoalStorage, ...] = ()
    numbers: tuple[int, ...] = ()

    @property
    def binder(self) -> str:
        """Return the C function that binds a goal request to storage; NULL where it needs none."""
        return f"server_{self.index}_bind" if self.storages else "NULL"

    @property
    def turns(self) -> str:
        """Return how often the example gives feedback of a goal, as C."""
        request = f"(const {self.c_type}_SendGoal_Request *)goal->ros_goal_request"
        return f"(({request})->goal.order)" if self.numbers else "GOAL_TURNS"


@dataclass(frozen=True, kw_only=True)
class ActionServerPlan(ActionEnds):
    """`result_size`: bytes of the largest response with a result."""

    servers: tuple[ActionServer, ...]
    result_size: int

    @property
    def ends(self) -> tuple[ActionServer, ...]:
        """Return the servers."""
        return self.servers

    @property
    def storage_headers(self) -> tuple[str, ...]:
        """Return the headers of storage of goal requests, sorted."""
        return tuple(sorted({storage.header for server in self.servers for storage in server.storages}))


def endpoints(node: NodeDecl) -> Iterator[EndpointDecl]:
    """Yield the three services and two topics of each action; one of them has the handle in an executor."""
    for action in node.actions:
        types = {"send_goal": f"{action.type}_SendGoal", "cancel_goal": _CANCEL}
        for service in SERVICES:
            yield EndpointDecl(
                *("service", f"{action.name}/_action/{service}"),
                types.get(service, f"{action.type}_GetResult"),
                queue=1,
                stored=False,
                of_the_library=True,
                executed=service == SERVICES[0],
                span=action.span,
                type_span=action.type_span,
            )
        for topic, kind, qos in (
            ("feedback", f"{action.type}_FeedbackMessage", Qos()),
            ("status", _STATUS, _STATUS_QOS),
        ):
            yield EndpointDecl(
                *("publisher", f"{action.name}/_action/{topic}", kind, qos),
                stored=topic == TOPICS[0],
                of_the_library=True,
                span=action.span,
                type_span=action.type_span,
            )


def plan(context: PlanContext, diagnostics: Diagnostics) -> ActionServerPlan:
    """Return the servers in the order of the file."""
    application = context.application
    refuse_own_limits(context, "action_server", diagnostics)
    declared = [(i, node, action) for i, node in enumerate(application.nodes) for action in node.actions]
    if not declared:
        message = "the component 'action_server' has no server: no node declares an action"
        span = application.spans.get("components") or application.spans.get("profiles")
        hint = "Add to a node: `actions: [{name: fibonacci, type: example_interfaces/action/Fibonacci}]`"
        diagnostics.error(message, span, hint, id="MG-7093")
    servers = tuple(_server(context, index, *item) for index, item in enumerate(declared))
    results = (derived_name(type_name(action.type), "GetResult_Response") for _, _, action in declared)
    return ActionServerPlan(
        servers=servers,
        result_size=max((context.types[name].max_encoded_size for name in results), default=0),
    )


def _server(context: PlanContext, index: int, at: int, node: NodeDecl, action: ActionDecl) -> ActionServer:
    action_type = type_name(action.type)
    request = context.types[derived_name(action_type, "SendGoal_Request")]
    parts = [("service", part) for part in SERVICES] + [("publisher", part) for part in TOPICS]
    places = tuple(place_of(context, at, kind, f"{action.name}/_action/{part}") for kind, part in parts)
    messages = {name: plan.message for name, plan in context.types.items()}
    goal = full_name(node, EndpointDecl("service", f"{action.name}/_action/{SERVICES[0]}", action.type))
    storage = GoalStorage(
        request.storage_name(goal),
        include_path(request.files.storage),
        tuple(buffers_of(request.message, messages)),
    )
    return ActionServer(
        index=index,
        node=at,
        name=full_name(node, EndpointDecl("service", action.name, action.type)),
        package=action_type.package,
        type=action_type.name,
        c_type=c_name(action_type),
        send_goal=dds_type(derived_name(action_type, "SendGoal")),
        get_result=dds_type(derived_name(action_type, "GetResult")),
        places=places,
        goals=action.goals,
        result_timeout_ms=action.result_timeout_ms,
        storages=(storage,) if request.storage else (),
        numbers=_numbers(action_type, context),
    )


def _numbers(action: TypeName, context: PlanContext) -> tuple[int, ...]:
    """Return how many Fibonacci numbers results and feedback have room for, none where the type has no such members."""
    parts = [context.types[derived_name(action, part)].message for part in ACTION_PARTS]
    shapes = [[(field.name, field.type) for field in part.fields] for part in parts]
    if shapes != _FIBONACCI:
        return ()
    sizes = {
        part: context.types[derived_name(action, part)].max_encoded_size
        for part in ("GetResult_Response", "FeedbackMessage")
    }
    # After the status and the length, or the id of the goal and the length, of four bytes each.
    rooms = ((sizes["GetResult_Response"] - 8) // 4, (sizes["FeedbackMessage"] - 20) // 4)
    return (min(*rooms, _MOST_NUMBERS),)


def record(part: ActionServerPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "servers": [
            [s.node, s.name, s.c_type, list(s.places), s.goals, s.result_timeout_ms]
            + [[storage.name, list(storage.buffers)] for storage in s.storages]
            for s in part.servers
        ],
        "result": part.result_size,
    }


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of what is exchanged about several goals, and those that the servers declare."""
    declared = [action for node in application.nodes for action in node.actions]
    goals = max((action.goals for action in declared), default=0)
    if not goals:
        return ()
    rules = (
        LimitRule((_STATUS, "status_list"), goals, goals, single=True),
        LimitRule((f"{_CANCEL}_Response", "goals_canceling"), goals, goals, single=True),
        *own_limits(declared),
    )
    configured = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in configured)
