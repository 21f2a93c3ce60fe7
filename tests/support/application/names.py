# SPDX-License-Identifier: Apache-2.0
"""Names for ROS 2's judges and for ours."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hypothesis import strategies as st

CHARACTERS = "aZ_09/~{}- é"
NAMES = st.one_of(
    st.text(CHARACTERS, max_size=12),
    st.lists(
        st.sampled_from(
            ["a", "b1", "_", "/", "~", "~/", "{node}", "{ns}", "{namespace}", "{", "}", "{x}", "9", "//"]
        ),
        max_size=6,
    ).map("".join),
    st.integers(240, 260).map(lambda n: "a" * n),
    st.integers(240, 260).map(lambda n: "/" + "a" * n),
)


def accepted(judge: Callable[[str], Any], name: str) -> bool:
    try:
        judge(name)
    except Exception:
        return False
    return True
