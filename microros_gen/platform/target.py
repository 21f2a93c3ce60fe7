# SPDX-License-Identifier: Apache-2.0
"""Targets: what the C compiler is told, and which port component the image stands on."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from microros_gen.records import dataclass

PORTS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"port_posix": (), "port_cortex_m": ("cmsdk", "nrf51"), "port_riscv": ("ns16550",)}
)
"""The components of layer `port`, and the drivers of serial lines that each has."""

OWN_DRIVER = "application"
"""The driver of a serial line that the application provides: the functions of microros/port_uart.h."""

REGISTERS: Mapping[str, tuple[str, ...]] = MappingProxyType({"port_riscv": ("mtime", "mtimecmp", "plic")})
"""Addresses that a port must know of a board besides those of its parts (RISC-V: ACLINT and PLIC)."""

OPTIONAL_REGISTERS = ("finisher",)
"""Further addresses that a board may have: a SiFive test device, which restarts it."""


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


@dataclass(frozen=True)
class Memory:
    """A further memory; `holds`: `stack`, `serial` (the rings of the line), or sections of the program (`.dma`)."""

    name: str
    region: Region
    holds: tuple[str, ...] = ()

    @property
    def sections(self) -> tuple[str, ...]:
        """Patterns of the sections that it holds, as a linker script names them."""
        rings = ("*(.bss.port_ring .bss.port_output)",) if "serial" in self.holds else ()
        return (*rings, *(f"*({name} {name}.*)" for name in self.holds if name.startswith(".")))

    @property
    def has_stack(self) -> bool:
        """Whether the stack is here."""
        return "stack" in self.holds


@dataclass(frozen=True)
class Stdio:
    """Where the C library's standard output goes: `to` is none, semihosting, uart or application.

    `driver`, `base` and `baud` are those of the uart; `floats`: newlib's printf formats %f.
    """

    to: str
    driver: str = "none"
    base: int = 0
    baud: int = 115_200
    floats: bool = False

    @property
    def memory(self) -> int:
        """Bytes that newlib may take with malloc: its streams need 436, the digits of a double up to 3,000 more."""
        return 4096 if self.floats else 512


@dataclass(frozen=True)
class Uart:
    """A serial interface of a board: `driver` names a source file of the port, `irq` its receive interrupt.

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

    `c_flags` apply to every file, `link_flags` to the image; `port` is a component of layer `port`. `hosted`:
    an operating system with standard input and output is below. A target without an operating system that knows
    its board has `flash` and `ram`, and so an image; without them it has the library alone. `clock_hz` counts the
    system timer. `interrupts` are handlers of the application by their number, `registers` addresses by name
    (REGISTERS). `memories` are those besides flash and RAM; the hooks are functions of the application, empty: none.
    `data_model` is lp64 or ilp32. `transport` is what holds where neither application nor profile say.
    """

    name: str
    summary: str
    port: str
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

    @property
    def has_image(self) -> bool:
        """Whether an image can be linked, or the library alone."""
        return self.hosted or (self.flash is not None and self.ram is not None)

    def has_register(self, name: str) -> bool:
        """Whether the target says where `name` is."""
        return any(known == name for known, _ in self.registers)

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
        return self.hosted or self.unique_id is not None

    @property
    def uart_driver(self) -> str:
        """The driver of its serial line, or `none`: the application has one."""
        return self.uart.driver if self.uart else "none"
