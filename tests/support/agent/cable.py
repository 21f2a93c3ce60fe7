# SPDX-License-Identifier: Apache-2.0
"""A serial line on a pseudo-terminal."""

from __future__ import annotations

import os


class Cable:
    """A pseudo-terminal: `device` for the agent, `end` for the client; pulling it closes both."""

    def __init__(self) -> None:
        self.end, self._slave = os.openpty()
        self.device = os.ttyname(self._slave)

    def pull(self) -> None:
        os.close(self.end)
        os.close(self._slave)
