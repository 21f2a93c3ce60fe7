# SPDX-License-Identifier: Apache-2.0
"""PlatformIO's side of the platform: no packages."""

from platformio.public import PlatformBase


class ThiscomputerPlatform(PlatformBase):  # type: ignore[misc]
    """A platform without packages."""
