# SPDX-License-Identifier: Apache-2.0
"""Part of `make golden`: rewrites the golden copies of the applications of tests/golden.

`make golden` and a look at the difference belong to every change of what is generated.
"""

from __future__ import annotations

import sys

from tests.support.golden import GOLDEN, applications, make_copies


def main() -> int:
    """Write what differs, remove what is no longer generated."""
    copies = make_copies()
    changed = copies.write()
    print(f"{GOLDEN}: {len(applications())} applications, {len(copies.files)} files, {changed} changed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
