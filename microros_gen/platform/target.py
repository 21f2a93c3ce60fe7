# SPDX-License-Identifier: Apache-2.0
"""Targets: what the C compiler is told, and which parts of a platform are below the library."""

from __future__ import annotations

from fractions import Fraction

from microros_gen.platform.part import Cpu, Os, Part
from microros_gen.records import dataclass
from microros_gen.selection.component import Provision

OWN_DRIVER = "application"
"""The driver of a serial line that the application provides: the functions of microros/port_uart.h."""


@dataclass(frozen=True)
class Region:
    """A part of the address space: where it begins and how many bytes it has.

    `offset`: bytes at its beginning that are not the image's (flash with a bootloader).
    """

    origin: int
    size: int
    offset: int = 0

    @property
    def first(self) -> int:
        """The first address that the image may use."""
        return self.origin + self.offset

    @property
    def moved_to(self) -> int:
        """The first address of an image that does not begin where the region does; 0: it does."""
        return self.first if self.offset else 0


@dataclass(frozen=True)
class Memory:
    """A further memory.

    `holds`: `stack`, `serial` (the rings of the line and of the console), or sections of the program (`.dma`).
    """

    name: str
    region: Region
    holds: tuple[str, ...] = ()

    @property
    def sections(self) -> tuple[str, ...]:
        """Patterns of the sections that it holds, as a linker script names them."""
        rings = ("*(.bss.port_ring .bss.port_output .bss.port_console)",) if "serial" in self.holds else ()
        return (*rings, *(f"*({name} {name}.*)" for name in self.holds if name.startswith(".")))

    @property
    def has_stack(self) -> bool:
        """Whether the stack is here."""
        return "stack" in self.holds


@dataclass(frozen=True)
class Stdio:
    """Where the C library's standard output goes: `to` is none, semihosting, uart or application.

    `driver`, `base` and `baud` are those of the uart, `interrupt` its transmit interrupt; None: printing waits for
    the line. `floats`: newlib's printf formats %f.
    """

    to: str
    driver: str = "none"
    base: int = 0
    baud: int = 115_200
    floats: bool = False
    interrupt: int | None = None

    @property
    def memory(self) -> int:
        """Bytes that newlib may take with malloc: its streams need 436, the digits of a double up to 3,000 more."""
        return 4096 if self.floats else 512


@dataclass(frozen=True)
class Uart:
    """A serial interface of a board: `driver` is one of the processor (Cpu.drivers), `irq` its receive interrupt.

    `tx_irq` is its transmit interrupt, the same where it has one for both. `driver` application: the program
    drives it, and nothing else is known of it. `clock_hz` divides down to the baud rate; 0: that of the target.
    Pins are where they can be chosen; -1: none.
    """

    driver: str
    base: int
    irq: int
    clock_hz: int = 0
    tx_pin: int = -1
    rx_pin: int = -1
    tx_irq: int = 0

    @property
    def interrupts(self) -> tuple[int, ...]:
        """The numbers of its interrupts; those of an application's own driver are in `interrupts:`."""
        return () if self.driver == OWN_DRIVER else tuple(sorted({self.irq, self.tx_irq}))


@dataclass(frozen=True)
class UniqueId:
    """Words of 32 bit that no other device has."""

    address: int
    words: int


