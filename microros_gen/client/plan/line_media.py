# SPDX-License-Identifier: Apache-2.0
"""What a message takes of a line, and what the line carries: serial lines and CAN FD."""

from __future__ import annotations

from fractions import Fraction

from microros_gen.application.model import Application
from microros_gen.client.plan.session_times import LINE_BITS_PER_BYTE
from microros_gen.client.plan.streams import longest_frame, usual_frame
from microros_gen.client.plan.transport_sizes import seal_overhead
from microros_gen.records import dataclass

BAUD_RATES = (
    *(9600, 19_200, 38_400, 57_600, 115_200, 230_400, 460_800, 921_600),
    *(1_000_000, 1_500_000, 2_000_000, 3_000_000, 4_000_000),
)
"""Rates of serial lines that adapters have; above them the rate is computed."""
BIT_RATES = (125_000, 250_000, 500_000, 800_000, 1_000_000)
"""Rates of CAN without a switch to another rate within the frame (CiA 301)."""
MOST_RATE = {"serial": 12_000_000, "canfd": 8_000_000}
"""The highest baud and bit rate; application.schema.json says it too."""

# ISO 11898-1:2015, 10.4: a frame of CAN FD with an extended identifier, in bits.
_DATA_LENGTHS: tuple[int, ...] = (*range(9), 12, 16, 20, 24, 32, 48, 64)
_BEFORE_DATA = 41  # start, 29 of the identifier, SRR, IDE, RRS, FDF, res, BRS, ESI, four of the length
_SHORT_CRC, _LONG_CRC = 4 + 17 + 6, 4 + 21 + 7  # count of stuff bits, checksum, fixed stuff bits
_LONG_DATA = 17  # bytes from which the checksum is the long one
_AFTER_CRC = 1 + 1 + 1 + 7 + 3  # delimiter, acknowledgement with its delimiter, end, pause
_STUFF_DISTANCE = 4  # at the worst a stuff bit follows the first five bits, and then every four


@dataclass(frozen=True)
class Medium:
    """The line of a transport `kind`; `rate` in bits per second, None: nothing is known of it.

    Loads are bits on CAN, and bytes on other lines. The agent sends on the same bus where it is `shared`; on a serial
    line each direction has its own wire. `stuffed`: each byte of a frame on a serial line counts as stuffed.
    `overhead`: bytes of a record around each message, where they are sealed.
    """

    kind: str
    rate: int | None
    stuffed: bool = False
    overhead: int = 0

    @property
    def unit(self) -> str:
        """Unit of loads."""
        return "bit/s" if self.kind == "canfd" else "bytes/s"

    @property
    def key(self) -> str:
        """The key of `transport` that sets the rate."""
        return "bitrate" if self.kind == "canfd" else "baud"

    @property
    def shared(self) -> bool:
        """Whether the messages of the agent take time of the same line."""
        return self.kind == "canfd"

    @property
    def capacity(self) -> Fraction | None:
        """What the line carries in a second; None: not known."""
        if self.rate is None:
            return None
        return Fraction(self.rate, LINE_BITS_PER_BYTE if self.kind == "serial" else 1)

    @property
    def rates(self) -> tuple[int, ...]:
        """The usual rates."""
        return BAUD_RATES if self.kind == "serial" else BIT_RATES

    def usual(self, size: int) -> int:
        """Return what a message of `size` bytes takes: usually, at most where each byte is stuffed, and on CAN."""
        carried = size + self.overhead
        if self.kind == "serial":
            return longest_frame(carried) if self.stuffed else usual_frame(carried)
        return can_frame_bits(carried) if self.kind == "canfd" else carried

    def most(self, size: int) -> int:
        """Return what it takes at most."""
        return longest_frame(size + self.overhead) if self.kind == "serial" else self.usual(size)


def medium_of(kind: str, application: Application) -> Medium:
    """Return the line of the selected transport."""
    rates = {"serial": application.transport.baud, "canfd": application.transport.bitrate}
    return Medium(kind, rates.get(kind), overhead=seal_overhead(application))


def can_frame_bits(size: int) -> int:
    """Return the bits of a frame of CAN FD that carries a message of `size` bytes, with all stuff bits, and the pause.

    The message follows a byte with its length; what is left of the frame is zero. No bit rate switch.
    """
    data = next(length for length in _DATA_LENGTHS if length > size)
    stuffed = _BEFORE_DATA + 8 * data
    crc = _LONG_CRC if data >= _LONG_DATA else _SHORT_CRC
    return stuffed + (stuffed - 1) // _STUFF_DISTANCE + crc + _AFTER_CRC
