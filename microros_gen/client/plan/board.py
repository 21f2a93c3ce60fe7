# SPDX-License-Identifier: Apache-2.0
"""What a board without an operating system needs as numbers and names: its vector table, stack, ring and UART."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.client.plan.console import console_size
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.streams import usual_frame
from microros_gen.client.plan.transport_sizes import seal_overhead
from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.part import Divisor, Fraction, Image
from microros_gen.platform.target import OWN_DRIVER, Target, Uart
from microros_gen.records import dataclass

DEFAULT_STACK = 2048
_STACK_ALIGNMENT = 16  # RISC-V; the Arm procedure call standard asks for 8
_FREQUENCY_TOLERANCE = (
    0.025  # a frame of ten bits is sampled in the middle of its bits: each side may err by half of 5 %
)
_LINE_USERS = ("serial", "custom")
# OMG DDS-XRCE 1.0: a header of 4, a submessage of 4 and 5 (ACKNACK).
_ACKNACK = 13
# What may be stuffed of a frame besides one byte in 32 of its message.
_MORE_STUFFED = 2
# The longest that an application may leave a best-effort sample alone that comes over a serial line.
REACTION_MS = 20
_NUMBER = "Add its address to the target file: `unique_id: {address: 0x1FFF7A10, words: 3}`"
# Read of the ring at a time: a call costs little there.
RING_CHUNK = 8
_BITS_OF_A_BYTE = 10  # with start and stop bit


@dataclass(frozen=True)
class BoardPlan:
    """Sizes are bytes. `vectors` are handlers by interrupt number, `handlers` those that the application provides.

    `entry` is where the program begins, `first` what lies first in flash, in the section `first_section`. `hooks`
    are functions of the application that the target file names. `serial_driver` is `none` where nothing uses the
    line, or the board has none. `stdio_driver` waits for the line, `console_driver` sends by interrupt from a ring of
    `console_size` bytes.
    """

    stack_size: int = 0
    ring_size: int = 0
    output_size: int = 0
    ticks_per_ms: int = 0
    serial_driver: str = "none"
    uart_divisor: int = 0
    tx_irq: int = 0
    tx_pin: int = 0
    rx_pin: int = 0
    has_fpu: bool = False
    vectors: tuple[str, ...] = ()
    handlers: tuple[str, ...] = ()
    entry: str = ""
    first: str = ""
    first_section: str = ""
    hooks: tuple[str, ...] = ()
    stdio: str = "absent"
    stdio_driver: str = "none"
    stdio_divisor: int = 0
    console_driver: str = "none"
    console_size: int = 0

    @property
    def handled_interrupts(self) -> tuple[tuple[int, str], ...]:
        """Number and handler of each interrupt that has one."""
        return tuple((number, name) for number, name in enumerate(self.vectors) if name)

    @property
    def has_stdio(self) -> bool:
        """Whether the port has what the C library's standard output needs."""
        return self.stdio != "absent"

    @property
    def sends_console(self) -> bool:
        """Whether an interrupt or DMA sends the lines of the console from a ring."""
        return self.console_size != 0

    @property
    def stdio_sends(self) -> bool:
        """Whether printed text takes the way of the console."""
        return self.console_driver != "none"

    @property
    def has_serial_driver(self) -> bool:
        """Whether this project has the serial line of the board, with its own driver or the application's."""
        return self.serial_driver != "none"

    @property
    def drives_itself(self) -> bool:
        """Whether the application has the driver of the line."""
        return self.serial_driver == OWN_DRIVER


