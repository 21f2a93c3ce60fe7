# SPDX-License-Identifier: Apache-2.0
"""What the orchestration asks of parts, and what it publishes: plain data, without ROS."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from enum import Enum

from microros_gen.modes.model import STATES, Scalar, Status
from microros_gen.records import dataclass

STATE_IDS = dict(zip(STATES, (0, 1, 2, 3, 4, 10, 11, 12, 13, 14, 15), strict=True))
"""Numbers of lifecycle_msgs/msg/State."""
STATES_BY_ID = {number: state for state, number in STATE_IDS.items()}
CONFIGURE, CLEANUP, ACTIVATE, DEACTIVATE = 1, 2, 3, 4
TRANSITIONS = {"configure": CONFIGURE, "cleanup": CLEANUP, "activate": ACTIVATE, "deactivate": DEACTIVATE}
"""Numbers of lifecycle_msgs/msg/Transition."""

Values = Mapping[str, Scalar | tuple[Scalar, ...] | None]


class Link(Enum):
    """How a part is reached. ABSENT: it is not there, or not known yet."""

    ABSENT = "absent"
    PARAMETERS = "a life cycle, and modes by parameters"
    MODES = "a life cycle and mode services"
    PLAIN = "no life cycle, and modes by parameters"
    SYSTEM = "a system of another manager"


class Kind(Enum):
    """The service that is called."""

    GET_STATE = "get_state"
    GET_MODE = "get_mode"
    GET_PARAMETERS = "get_parameters"
    CHANGE_STATE = "change_state"
    CHANGE_MODE = "change_mode"
    SET_PARAMETERS = "set_parameters_atomically"


COMMANDS = (Kind.CHANGE_STATE, Kind.CHANGE_MODE, Kind.SET_PARAMETERS)


@dataclass(frozen=True)
class Call:
    """One request to a part. `number` is never used again. The other members depend on `kind`."""

    number: int
    part: str
    kind: Kind
    transition: int = 0
    mode: str = ""
    values: Values = field(default_factory=dict)

    def __str__(self) -> str:
        names = {number: name for name, number in TRANSITIONS.items()}
        return f"{self.kind.value} {names.get(self.transition, self.mode)}".rstrip()


class Topic(Enum):
    """A topic below the name of a part."""

    MODE_REQUEST = "mode_request_info"
    TRANSITION_REQUEST = "transition_request_info"
    MODE_EVENT = "mode_event"
    TRANSITION_EVENT = "transition_event"


@dataclass(frozen=True)
class Announcement:
    """A message on a topic of a part."""

    topic: Topic
    part: str
    start: Status
    goal: Status
