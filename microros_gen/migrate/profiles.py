# SPDX-License-Identifier: Apache-2.0
"""Which built-in profiles `init` proposes: their files say what they consist of, and no name of one is known here."""

from __future__ import annotations

from collections.abc import Collection

from microros_gen.application.kinds import KINDS
from microros_gen.records import dataclass
from microros_gen.selection.component import Profile
from microros_gen.selection.find_profiles import load_builtin_profiles

_NODE = "node"


@dataclass(frozen=True)
class Proposed:
    """Names of profiles, and the components that they have."""

    names: tuple[str, ...]
    components: frozenset[str]


def first_profile() -> str:
    """Return the first built-in profile in lists."""
    return next(iter(load_builtin_profiles()))


def profiles_of(kinds: Collection[str]) -> Proposed:
    """Return the profiles of a node that has entities of these kinds (`publisher`) and nothing else.

    For each kind that is the first profile of just a node and the kind's component; some kinds have none.
    """
    builtin = load_builtin_profiles().values()
    found: dict[str, Profile] = {}
    for kind in KINDS:
        if kind.name in kinds:
            plain = (profile for profile in builtin if _is_plain(profile, kind.component))
            found.update({profile.name: profile for profile in (next(plain, None),) if profile is not None})
    return Proposed(tuple(found), frozenset(c.name for profile in found.values() for c in profile.components))


def _is_plain(profile: Profile, component: str) -> bool:
    components = {change.name for change in profile.components}
    return components == {_NODE, component} and not profile.extends and not profile.axes
