# SPDX-License-Identifier: Apache-2.0
"""What ROS 2 derives from a service or an action: messages, services and the structures that hashes are made of.

Source: the behavior of rosidl_parser (services and actions), REP-2011 (type hashes) and REP-2012 (service
events) as ROS 2 Jazzy installs them. An .srv or .action file and an .idl file of the same content give the
same result, since both come through here.
"""

from __future__ import annotations

import re

from microros_gen.diagnostics import Span
from microros_gen.interfaces.types import (
    Action,
    Declaration,
    Field,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    Service,
    TypeName,
)

EVENT_INFO = TypeName("service_msgs", "msg", "ServiceEventInfo")
"""The type of the member `info` of each service event."""

GOAL_ID = TypeName("unique_identifier_msgs", "msg", "UUID")
"""The type of the member `goal_id` of the derived messages of an action."""

TIME = TypeName("builtin_interfaces", "msg", "Time")
"""The type of the member `stamp` of the response to a goal."""

SERVICE_PARTS = ("Request", "Response")
"""The parts of an .srv file, in their order."""

ACTION_PARTS = ("Goal", "Result", "Feedback")
"""The parts of an .action file, in their order."""

_SERVICE_SUFFIX = "(?:Request|Response|Event)"
_DERIVED = {
    "srv": re.compile(rf"(?P<stem>.+?)_{_SERVICE_SUFFIX}"),
    "action": re.compile(
        rf"(?P<stem>.+?)_(?:Goal|Result|Feedback|FeedbackMessage|(?:SendGoal|GetResult)(?:_{_SERVICE_SUFFIX})?)"
    ),
}
_EVENT_BOUND = 1
_GOAL_ID_COMMENT = ("Identity of the goal, chosen by the client.",)


def derived_name(name: TypeName, suffix: str) -> TypeName:
    """Return the name that ROS 2 derives: `std_srvs/srv/SetBool` and Request → `…/SetBool_Request`."""
    return TypeName(name.package, name.kind, f"{name.name}_{suffix}")


def event_name(message: TypeName) -> TypeName:
    """Return the event of the service that a message is the request or response of: `…/srv/SetBool_Event`.

    `…/action/Fibonacci_SendGoal_Request` belongs to a service of an action.
    """
    return TypeName(message.package, message.kind, f"{message.name.rpartition('_')[0]}_Event")


def declaring_name(name: TypeName) -> TypeName:
    """Return the service or action that a type belongs to: `…/srv/SetBool_Event` → `…/srv/SetBool`.

    A message, a service and an action belong to themselves.
    """
    pattern = _DERIVED.get(name.kind)
    match = pattern.fullmatch(name.name) if pattern else None
    return TypeName(name.package, name.kind, match["stem"]) if match else name


def make_service(
    name: TypeName,
    request: Message,
    response: Message,
    comment: tuple[str, ...] = (),
    span: Span | None = None,
) -> Service:
    """Return the service of these two messages with the event that ROS 2 adds."""
    event = Message(
        derived_name(name, "Event"),
        (
            Field("info", NamedType(EVENT_INFO), comment=("What happened, when, and in which call.",)),
            Field(
                "request",
                SequenceType(NamedType(request.name), _EVENT_BOUND),
                comment=("The request, where contents are published.",),
            ),
            Field(
                "response",
                SequenceType(NamedType(response.name), _EVENT_BOUND),
                comment=("The response, where contents are published.",),
            ),
        ),
        comment=(f"A service event of {name}.",),
        span=span,
    )
    return Service(name, request, response, event, comment, span)


def make_action(
    name: TypeName,
    goal: Message,
    result: Message,
    feedback: Message,
    comment: tuple[str, ...] = (),
    span: Span | None = None,
) -> Action:
    """Return the action of these three messages with the services and the message that ROS 2 adds."""
    return Action(
        name,
        goal,
        result,
        feedback,
        send_goal=_send_goal(name, goal, span),
        get_result=_get_result(name, result, span),
        feedback_message=Message(
            derived_name(name, "FeedbackMessage"),
            (_goal_id(), Field("feedback", NamedType(feedback.name), comment=("How far the goal is.",))),
            comment=(f"What is published while a goal of {name} is executed.",),
            span=span,
        ),
        comment=comment,
        span=span,
    )


