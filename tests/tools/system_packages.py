# SPDX-License-Identifier: Apache-2.0
"""Looks for the programs that the suite runs; installs their Debian packages when it may, else says how to."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

# program or file → Debian package
NEEDED = {
    "gcc": "gcc",
    "clang": "clang",
    "clang-format": "clang-format",
    "clang-tidy": "clang-tidy",
    "cppcheck": "cppcheck",
    "cmake": "cmake",
    "ninja": "ninja-build",
    "g++": "g++",
    "arm-none-eabi-gcc": "gcc-arm-none-eabi",
    "/usr/lib/arm-none-eabi/newlib/nano.specs": "libnewlib-arm-none-eabi",
    "qemu-system-arm": "qemu-system-arm",
    "qemu-system-riscv32": "qemu-system-misc",
    "riscv64-unknown-elf-gcc": "gcc-riscv64-unknown-elf",
    "/usr/lib/picolibc/riscv64-unknown-elf/picolibc.specs": "picolibc-riscv64-unknown-elf",
    "avr-gcc": "gcc-avr",
    "/usr/lib/avr/include/avr/io.h": "avr-libc",
    "/usr/include/simavr/sim_avr.h": "libsimavr-dev",
    "xtensa-lx106-elf-gcc": "gcc-xtensa-lx106",
    "/usr/lib/xtensa-lx106-elf/include/stdint.h": "picolibc-xtensa-lx106-elf",
    "arduino-builder": "arduino-builder",
    "/usr/share/arduino/hardware/arduino/avr/boards.txt": "arduino-core-avr",
    "/usr/include/libelf.h": "libelf-dev",
    "/usr/include/psa/crypto.h": "libmbedtls-dev",
    "make": "make",
    "zsh": "zsh",
    "fish": "fish",
    "tcc": "tcc",
    "tcpdump": "tcpdump",
    "/usr/sbin/logrotate": "logrotate",
    "nm": "binutils",
    "valgrind": "valgrind",
    "frama-c": "frama-c-base",
    "qemu-ppc": "qemu-user",
    "powerpc-linux-gnu-ld": "binutils-powerpc-linux-gnu",
    "/usr/powerpc-linux-gnu/lib/libc.a": "libc6-dev-powerpc-cross",
    "arm-linux-gnueabihf-ld": "binutils-arm-linux-gnueabihf",
    "/usr/arm-linux-gnueabihf/lib/libc.a": "libc6-dev-armhf-cross",
}
# What clang links for other targets. Debian's cross gcc itself must not be there besides gcc-multilib.
CROSS = {"powerpc-linux-gnu": "powerpc", "arm-linux-gnueabihf": "armhf"}
MULTILIB = "gcc-multilib"


def missing_packages() -> list[str]:
    """Return the Debian packages to install, sorted."""
    missing = {package for program, package in NEEDED.items() if not _is_there(program)}
    if shutil.which("chromium") is None and _is_debian():
        missing.add("chromium")
    if shutil.which("gcc") is None or not _links_32_bit():
        missing |= {MULTILIB, "g++-multilib"}
    return sorted(missing | _missing_libgcc() | _missing_sanitizers())


def _is_debian() -> bool:
    """Return whether this is Debian itself: Ubuntu's package of Chromium installs a snap."""
    release = Path("/etc/os-release")
    return release.exists() and "ID=debian\n" in release.read_text(encoding="utf-8")


def _is_there(name: str) -> bool:
    if name.startswith("/"):  # where Debian puts it; others know best
        return Path(name).exists() or not Path("/etc/debian_version").exists()
    return shutil.which(name) is not None


def _missing_libgcc() -> set[str]:
    """Return the packages with gcc's own library for other targets; their name has the version of Debian's gcc."""
    release = Path("/usr/lib/gcc/x86_64-linux-gnu")
    versions = [int(path.name) for path in release.glob("*") if path.name.isdigit()]
    if not Path("/etc/debian_version").exists() or not versions:
        return set()
    installed = {path.parent.parent.name for path in Path("/usr/lib/gcc-cross").glob("*/*/libgcc.a")}
    return {
        f"libgcc-{max(versions)}-dev-{CROSS[target]}-cross" for target in CROSS if target not in installed
    }


def _missing_sanitizers() -> set[str]:
    """Return the package of clang's sanitizers, which clang only recommends; its name has clang's version."""
    if shutil.which("clang") is None or not Path("/etc/debian_version").exists():
        return set()
    link = ["clang", "-fsanitize=address,undefined", "-x", "c", "-", "-o", os.devnull]
    source = "int main(void) { return 0; }\n"
    if subprocess.run(link, input=source, text=True, capture_output=True, check=False).returncode == 0:
        return set()
    version = subprocess.run(["clang", "-dumpversion"], text=True, capture_output=True, check=True).stdout
    return {f"libclang-rt-{version.split('.')[0]}-dev"}


def _links_32_bit() -> bool:
    test = ["g++", "-m32", "-x", "c++", "-", "-o", os.devnull]
    if shutil.which("g++") is None:
        return False
    source = "#include <cstdint>\nint main() { return 0; }\n"
    return subprocess.run(test, input=source, text=True, capture_output=True, check=False).returncode == 0


def main() -> int:
    """Install or tell; 0 when nothing is missing afterwards."""
    for _ in range(2):  # what a compiler needs besides is known once it is there
        packages = missing_packages()
        if packages and _install(packages) != 0:
            return 2
    return 0


def _install(packages: list[str]) -> int:
    command = ["apt-get", "install", "-y", "--no-install-recommends", *packages]
    may = Path("/etc/debian_version").exists() and hasattr(os, "geteuid") and os.geteuid() == 0
    if not may:
        print("The suite needs some packages. Install them with:\n  sudo " + " ".join(command))
        return 2
    print("Installing " + " ".join(packages) + " ...", flush=True)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for step in (["apt-get", "update", "-qq"], command):
        result = subprocess.run(step, env=environment, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            print(result.stdout + result.stderr)
            print("Installing them failed; the command was:\n  " + " ".join(step))
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
