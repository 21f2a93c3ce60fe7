# SPDX-License-Identifier: Apache-2.0
"""CREATE: the names under which an agent finds descriptions, and the size of the largest message.

Sources: OMG DDS-XRCE 1.0, 7.7.3 and 8.3.5; reference names as the rmw of micro-ROS builds them (with its option for
references), so that reference files made for it serve here too.
"""

from __future__ import annotations

from microros_gen.records import dataclass

MESSAGE_HEADER = 4
SUBMESSAGE_HEADER = 4
_BEFORE_DESCRIPTION = 12  # request id, object id, kind, format, padding, length
_OWNER = 2  # the parent's id, or the domain
_LONGEST_DEPTH = len("65535")
_XML_PARTICIPANT = len("<dds><participant><rtps><name></name></rtps></participant></dds>")
_XML_TOPIC = len("<dds><topic><name></name><dataType></dataType></topic></dds>")
_XML_WRITER = len(
    "<dds><data_writer><topic><kind>NO_KEY</kind><name></name><dataType></dataType><historyQos><kind>KEEP_LAST</kind>"
    "<depth></depth></historyQos></topic><qos><durability><kind>TRANSIENT_LOCAL</kind></durability><reliability><kind>"
    "BEST_EFFORT</kind></reliability></qos></data_writer></dds>"
)
_XML_SERVICE = len(
    '<dds><requester profile_name="" service_name="" request_type="Request_" reply_type="Response_">'
    "<request_topic_name>rqRequest</request_topic_name><reply_topic_name>rrReply</reply_topic_name>"
    "<publisher><topic><historyQos><depth>10</depth></historyQos></topic></publisher>"
    "<subscriber><topic><historyQos><depth>10</depth></historyQos></topic></subscriber></requester></dds>"
)
_NUL = 1
_WINDOW = 16
"""Messages of a reliable stream that agents accept ahead of what they have (the public agent's number)."""


@dataclass(frozen=True)
class CreateNames:
    """Longest names that a CREATE carries, in characters: on the wire, and of references.

    `service` with its slash, `service_type` that of the service itself (`std_srvs::srv::dds_::SetBool_`); 0: none.
    """

    participant: int
    topic: int
    type: int
    participant_reference: int = 0
    service: int = 0
    service_type: int = 0


def create_size(names: CreateNames, entities: str = "binary") -> int:
    """Return the size of the largest datagram with a CREATE, bytes; `entities` is how objects are described."""
    participant, *others = _DESCRIPTIONS[entities](names)
    longest = max(participant + participant % 2, *others)
    return MESSAGE_HEADER + SUBMESSAGE_HEADER + _BEFORE_DESCRIPTION + longest + _OWNER


def most_in_fragments(mtu: int) -> int:
    """Return the size of the largest request that goes in fragments of at most `mtu` bytes.

    All of it is under way at once: one of the numbers that an agent accepts ends what the last session left.
    """
    return (_WINDOW - 1) * (mtu - MESSAGE_HEADER - SUBMESSAGE_HEADER) + MESSAGE_HEADER


def create_text(size: int, names: CreateNames, entities: str = "binary") -> int:
    """Return how many bytes of the largest CREATE, which takes `size`, are surely text: names, and tags of XML.

    Names of ROS and of references have neither `}` nor `~`, the two bytes that a serial line stuffs.
    """
    nothing = CreateNames(0, len("rt/"), 0, 0, len("/") if names.service else 0, 0)
    if entities == "binary":
        return max(size - create_size(nothing), 0)
    return size - (MESSAGE_HEADER + SUBMESSAGE_HEADER + _BEFORE_DESCRIPTION + _OWNER + _NUL)


def participant_reference(name: str, nodes: int) -> str:
    """Return the reference of a node's participant; `name` is what it carries, `nodes` how many the plan has.

    micro-ROS has one name for every participant; among several each has its own here, so that nodes differ.
    """
    return "participant_profile" if nodes <= 1 else f"{name.removeprefix('/')}__p"


def topic_reference(topic: str) -> str:
    """Return the reference of a fully qualified topic: `/imu/data` → `imu/data__t`."""
    return f"{topic[1:]}__t"


def writer_reference(topic: str) -> str:
    """Return the reference of a topic's data writer: `/imu/data` → `imu/data__dw`."""
    return f"{topic[1:]}__dw"


def reader_reference(topic: str) -> str:
    """Return the reference of a topic's data reader: `/imu/data` → `imu/data__dr`."""
    return f"{topic[1:]}__dr"


def replier_reference(service: str) -> str:
    """Return the reference of a service's replier: `/set_bool` → `set_bool__rp`."""
    return f"{service[1:]}__rp"


def requester_reference(service: str) -> str:
    """Return the reference of a client's requester: `/set_bool` → `set_bool__rq`."""
    return f"{service[1:]}__rq"


def _binary(names: CreateNames) -> tuple[int, ...]:
    topic = _align4(4 + names.topic + _NUL + 2) + 4 + names.type + _NUL
    return 8 + names.participant + _NUL, topic, 14, _binary_service(names) if names.service else 0


def _binary_service(names: CreateNames) -> int:
    strings = (
        (0, names.service),
        (0, names.service_type + len("Request_")),
        (0, names.service_type + len("Response_")),
    )
    topics = (1, len("rq") + names.service + len("Request")), (1, len("rr") + names.service + len("Reply"))
    end = 0
    for flag, length in (*strings, *topics):
        end = _align4(end + flag) + 4 + length + _NUL
    return end


def _xml(names: CreateNames) -> tuple[int, ...]:
    both = names.topic + names.type + _NUL
    return (
        _XML_PARTICIPANT + names.participant + _NUL,
        _XML_TOPIC + both,
        _XML_WRITER + _LONGEST_DEPTH + both,
        _XML_SERVICE + 4 * names.service + 2 * names.service_type + _NUL if names.service else 0,
    )


def _reference(names: CreateNames) -> tuple[int, ...]:
    topic = names.topic - len("rt/")
    of_service = names.service - len("/") + len("__rp") + _NUL if names.service else 0
    return (
        names.participant_reference + _NUL,
        topic + len("__t") + _NUL,
        topic + len("__dw") + _NUL,
        of_service,
    )


_DESCRIPTIONS = {"binary": _binary, "xml": _xml, "reference": _reference}


def _align4(size: int) -> int:
    return (size + 3) & ~3