def plan_board(
    application: Application, target: Target, runtime: RuntimePlan, diagnostics: Diagnostics
) -> BoardPlan:
    """Decide what start-up, linker script and drivers print; for a hosted target nothing of it matters."""
    if target.hosted:
        return BoardPlan()
    _check_unique_id(application, target, runtime, diagnostics)
    has_line = target.has_image or target.uart_driver == OWN_DRIVER
    driver = target.uart_driver if has_line and runtime.transport.kind in _LINE_USERS else "none"
    if not target.has_image:
        return BoardPlan(
            ring_size=ring_size(runtime, seal_overhead(application)),
            output_size=runtime.transport.send_buffer,
            serial_driver=driver,
            console_size=console_size(application, target),
        )
    uart = target.uart if driver not in ("none", OWN_DRIVER) else None
    if target.cpu.starts_itself:
        _check_stack(application.memory.stack or 0, application, target, diagnostics)
        return BoardPlan(
            ring_size=ring_size(runtime, seal_overhead(application)),
            output_size=runtime.transport.send_buffer,
            console_size=console_size(application, target),
            ticks_per_ms=target.clock_hz // 1000,
            serial_driver=driver,
            uart_divisor=_divisor(uart, target, application, diagnostics) if uart else 0,
            tx_irq=uart.tx_irq if uart else 0,
        )
    image = target.cpu.image
    assert image is not None
    vectors = _vectors(target, uart, image)
    _check_vectors(target, len(vectors), application, diagnostics)
    stdio = target.stdio
    sends = stdio is not None and stdio.interrupt is not None
    return BoardPlan(
        stdio=stdio.to if stdio else "absent",
        stdio_driver=stdio.driver if stdio and not sends else "none",
        console_driver=stdio.driver if stdio and sends else "none",
        console_size=console_size(application, target),
        stdio_divisor=_stdio_divisor(target, uart, runtime, application, diagnostics),
        stack_size=_stack_size(application, target, diagnostics),
        ring_size=ring_size(runtime, seal_overhead(application)),
        output_size=runtime.transport.send_buffer,
        ticks_per_ms=target.clock_hz // 1000,
        serial_driver=driver,
        uart_divisor=_divisor(uart, target, application, diagnostics) if uart else 0,
        tx_irq=uart.tx_irq if uart else 0,
        tx_pin=uart.tx_pin & 0xFFFFFFFF if uart else 0,
        rx_pin=uart.rx_pin & 0xFFFFFFFF if uart else 0,
        has_fpu=any(flag in target.cpu.fpu_flags for flag in target.c_flags),
        vectors=vectors,
        handlers=tuple(sorted({name for _, name in target.interrupts})),
        entry=image.entry,
        first=image.first,
        first_section=image.first_section,
        hooks=tuple(name for name in (target.clocks_hook, target.watchdog_hook) if name),
    )


def has_own_line(target: Target, transport: str) -> bool:
    """Whether a driver of this project sends and receives for the transport, by interrupts."""
    return (
        transport == "serial"
        and not target.hosted
        and target.has_image
        and target.uart_driver not in ("none", OWN_DRIVER)
    )