@dataclass(frozen=True)
class Emulator:
    """A program that runs an image: `arguments` name the machine; the image and its lines are added by `run`."""

    program: str
    package: str
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True)
class Target:
    """A target. `compilers` are tried in order; `package` names the Debian package that brings the first.

    `c_flags` apply to every file, `link_flags` to the image. `parts` are below the library: the first that has a
    capability provides it, unless the application does (`provides`). `hosted`: an operating system with standard
    input and output is below. Without one, a target that knows its board has `flash` and `ram`, and so an image;
    without them it has the library alone. `clock_hz` counts the system timer, `cpu_hz` the processor (0: the same);
    an instruction takes `cycles_per_instruction` at most, None: nobody says. `interrupts` are handlers of the
    application by their number, `registers` addresses by name (Cpu.registers). `memories` are those besides flash and
    RAM; the hooks are functions of the application, empty: none.
    `data_model` is lp64, ilp32, ip16 or any. `transport` is what holds where neither application nor profile say.
    `of_package`: the target file belongs to a package for another build system, so users do not change it.
    """

    name: str
    summary: str
    parts: tuple[Part, ...]
    compilers: tuple[str, ...]
    archivers: tuple[str, ...]
    package: str
    c_flags: tuple[str, ...] = ()
    link_flags: tuple[str, ...] = ()
    libraries: tuple[str, ...] = ()
    image_suffix: str = ""
    hosted: bool = False
    data_model: str = "lp64"
    transport: str | None = None
    clock_hz: int = 0
    cpu_hz: int = 0
    cycles_per_instruction: Fraction | None = None
    flash: Region | None = None
    ram: Region | None = None
    uart: Uart | None = None
    unique_id: UniqueId | None = None
    emulator: Emulator | None = None
    interrupts: tuple[tuple[int, str], ...] = ()
    registers: tuple[tuple[str, int], ...] = ()
    memories: tuple[Memory, ...] = ()
    clocks_hook: str = ""
    watchdog_hook: str = ""
    stdio: Stdio | None = None
    provides: tuple[str, ...] = ()
    of_package: bool = False

    @property
    def cpu(self) -> Cpu:
        """What is known of the processor."""
        return next((part.cpu for part in self.parts if part.cpu is not None), Cpu())

    @property
    def os(self) -> Os:
        """What is known of the operating system."""
        return next((part.os for part in self.parts if part.os is not None), Os())

    @property
    def cpu_name(self) -> str:
        """The component of the processor, or of the operating system where none is named, for messages."""
        part = self.part("cpu") or self.part("os")
        return part.component.name if part is not None else "the target"

    @property
    def instructions_per_us(self) -> Fraction | None:
        """The least number of instructions in a microsecond; None: the target does not say."""
        hz = self.cpu_hz or self.clock_hz
        if self.cycles_per_instruction is None or not hz:
            return None
        return hz / (self.cycles_per_instruction * 1_000_000)

    def part(self, kind: str) -> Part | None:
        """Return the part of a kind."""
        return next((part for part in self.parts if part.kind == kind), None)

    @property
    def own_capabilities(self) -> tuple[str, ...]:
        """Capabilities that the target file leaves to the application: `provides`, its own UART, its own output."""
        uart = ("uart",) if self.uart_driver == OWN_DRIVER else ()
        output = ("stdio_put",) if self.stdio is not None and self.stdio.to == OWN_DRIVER else ()
        return (*self.provides, *uart, *output)

    @property
    def names_lines(self) -> bool:
        """Whether serial lines have names, and the operating system drives them."""
        return self.hosted or bool(self.os.device)

    @property
    def knows_memory(self) -> bool:
        """Whether the target says where flash and RAM are."""
        return self.flash is not None and self.ram is not None

    @property
    def has_image(self) -> bool:
        """Whether an image can be linked, or the library alone."""
        return self.hosted or (self.knows_memory and bool(self.os.linker_script))

    @property
    def is_narrow(self) -> bool:
        """Whether an interrupt can come between two bytes of a number."""
        return self.cpu.narrow

    @property
    def clock_wraps(self) -> bool:
        """Whether the 64-bit time of the platform counts milliseconds of 32 bits, and has to be read to see a wrap."""
        return self.os.clock_wraps

    @property
    def has_start_up(self) -> bool:
        """Whether the image begins with code of this project, and not with that of the C library."""
        return self.has_image and not self.hosted and not self.cpu.starts_itself

    @property
    def linker_script(self) -> str | None:
        """The path of the linker script below the output folder, where this project has the image's start-up."""
        os = self.part("os")
        if not self.has_start_up or os is None:
            return None
        return f"src/{os.component.name}/{self.os.linker_script}"

    def has_register(self, name: str) -> bool:
        """Whether the target says where `name` is."""
        return any(known == name for known, _ in self.registers)

    @property
    def memories_with_sections(self) -> tuple[Memory, ...]:
        """Further memories that hold sections of the program."""
        return tuple(memory for memory in self.memories if memory.sections)

    @property
    def stack_memory(self) -> str:
        """The name of the memory of the stack, as the linker script has it."""
        return next((memory.name.upper() for memory in self.memories if memory.has_stack), "RAM")

    @property
    def stack_region(self) -> Region | None:
        """The memory of the stack."""
        return next((memory.region for memory in self.memories if memory.has_stack), self.ram)

    @property
    def has_unique_id(self) -> bool:
        """Whether the port supplies a client key that no other device has (`session: {key: device}`)."""
        return self.has_id_words or self._always_provides("unique_id")

    @property
    def sends_console(self) -> bool:
        """Whether an interrupt or DMA sends the lines of the console, so that no call waits for them."""
        sends = self.stdio is not None and self.stdio.interrupt is not None
        return not self.hosted and (sends or self._always_provides("console_send"))

    def waits_for_room(self, transport: str) -> bool:
        """Return whether room in a transport that had none ends port_wait, with each part that may provide it.

        `transport` is a capability (udp, tcp, serial, canfd), or one that no part has.
        """
        provision = self._provision(transport)
        return provision is not None and provision.waits_for_room

    def wakes(self, transport: str) -> bool:
        """Return whether what arrives over a transport calls port_wake: then its handle is not one of the system.

        `transport` as in waits_for_room.
        """
        provision = self._provision(transport)
        return provision is not None and any(ask.capability == "wake" for ask in provision.asks)

    def _provision(self, transport: str) -> Provision | None:
        """Return what provides a transport; None: the application, or nothing."""
        if transport in self.own_capabilities:
            return None
        provisions = (p for part in self.parts for p in part.component.provides if p.capability == transport)
        return next((p for p in provisions if _has_file(p) or not p.waits_for_room), None)

    def _always_provides(self, capability: str) -> bool:
        named = {p.capability for part in self.parts for p in part.component.provides if _has_file(p)}
        return capability in (*named, *self.provides)

    @property
    def has_id_words(self) -> bool:
        """Whether the board has a number in its memory."""
        return self.unique_id is not None

    @property
    def uart_driver(self) -> str:
        """The driver of its serial line, or `none`: the application has one."""
        return self.uart.driver if self.uart else "none"


def _has_file(provision: Provision) -> bool:
    """Return whether a part has a capability in every plan."""
    return any(not file.when for file in provision.sources)
