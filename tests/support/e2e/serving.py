# SPDX-License-Identifier: Apache-2.0
"""Waits for lines and replies of an image that serves."""

from __future__ import annotations

import subprocess
import time

from tests.support.agent.observer import Observer
from tests.support.patience import deadline


def await_line(process: subprocess.Popen[str], beginning: str) -> str:
    assert process.stdout is not None
    line = process.stdout.readline()
    assert line.startswith(beginning), line
    return line


def await_replies(observer: Observer) -> list[list[int]]:
    end = deadline(15)
    while None in (replies := observer.ask(do="replies")):
        assert time.monotonic() < end, replies
        time.sleep(0.02)
    return list(replies)