def ring_size(runtime: RuntimePlan, overhead: int = 0) -> int:
    """Return the bytes that can arrive while the application does not read, and one to spare, at most 32 KiB.

    What an agent sends by itself answers what was sent to it: one message of the longest kind that must not be
    lost, and an ACKNACK for each slot of the reliable stream; each is framed and stuffed as usual, and has some bytes
    more. A larger sample comes on a best-effort stream at any time, and may be lost: of it there is what the line
    brings in REACTION_MS, or a quarter of it where that is less, for it is decoded out of the ring while it comes.
    `overhead`: bytes of a record around each message, where they are sealed.
    """
    frames = [runtime.transport.line_input, *([_ACKNACK + overhead] * runtime.streams.reliable_slots)]
    needed = sum(usual_frame(size) + _MORE_STUFFED for size in frames)
    if runtime.input.size + overhead > runtime.transport.line_input:
        in_time = runtime.transport.baud * REACTION_MS // (1000 * _BITS_OF_A_BYTE)
        needed = max(needed, min(in_time, (runtime.input.size + overhead) // 4))
    return min((needed + 4) & ~3, 1 << 15)


def _vectors(target: Target, uart: Uart | None, image: Image) -> tuple[str, ...]:
    named = dict(target.interrupts)
    if uart is not None:
        named |= dict.fromkeys(uart.interrupts, image.uart_handler)
    if target.stdio is not None and target.stdio.interrupt is not None:
        named[target.stdio.interrupt] = image.console_handler
    return tuple(named.get(number, image.no_handler) for number in range(max(named, default=0) + 1))


def _check_unique_id(
    application: Application, target: Target, runtime: RuntimePlan, diagnostics: Diagnostics
) -> None:
    if (
        application.session_key is None
        and not target.has_unique_id
        and runtime.creation.entities != "preconfigured"
    ):
        number = "" if target.of_package else f"{_NUMBER}, or g"
        diagnostics.warning(
            "all boards with this image have the same client key and would take over each other's session: the "
            f"target {target.name} has no unique id",
            application.target.span,
            f"{number or 'G'}ive each board its own key: "
            f"`session: {{key: 0x{runtime.session.client_key or 0:08X}}}`",
            id="MG-7003",
        )
    if isinstance(application.session_key, str) and not target.has_unique_id:
        diagnostics.error(
            f"session.key: device needs a number that no other device has, and the target {target.name} has none",
            application.spans.get("session") or application.target.span,
            "Add its address to the target file: `unique_id: {address: 0x1FFF7A10, words: 3}`, or give each "
            "device its own `session: {key: N}`",
            id="MG-7004",
        )


def _check_vectors(
    target: Target, interrupts: int, application: Application, diagnostics: Diagnostics
) -> None:
    """Report a vector table where the processor cannot have one."""
    flash = target.flash
    table = target.cpu.vector_table
    if flash is None or not flash.offset or table is None:
        return
    words = table.words + interrupts
    alignment = max(table.least, 1 << (4 * words - 1).bit_length())
    fixed = next((name for flag, name in table.fixed if flag in target.c_flags), "")
    if fixed:
        diagnostics.error(
            f"the {fixed} of {target.name} has no vector table offset register: 'flash.offset' has no effect",
            application.target.span,
            "Let the bootloader forward interrupts, or remove the offset",
            id="MG-7005",
        )
    elif flash.first % alignment:
        upwards = (flash.first + alignment - 1) // alignment * alignment - flash.origin
        diagnostics.error(
            f"the vector table of {target.name} would begin at {flash.first:#x}, which is not a multiple of"
            f" {alignment}",
            application.target.span,
            f"Set flash.offset: {upwards}",
            id="MG-7006",
        )


def _stdio_divisor(
    target: Target,
    uart: Uart | None,
    runtime: RuntimePlan,
    application: Application,
    diagnostics: Diagnostics,
) -> int:
    stdio = target.stdio
    if stdio is None or stdio.to != "uart":
        return 0
    if uart is not None and uart.base == stdio.base and runtime.transport.kind == "serial":
        diagnostics.error(
            f"'stdio' of {target.name} prints to the UART of the agent",
            application.target.span,
            "Give it another base, or use `stdio: {to: semihosting}`",
            id="MG-7007",
        )
    clock_hz = target.uart.clock_hz if target.uart else 0
    driver = target.cpu.driver(stdio.driver)
    assert driver is not None, "target_file checks it"
    if isinstance(driver.baud, Fraction):
        return driver.baud.register(stdio.baud)
    found = _nearest_divisor(driver.baud, clock_hz or target.clock_hz, stdio.baud)
    if found.error > _FREQUENCY_TOLERANCE:
        diagnostics.error(
            f"{stdio.baud} baud is not possible with {clock_hz or target.clock_hz} Hz by the UART of 'stdio'",
            application.target.span,
            f"The nearest rate is {found.nearest}: `stdio: {{baud: {found.nearest}}}`",
            id="MG-7008",
        )
    return found.divisor


def _stack_size(application: Application, target: Target, diagnostics: Diagnostics) -> int:
    requested = application.memory.stack
    size = DEFAULT_STACK if requested is None else requested
    size = (size + _STACK_ALIGNMENT - 1) // _STACK_ALIGNMENT * _STACK_ALIGNMENT
    _check_stack(size, application, target, diagnostics)
    return size


def _check_stack(size: int, application: Application, target: Target, diagnostics: Diagnostics) -> None:
    region = target.stack_region
    assert region is not None
    if size > region.size or (region is target.ram and size == region.size):
        diagnostics.error(
            f"a stack of {size} bytes leaves nothing of the {region.size} bytes of RAM of {target.name}",
            application.memory.stack_span or application.target.span,
            "Lower memory.stack",
            id="MG-7009",
        )


def _divisor(uart: Uart, target: Target, application: Application, diagnostics: Diagnostics) -> int:
    """Return the value of the UART's baud register for the application's rate."""
    clock, baud = uart.clock_hz or target.clock_hz, application.transport.baud
    driver = target.cpu.driver(uart.driver)
    assert driver is not None, "target_file checks it"
    if isinstance(driver.baud, Fraction):
        return driver.baud.register(baud)
    found = _nearest_divisor(driver.baud, clock, baud)
    if found.error > _FREQUENCY_TOLERANCE:
        diagnostics.error(
            f"{baud} baud is not possible with {clock} Hz by the UART of {target.name}",
            application.transport.span or application.target.span,
            f"The nearest rate is {found.nearest}: `transport: {{baud: {found.nearest}}}`",
            id="MG-7010",
        )
    return found.divisor


@dataclass(frozen=True)
class _Divisor:
    """A divisor, the rate that it gives, and its relative deviation from the requested rate."""

    divisor: int
    nearest: int
    error: float


def _nearest_divisor(register: Divisor, clock: int, baud: int) -> _Divisor:
    step = register.by
    divisor = min(max(round(clock / (step * baud)), register.least), register.most)
    return _Divisor(divisor, clock // (step * divisor), abs(clock / (step * divisor) / baud - 1))
