# SPDX-License-Identifier: Apache-2.0
"""Bytes of the public client and agent (Micro-XRCE-DDS 2.4.3), captured on the wire.

Pad bytes of the public client are uninitialized memory; they are zero here.
"""

from __future__ import annotations

PARTICIPANT_XML = "<dds><participant><rtps><name>p1</name></rtps></participant></dds>"
TOPIC_XML = (
    "<dds><topic><name>rt/chatter</name><dataType>std_msgs::msg::dds_::String_</dataType></topic></dds>"
)
WRITER_XML = (
    "<dds><data_writer><topic><kind>NO_KEY</kind><name>rt/chatter</name>"
    "<dataType>std_msgs::msg::dds_::String_</dataType></topic></data_writer></dds>"
)
CREATE_CLIENT = "80 00 00 00 00 01 10 00 58 52 43 45 01 00 01 0f a1 b2 c3 d4 81 00 fc 01"
STATUS_AGENT = "81 00 00 00 04 01 0b 00 00 00 58 52 43 45 01 00 01 0f 00"
CREATE_CLIENT_KEYED = "00 00 00 00 a1 b2 c3 d4 00 01 10 00 58 52 43 45 01 00 01 0f a1 b2 c3 d4 01 00 fc 01"
STATUS_AGENT_KEYED = "01 00 00 00 a1 b2 c3 d4 04 01 0b 00 00 00 58 52 43 45 01 00 01 0f 00"
PING = "80 00 00 00 02 01 08 00 00 0a ff fd 02 00 00 00"
PONG_OUTSIDE = (
    "80 00 00 00 06 01 1c 00 00 0a ff fd 00 00 01 0d 58 52 43 45 01 00 01 0f"
    " 00 01 0d 00 01 00 00 00 00 00 00 00"
)
DISCOVERY_ANSWER = (
    "80 00 00 00 06 01 2c 00 00 09 ff fd 00 00 01 0d 58 52 43 45 01 00 01 0f"
    " 00 01 0d 00 01 00 00 00 02 00 00 00"
    "01 7f 00 00 01 00 ba 22 01 c0 00 02 02 00 ba 22"
)

PARTICIPANT_BLOB = "00 01 00 00 08 00 00 00 6d 79 5f 6e 6f 64 65 00"
TOPIC_BLOB = (
    "0b 00 00 00 72 74 2f 63 68 61 74 74 65 72 00 00 01 00 00 00 1d 00 00 00 73 74 64 5f 6d 73 67 73 3a 3a"
    "6d 73 67 3a 3a 64 64 73 5f 3a 3a 53 74 72 69 6e 67 5f 00"
)
WRITER_BLOB = "00 12 01 00 03 00 01 00 0a 00 00 00 00 00"
WRITER_BLOB_WITHOUT_DEPTH = "00 12 01 00 0a 00 00 00 00 00 00"
READER_BLOB = "00 22 01 00 03 00 01 00 0a 00 00 00 00 00 00"

# One submessage each, complete with its header.
SUBMESSAGES = {
    "CREATE_CLIENT": CREATE_CLIENT[12:],
    "STATUS_AGENT": STATUS_AGENT[12:],
    "GET_INFO": PING[12:],
    "INFO": PONG_OUTSIDE[12:],
    "INFO with locators": DISCOVERY_ANSWER[12:],
    "CREATE participant": "01 07 1e 00 00 0a 00 11 01 03 00 00 10 00 00 00" + PARTICIPANT_BLOB + "4d 00",
    "CREATE topic": "01 07 43 00 00 0b 00 12 02 03 00 00 35 00 00 00" + TOPIC_BLOB + "00 11",
    "CREATE publisher": "01 07 10 00 00 0c 00 13 03 03 00 00 02 00 00 00 00 00 00 11",
    "CREATE publisher xml": "01 01 0f 00 00 09 00 13 03 02 00 00 01 00 00 00 00 00 11",
    "CREATE datawriter": "01 07 1c 00 00 0d 00 15 05 03 00 00 0e 00 00 00" + WRITER_BLOB + "00 13",
    "DELETE": "03 01 04 00 00 02 ff fe",
    "STATUS": "05 01 06 00 00 0a 00 11 00 00",
    "WRITE_DATA": "07 01 08 00 00 0e 00 15 01 02 03 04",
    "READ_DATA": "08 01 10 00 00 11 00 16 80 00 00 01 ff ff 00 00 00 00 00 00",
    "DATA": "09 01 08 00 00 11 00 16 01 02 03 04",
    "HEARTBEAT": "0b 01 05 00 07 00 07 00 80",
    "ACKNACK nothing missing": "0a 01 05 00 01 00 00 00 80",
    "ACKNACK one missing": "0a 01 05 00 04 00 00 01 80",
    "RESET": "0c 01 00 00",
    "FRAGMENT": "0d 01 04 00 07 01 b4 04",
    "FRAGMENT last": "0d 03 02 00 ac 04",
    "TIMESTAMP": "0e 01 08 00 01 00 00 00 02 00 00 00",
    "TIMESTAMP_REPLY": (
        "0f 01 18 00 01 00 00 00 02 00 00 00 03 00 00 00 04 00 00 00 05 00 00 00 06 00 00 00"
    ),
}
