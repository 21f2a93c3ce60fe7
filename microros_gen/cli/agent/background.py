# SPDX-License-Identifier: Apache-2.0
"""Work of the agent in threads that it starts and ends."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def in_background(name: str, run: Callable[[], object], stop: Callable[[], object]) -> Iterator[None]:
    """Run `run` in a thread while the block runs; then call `stop`, and wait until `run` has returned."""
    thread = threading.Thread(target=run, name=name, daemon=True)
    thread.start()
    try:
        yield
    finally:
        stop()
        thread.join()