def make_declaration(
    name: TypeName, parts: tuple[Message, ...], comment: tuple[str, ...] = (), span: Span | None = None
) -> Service | Action:
    """Return the service or action (by the kind of `name`) of its parts in their order."""
    if name.kind == "srv":
        request, response = parts
        return make_service(name, request, response, comment, span)
    goal, result, feedback = parts
    return make_action(name, goal, result, feedback, comment, span)


def messages_of(declaration: Declaration) -> tuple[Message, ...]:
    """Return every message of a declaration, a message itself; a later one may use an earlier one."""
    return (declaration,) if isinstance(declaration, Message) else declaration.messages


def parts_of(declaration: Service | Action) -> tuple[tuple[str, Message], ...]:
    """Return what the file of a service or action declares: each part's name (`Request`) and its message."""
    if isinstance(declaration, Service):
        return tuple(zip(SERVICE_PARTS, (declaration.request, declaration.response), strict=True))
    messages = (declaration.goal, declaration.result, declaration.feedback)
    return tuple(zip(ACTION_PARTS, messages, strict=True))


def structures_of(declaration: Declaration) -> tuple[Message, ...]:
    """Return everything of a declaration that has a type description and a hash, described as structures.

    Beside the messages these are the service or action itself and the services of an action: ROS 2 describes
    each as a structure with one member for each of its types.
    """
    messages = messages_of(declaration)
    if isinstance(declaration, Message):
        return messages
    if isinstance(declaration, Service):
        return (*messages, _service_structure(declaration))
    services = (_service_structure(declaration.send_goal), _service_structure(declaration.get_result))
    return (*messages, *services, _action_structure(declaration))


def _send_goal(name: TypeName, goal: Message, span: Span | None) -> Service:
    service = derived_name(name, "SendGoal")
    request = Message(
        derived_name(service, "Request"),
        (_goal_id(), Field("goal", NamedType(goal.name), comment=("What is to be reached.",))),
        comment=(f"Asks the server of {name} to take a goal.",),
        span=span,
    )
    response = Message(
        derived_name(service, "Response"),
        (
            Field("accepted", Primitive.BOOL, comment=("Whether the server takes the goal.",)),
            Field("stamp", NamedType(TIME), comment=("When the goal was accepted.",)),
        ),
        comment=(f"Says whether the server of {name} takes the goal.",),
        span=span,
    )
    return make_service(service, request, response, span=span)


def _get_result(name: TypeName, result: Message, span: Span | None) -> Service:
    service = derived_name(name, "GetResult")
    request = Message(
        derived_name(service, "Request"),
        (_goal_id(),),
        comment=(f"Asks the server of {name} for a result; it answers when the goal has ended.",),
        span=span,
    )
    response = Message(
        derived_name(service, "Response"),
        (
            Field("status", Primitive.INT8, comment=("How the goal ended: action_msgs/msg/GoalStatus.",)),
            Field("result", NamedType(result.name), comment=("What was reached.",)),
        ),
        comment=(f"The result of a goal of {name}.",),
        span=span,
    )
    return make_service(service, request, response, span=span)


def _goal_id() -> Field:
    return Field("goal_id", NamedType(GOAL_ID), comment=_GOAL_ID_COMMENT)


def _service_structure(service: Service) -> Message:
    members = (
        ("request_message", service.request),
        ("response_message", service.response),
        ("event_message", service.event),
    )
    return _structure(service.name, tuple((member, message.name) for member, message in members))


def _action_structure(action: Action) -> Message:
    members = (
        ("goal", action.goal.name),
        ("result", action.result.name),
        ("feedback", action.feedback.name),
        ("send_goal_service", action.send_goal.name),
        ("get_result_service", action.get_result.name),
        ("feedback_message", action.feedback_message.name),
    )
    return _structure(action.name, members)


def _structure(name: TypeName, members: tuple[tuple[str, TypeName], ...]) -> Message:
    return Message(name, tuple(Field(member, NamedType(kind)) for member, kind in members))
