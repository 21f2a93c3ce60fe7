# SPDX-License-Identifier: Apache-2.0
"""The parts of a platform: processor, operating system, network, board. Each is a component, and facts next to it."""

from __future__ import annotations

from microros_gen.records import dataclass
from microros_gen.selection.component import Component

KINDS = ("board", "network", "os", "cpu")
"""Which part provides a capability where several could: the first one. The application's own functions precede all."""


@dataclass(frozen=True)
class Divisor:
    """A baud rate register: the clock divided by `by` and by the register, which is `least` to `most`."""

    by: int
    least: int
    most: int


@dataclass(frozen=True)
class Fraction:
    """A baud rate register: the rate as a fraction of `of_hz`, of `bits` bits, the lowest `unused` of them 0."""

    of_hz: int
    bits: int
    unused: int

    def register(self, baud: int) -> int:
        """Return the value of the register for a rate."""
        nearest = ((baud << self.bits) // self.of_hz + (1 << self.unused >> 1)) >> self.unused
        return (nearest << self.unused) & ((1 << self.bits) - 1)


@dataclass(frozen=True)
class Driver:
    """The driver of a UART. `tx_irq`: its transmit interrupt is so many numbers after the one that receives.

    `stdio`: standard output can go there.
    """

    name: str
    baud: Divisor | Fraction
    tx_irq: int = 0
    stdio: bool = False


@dataclass(frozen=True)
class Image:
    """Names of an image's first steps: where it begins, what is first in flash and in which section.

    `uart_handler` handles the interrupt of the serial line, `console_handler` the one that sends the console's bytes
    (empty: its drivers can only wait), `no_handler` those of nobody; empty: the table has 0.
    """

    entry: str
    first: str
    first_section: str
    uart_handler: str
    no_handler: str = ""
    console_handler: str = ""


@dataclass(frozen=True)
class VectorTable:
    """A table that can be moved: `words` precede interrupt 0, it is aligned to its size and at least to `least` bytes.

    `fixed` are processors that cannot move it, by the compiler flag that chooses them.
    """

    words: int
    least: int
    fixed: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Cpu:
    """What a processor adds to its component.

    `timer_interrupt` is how a page names the interrupt of the system timer. `registers` are addresses that it must
    know of a board, `optional_registers` those that it can use. `stdio_heap`: its C library takes memory to print.
    `starts_itself`: its C library has start-up code, vectors and linker script. `narrow`: an interrupt can come
    between two bytes of a number.
    """

    image: Image | None = None
    vector_table: VectorTable | None = None
    timer_interrupt: str = ""
    fpu_flags: tuple[str, ...] = ()
    stdio_heap: bool = False
    small_data: bool = False
    starts_itself: bool = False
    narrow: bool = False
    registers: tuple[str, ...] = ()
    optional_registers: tuple[str, ...] = ()
    drivers: tuple[Driver, ...] = ()

    def driver(self, name: str) -> Driver | None:
        """Return the driver with this name."""
        return next((driver for driver in self.drivers if driver.name == name), None)


@dataclass(frozen=True)
class Os:
    """What an operating system adds to its component.

    `hosted`: programs have standard input and output, and are started. `linker_script`: it makes images with a
    its own start-up code and linker script (a file of the component). `tick` is called each millisecond.
    `task_stack`: bytes of a task's stack where nothing is said, `task_stack_least`: at least, `task_stack_context`: of
    it for the system and the port, around what the task calls. `task_stack_macro`, of the header `task_stack_header`,
    defines one from its name and bytes; empty: an array. `parts`: kind and name of built-in parts that provide what
    this one does not. `device` names the serial line if the application file does not; empty: the only line of a board
    has no name. `clock_wraps`: the steady time and that of the day count a counter of milliseconds with 32 bits.
    """

    hosted: bool = False
    linker_script: str = ""
    tick: str = ""
    task_stack: int = 4096
    task_stack_least: int = 512
    task_stack_macro: str = ""
    task_stack_header: str = ""
    parts: tuple[tuple[str, str], ...] = ()
    device: str = ""
    task_stack_context: int = 256
    clock_wraps: bool = False


@dataclass(frozen=True)
class Part:
    """A part: its kind (KINDS), its component and its facts. `own`: it does not ship with the tool."""

    kind: str
    component: Component
    cpu: Cpu | None = None
    os: Os | None = None
    own: bool = False
