# SPDX-License-Identifier: Apache-2.0
"""Targets: what the C compiler is told, and which port component the image stands on."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Target:
    """A target. `compilers` are tried in order; `package` names the Debian package that brings the first.

    `c_flags` apply to every file, `link_flags` to the image; `port` is a component of layer `port`. `hosted`:
    an operating system with standard input and output is below.
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
