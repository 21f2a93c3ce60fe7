# SPDX-License-Identifier: Apache-2.0
"""The session of one client: its input and output streams. The caller passes the time and sends the returned bytes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from microros_gen.agent.input_pool import Holder
from microros_gen.agent.limits import Limits
from microros_gen.agent.output_queue import Queue
from microros_gen.agent.streams_in import BestEffortIn, Reassembly, ReliableIn
from microros_gen.agent.streams_out import BestEffortOut, Kept, Link, ReliableOut
from microros_gen.agent.wire.constants import (
    FLAG_LITTLE,
    INFO_ACTIVITY,
    OBJECT_CLIENT,
    STREAM_NONE,
    STREAM_RELIABLE,
    SubmessageId,
    is_reliable,
)
from microros_gen.agent.wire.entity_messages import Heartbeat
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.session_messages import GetInfo
from microros_gen.agent.wire.submessages import Submessage, encode

ACKNACK: Final = int(SubmessageId.ACKNACK)
Ready = tuple[bytes, int, int, bool, int]
"""Input to process: message, offset of its first submessage, stream, whether reassembled, samples done.

The last one is the number of samples of that submessage already sent to ROS 2. A reassembled message precedes the rest
of the message with its last fragment.
"""


class Session:
    """Session `link.session` of the client `link.key`. Streams are created on first use."""

    def __init__(
        self, link: Link, limits: Limits, holder: Holder | None = None, output: Holder | None = None
    ) -> None:
        """Use `holder` for incomplete or waiting input, and `output` for unacknowledged output."""
        self._limits = limits
        self._holder = holder or Holder()
        self._output = output or Holder()
        self._lost_before = self._resent_before = self._repeated_before = 0
        self._open(link)

    def _open(self, link: Link) -> None:
        self._holder.clear()
        self._output.clear()
        self.link = link
        self._best_effort_in: dict[int, BestEffortIn] = {}
        self._reliable_in: dict[int, ReliableIn] = {}
        self._reassembly: dict[int, Reassembly] = {}
        self._outputs: dict[int, BestEffortOut | ReliableOut] = {}
        self._unfinished: dict[int, list[Ready]] = {}

    def reset(self, link: Link | None = None) -> None:
        """Restart all streams at 0, after a RESET or a new CREATE_CLIENT (then with its new `link`)."""
        self._lost_before, self._resent_before = self.lost, self.resent
        self._repeated_before = self.repeated
        self._open(link or self.link)

    def incoming(self, stream: int, sequence: int, data: bytes) -> tuple[bytes, ...]:
        """Accept a message from the client; return the messages to process now, in order."""
        if stream >= STREAM_RELIABLE:
            reliable = self._reliable_in.get(stream)
            return (reliable or self._open_reliable(stream)).push(sequence, data)
        if stream == STREAM_NONE:
            return (data,)
        best_effort = self._best_effort_in.get(stream)
        return (data,) if (best_effort or self._open_best_effort(stream)).accept(sequence) else ()

    def announced(self, heartbeat: Heartbeat) -> tuple[bytes, ...]:
        """Process a HEARTBEAT; return the messages to process now. A skipped gap drops incomplete fragments."""
        if not is_reliable(heartbeat.stream):
            raise MalformedError("heartbeat_stream", f"stream {heartbeat.stream:#04x}")
        reliable = self._reliable_in.get(heartbeat.stream) or self._open_reliable(heartbeat.stream)
        ready, lost = reliable.announce(heartbeat.first, heartbeat.last)
        if lost and heartbeat.stream in self._reassembly:
            self._reassembly[heartbeat.stream].drop()
        if not reliable.stopped:
            self._drop_unfinished(heartbeat.stream)  # dropped by the client
        return ready

    @property
    def lost(self) -> int:
        """Messages from the client that did not arrive in time, over all resets."""
        best_effort = sum(stream.lost for stream in self._best_effort_in.values())
        return self._lost_before + best_effort + sum(stream.lost for stream in self._reliable_in.values())

    @property
    def resent(self) -> int:
        """Messages that were sent to the client again, over all resets."""
        return self._resent_before + sum(stream.resent for stream in self._reliable_out())

    @property
    def repeated(self) -> int:
        """Messages from the client on reliable streams that arrived again, over all resets."""
        return self._repeated_before + sum(stream.repeated for stream in self._reliable_in.values())

    @property
    def queue(self) -> Queue:
        """The output that waits on all reliable streams; `fill` is that of the fullest one."""
        queues = [stream.queue for stream in self._reliable_out()]
        fill = max((queue.fill for queue in queues), default=0.0)
        return Queue(sum(queue.messages for queue in queues), sum(queue.bytes for queue in queues), fill)

    @property
    def round_trip_s(self) -> float | None:
        """Seconds from a reliable message to its acknowledgement, as last measured; None: never."""
        known = [stream.round_trip_s for stream in self._reliable_out()]
        return max((seconds for seconds in known if seconds is not None), default=None)

    def _reliable_out(self) -> list[ReliableOut]:
        return [output for output in self._outputs.values() if isinstance(output, ReliableOut)]

    @property
    def held(self) -> int:
        """Number of bytes of incomplete or waiting input."""
        return self._holder.held

    @property
    def stopped(self) -> bool:
        """Whether a stream waits for `go_on`."""
        return bool(self._unfinished)

    def stop(self, unfinished: list[Ready], followers: Sequence[bytes]) -> bool:
        """Keep the message `unfinished` and those that follow, unacknowledged, until `go_on`.

        Return False if its stream no longer exists or was stopped before.
        """
        stream = unfinished[0][2]
        reliable = self._reliable_in.get(stream)
        if reliable is None or reliable.stopped:
            return False
        reliable.stop(followers)
        self._unfinished[stream] = unfinished
        self._holder.add(sum(len(part[0]) for part in unfinished))
        return True

    def go_on(self) -> list[Ready]:
        """Return the messages of stopped streams, to be processed now."""
        start = len(self.link.header(STREAM_NONE, 0))
        ready: list[Ready] = []
        for stream, unfinished in list(self._unfinished.items()):
            followers = self._reliable_in[stream].go_on()
            ready += [*unfinished, *((message, start, stream, False, 0) for message in followers)]
            self._drop_unfinished(stream)
        return ready

    def _drop_unfinished(self, stream: int) -> None:
        self._holder.add(-sum(len(part[0]) for part in self._unfinished.pop(stream, ())))

    def rest(self) -> int:
        """Drop incomplete input of a silent client; return how many messages are lost."""
        for reliable in self._reliable_in.values():
            reliable.forget()
        unfinished = [reassembly for reassembly in self._reassembly.values() if reassembly.unfinished]
        for reassembly in unfinished:
            reassembly.drop()
        return len(unfinished)

    def begin(self, stream: int, first: int) -> None:
        """Let reliable input stream `stream` start at `first`: an earlier agent received what precedes it."""
        self._open_reliable(stream).next = first

    def fragment(self, stream: int, part: bytes, last: bool) -> bytes | None:
        """Add the payload of a FRAGMENT of `stream`; return the submessages that it completes."""
        if not is_reliable(stream):
            raise MalformedError("fragment_stream", f"stream {stream:#04x}")
        reassembly = self._reassembly.get(stream)
        if reassembly is None:
            reassembly = self._reassembly[stream] = Reassembly(self._limits.message_bytes, self._holder)
        return reassembly.add(part, last)

    def acknack(self, stream: int, unfinished: int = 0) -> bytes:
        """Return the ACKNACK message for reliable stream `stream`.

        It does not acknowledge the last `unfinished` messages that were returned for processing.
        """
        reliable = self._reliable_in.get(stream)
        first, missing = reliable.missing(unfinished) if reliable else (0, 0)
        # Sent for every reliable message, so its bytes are assembled here.
        body = (
            ACKNACK,
            FLAG_LITTLE,
            5,
            0,
            first & 0xFF,
            first >> 8,
            missing >> 8,
            missing & 0xFF,
            stream,
        )
        return self.link.header(STREAM_NONE, 0) + bytes(body)

    def last_received(self) -> int:
        """Return the number of the last accepted message of the client's built-in reliable stream."""
        reliable = self._reliable_in.get(STREAM_RELIABLE)
        return (reliable.next - 1) & 0xFFFF if reliable else 0xFFFF

    def last_acknowledged(self, stream: int) -> int:
        """Return the number of the last message that the client acknowledged on a reliable stream."""
        output = self._outputs.get(stream)
        return output.last_acknowledged() if isinstance(output, ReliableOut) else 0xFFFF

    def unnumbered(self, submessage: Submessage, little: bool = True) -> bytes:
        """Return a message on stream 0 with one submessage."""
        return self.link.header(STREAM_NONE, 0) + encode(submessage, little)

    def output(self, stream: int) -> BestEffortOut | ReliableOut:
        """Return the stream to the client with an id (1 to 255), created on first use."""
        found = self._outputs.get(stream)
        return found if found is not None else self._open_output(stream)

    def may_send_on(self, stream: int) -> bool:
        """Return whether a stream to the client exists, or another one of its kind is allowed."""
        alike = sum(is_reliable(known) == is_reliable(stream) for known in self._outputs)
        return stream in self._outputs or alike < self._limits.streams

    def acknowledged(self, stream: int, first: int, missing: int, now: float) -> list[bytes]:
        """Process an ACKNACK; return the messages to send now."""
        output = self._outputs.get(stream)
        return output.acknowledge(first, missing, now) if output else []

    def asks(self, now: float) -> bool:
        """Return whether a HEARTBEAT is due."""
        return any(output.asks(now) for output in self._outputs.values())

    def heartbeats(self, now: float) -> list[bytes]:
        """Return the HEARTBEAT messages that are due."""
        due = (output.heartbeat(now) for output in self._outputs.values())
        return [self.unnumbered(heartbeat) for heartbeat in due if heartbeat]

    def undelivered(self) -> list[Kept]:
        """Return the messages on reliable streams that are sent or waiting, and not acknowledged."""
        return [kept for stream in self._reliable_out() for kept in stream.undelivered()]

    def repeated_part(self) -> float:
        """Return the largest fraction of repetitions among the reliable messages of a stream to the client."""
        return max((stream.repeated_part() for stream in self._reliable_out()), default=0.0)

    def probe(self) -> bytes:
        """Return a message that makes a client answer: HEARTBEAT on a reliable stream, else GET_INFO."""
        if self._reliable_in or any(isinstance(o, ReliableOut) for o in self._outputs.values()):
            builtin = self.output(STREAM_RELIABLE)
            assert isinstance(builtin, ReliableOut)
            return self.unnumbered(builtin.probe())
        return self.unnumbered(GetInfo(0, OBJECT_CLIENT, INFO_ACTIVITY))

    def _open_output(self, stream: int) -> BestEffortOut | ReliableOut:
        limits = self._limits
        self._outputs[stream] = (
            ReliableOut(self.link, stream, limits.backlog_bytes, limits.message_bytes, self._output)
            if is_reliable(stream)
            else BestEffortOut(self.link, stream)
        )
        return self._outputs[stream]

    def _open_reliable(self, stream: int) -> ReliableIn:
        self._check_streams(len(self._reliable_in))
        self._reliable_in[stream] = ReliableIn(self._limits.message_bytes, self._holder)
        return self._reliable_in[stream]

    def _open_best_effort(self, stream: int) -> BestEffortIn:
        self._check_streams(len(self._best_effort_in))
        self._best_effort_in[stream] = BestEffortIn()
        return self._best_effort_in[stream]

    def _check_streams(self, open_streams: int) -> None:
        if open_streams >= self._limits.streams:
            raise MalformedError("too_many_streams", f"more than {self._limits.streams}")
