# SPDX-License-Identifier: Apache-2.0
"""The parts of the plan that components bring by themselves."""

from __future__ import annotations

from microros_gen.records import dataclass


@dataclass(frozen=True)
class FeatureSlice:
    """What a component plans for itself, `value`; `record` is what of it changes the plan id, as plain data."""

    component: str
    value: object
    record: str


@dataclass(frozen=True)
class Features:
    """The slices of the selected components, in the order of the components."""

    slices: tuple[FeatureSlice, ...] = ()

    def of(self, component: str) -> object:
        """Return the slice of a component; None: it has none."""
        return next((part.value for part in self.slices if part.component == component), None)

    @property
    def records(self) -> dict[str, str]:
        """What of each slice changes the plan id."""
        return {part.component: part.record for part in self.slices}


NO_FEATURES = Features()
"""Those of a plan whose components have no slices."""
