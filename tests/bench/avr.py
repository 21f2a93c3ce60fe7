# SPDX-License-Identifier: Apache-2.0
"""What images for an Arduino take: flash, RAM and the stack that `size` proves, on an ATmega328P and an ATmega2560."""

from __future__ import annotations

from pathlib import Path

from tests.support.firmware.avr import ANSWERS, EXCHANGES, MEGA, READS, SENDS, UNO, bounded, flash_and_ram
from tests.support.firmware.board import Builds

IMAGES = (
    ("sender of Int32, best effort", SENDS),
    ("the same with texts of errors", SENDS.replace("errors: code", "errors: text")),
    ("reader of Int32", READS),
    ("publisher, subscription, timer, executor", EXCHANGES),
    ("server of SetBool, executor", ANSWERS),
)


def bench_avr(folder: Path) -> None:
    """Print one line an image."""
    builds = Builds(folder)
    print(
        "avr: the generated example, `errors: code`; flash / RAM without the stack / worst stack with an interrupt"
    )
    print(f"  {'':44}{'ATmega328P':>24}{'ATmega2560':>24}")
    for label, application in IMAGES:
        cells = []
        for board in (UNO, MEGA):
            if board == UNO and application == ANSWERS:
                cells.append("the stack has no room")  # `build` refuses it (MG-8608)
                continue
            built = builds.build(board, application)
            flash, ram = flash_and_ram(built, built.image)
            cells.append(f"{flash:,} / {ram:,} / {bounded(built, built.image)[0]:,}")
        print(f"  {label:44}" + "".join(f"{cell:>24}" for cell in cells))
    print()
