# SPDX-License-Identifier: Apache-2.0
"""Arguments that leave out what a test does not need."""

from __future__ import annotations

import re

NOT_NEEDED = re.compile(
    r"_*(v?f?s?n?i?printf|puts|putchar|malloc|calloc|realloc|free|_?sbrk|impure_ptr|_?exit|abort|atexit|signal|raise"
    r"|libc_init_array|libc_fini_array|init|fini|start|errno|assert_func|udivdi3|divdi3|aeabi_.?ldivmod)(_r)?"
)
