# SPDX-License-Identifier: Apache-2.0
"""A device that seals its messages, over Mbed TLS: a program of live.c, and the agent's file of keys."""

from __future__ import annotations

import time
from pathlib import Path

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.agent.observer import Observer
from tests.support.e2e.images import C_FILES, POOLS, run
from tests.support.e2e.live import Live
from tests.support.patience import deadline
from tests.support.runtime.harness import SANITIZE, SANITIZER, Tree, compile_merged

KEY = 0x77
PSK, OTHER = bytes(range(32)).hex(), bytes(range(1, 33)).hex()
"""Pre-shared keys as 64 hexadecimal digits."""
_APPLICATION = f"""\
{POOLS}\
liveliness: ping
transport: {{transport}}
session:
  key: {KEY}
  liveliness_period: 200 ms
  round_trip: 50 ms
  liveliness_timeout: 4 s
  retry_max: 400 ms
  connect_timeout: 3 s
  create_timeout: 5 s
"""


def sealed_program(folder: Path, transport: str, *flags: str, agent: str | None = None) -> Path:
    """Return the program of live.c for a transport of the application file; it takes its key from SEAL_PSK.

    `agent`: its address where `transport` has none. `flags`: further arguments of the compiler.
    """
    config, out, program = folder / "microros.yaml", folder / "out", folder / "live"
    config.write_text(_APPLICATION.replace("{transport}", transport))
    compiler.generate(compiler.Options(config=config, interface_paths=(shipped_folder(),), agent=agent), out)
    sources = [out / name for name in (out / "sources.txt").read_text(encoding="utf-8").split()]
    own = [C_FILES / name for name in ("live.c", "seal_key.c")]
    all_flags = (*SANITIZE, "-std=c99", "-Wno-error", "-DLIVE_PING", *flags)
    objects = compile_merged(Tree(out, ()), sources, own, SANITIZER, all_flags)
    command = [SANITIZER, *SANITIZE, *map(str, objects), "-lmbedcrypto", "-o", str(program)]
    done = run(command, timeout_s=240)
    assert done.returncode == 0, done.stderr
    return program


def write_keys(file: Path, keys: dict[int, str]) -> None:
    """Write a file of keys that only this user may open."""
    file.write_text("".join(f"{client:#x} {key}\n" for client, key in keys.items()))
    file.chmod(0o600)


def begin(live: Live, port: int | str) -> None:
    """Open a session with the agent at `port` (-: as the plan says), and a publisher on /chatter."""
    for command in (f"open {KEY} {port}", "node 0 talker -", "publisher 0 0 Int32 chatter reliable"):
        live.ok(command)


def wait_until_it_arrives(live: Live, observer: Observer, first: int) -> None:
    """Publish numbers from `first` on until one arrives."""
    end = deadline(20)
    while not [v for _, v in observer.ask(do="samples") if v["data"] >= first]:
        assert time.monotonic() < end, "no sample arrives"
        live.call(f"publish 0 {first}")
        time.sleep(0.05)
        live.call("flush 500")
