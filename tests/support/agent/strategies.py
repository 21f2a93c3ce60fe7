# SPDX-License-Identifier: Apache-2.0
"""Any submessage that can be sent, for property tests."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import (
    Acknack,
    Create,
    Delete,
    Fragment,
    Heartbeat,
    Reset,
    StatusReply,
)
from microros_gen.agent.wire.session_messages import (
    AgentActivity,
    AgentConfig,
    CreateClient,
    GetInfo,
    Info,
    Locator,
    ReaderActivity,
    StatusAgent,
    Timestamp,
    TimestampReply,
    WriterActivity,
)

u8 = st.integers(0, 0xFF)
u16 = st.integers(0, 0xFFFF)
u32 = st.integers(0, 0xFFFFFFFF)
u64 = st.integers(0, 2**64 - 1)
i16 = st.integers(-0x8000, 0x7FFF)
text = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=20)
octets = st.binary(max_size=40)
properties = st.none() | st.lists(st.tuples(text, text), max_size=3).map(tuple)
wire_time = st.tuples(st.integers(-(2**31), 2**31 - 1), u32)


def four(size: int) -> st.SearchStrategy[bytes]:
    return st.binary(min_size=size, max_size=size)


config = st.builds(AgentConfig, four(4), four(2), four(2), properties)
locator = st.one_of(
    st.builds(Locator, st.just(0), four(2), u8),
    st.builds(Locator, st.just(1), four(4), u16),
    st.builds(Locator, st.just(2), four(16), u32),
    st.builds(Locator, st.just(3), text.map(str.encode), st.just(0)),
)
activity = st.builds(AgentActivity, i16, st.lists(locator, max_size=3).map(tuple))
delivery = st.builds(DeliveryControl, u16, u16, u16, u16)
format_bits = st.sampled_from((0, 2, 8, 10, 14))

_kinds = st.sampled_from([k for k in ObjectKind if k not in (0, ObjectKind.AGENT, ObjectKind.CLIENT, 15)])


@st.composite
def creates(draw: st.DrawFn) -> Create:
    kind = draw(_kinds)
    form = draw(st.sampled_from((1, 2, 3)))
    body = draw(octets) if form == 3 else draw(text).encode()
    with_parent = ObjectKind.TOPIC <= kind <= ObjectKind.REPLIER
    parent = draw(u16) if with_parent else 0
    domain = draw(i16) if kind == ObjectKind.PARTICIPANT else 0
    return Create(
        draw(u16), draw(u16), kind, form, body, parent, domain, draw(st.booleans()), draw(st.booleans())
    )


BY_NAME: dict[str, st.SearchStrategy[Any]] = {
    "CREATE_CLIENT": st.builds(CreateClient, four(4), u8, u16, properties, four(4), four(2), four(2)),
    "CREATE": creates(),
    "GET_INFO": st.builds(GetInfo, u16, u16, u32),
    "DELETE": st.builds(Delete, u16, u16),
    "STATUS_AGENT": st.builds(StatusAgent, u8, u8, config),
    "STATUS": st.builds(StatusReply, u16, u16, u8, u8),
    "INFO": st.builds(
        Info,
        u16,
        u16,
        u8,
        u8,
        st.none() | config | creates().map(lambda create: create.representation),
        st.none() | activity | st.builds(WriterActivity, u64, i16) | st.builds(ReaderActivity, i16),
    ),
    "WRITE_DATA": st.builds(WriteData, u16, u16, octets, format_bits),
    "READ_DATA": st.builds(
        ReadData,
        u16,
        u16,
        u8,
        u8,
        st.none() | text,
        st.none() | st.builds(DeliveryControl, u16, u16, u16, u16),
    ),
    "DATA": st.builds(Data, u16, u16, octets, format_bits),
    "ACKNACK": st.builds(Acknack, u16, u16, u8),
    "HEARTBEAT": st.builds(Heartbeat, u16, u16, u8),
    "RESET": st.builds(Reset),
    "FRAGMENT": st.builds(Fragment, octets, st.booleans()),
    "TIMESTAMP": st.builds(Timestamp, wire_time),
    "TIMESTAMP_REPLY": st.builds(TimestampReply, wire_time, wire_time, wire_time),
}
