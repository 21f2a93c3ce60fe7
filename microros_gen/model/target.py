# SPDX-License-Identifier: Apache-2.0
"""Targets: what the C compiler is told, and which port component the image stands on."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Region:
    """A part of the address space: where it begins and how many bytes it has."""

    origin: int
    size: int


@dataclass(frozen=True)
class Uart:
    """A serial interface of a board: `driver` names a source file of the port, `irq` is -1 where it is polled."""

    driver: str
    base: int
    irq: int = -1


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
    system timer. `data_model` is lp64 or ilp32. `transport` is what holds where neither application nor profile say.
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

    @property
    def has_image(self) -> bool:
        """Whether an image can be linked, or the library alone."""
        return self.hosted or (self.flash is not None and self.ram is not None)

    @property
    def uart_driver(self) -> str:
        """The driver of its serial line, or `none`: the application has one."""
        return self.uart.driver if self.uart else "none"
