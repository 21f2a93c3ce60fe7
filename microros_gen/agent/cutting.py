# SPDX-License-Identifier: Apache-2.0
"""Decoding of the samples of one WRITE_DATA, in as many turns of its client as it takes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

from microros_gen.agent.wire.cdr import Reader
from microros_gen.agent.wire.samples import Sample, cut_samples

SAMPLES: Final = 16
"""Number of samples between two checks whether the turn is over."""


class TurnOverError(Exception):
    """The turn of a client ended within a submessage of which `done` samples are processed."""

    def __init__(self, done: int) -> None:
        super().__init__(done)
        self.done = done


class Cutting:
    """The samples decoded so far; none is processed before all are decoded."""

    def __init__(self, data: bytes, at: int, reader: Reader, form: int) -> None:
        """Start at `reader`, which is at the samples of the submessage with its payload at `data[at]`."""
        self._data = data
        self._at = at
        self._coming = cut_samples(reader, form)
        self._cut: list[Sample] = []

    def is_of(self, data: bytes, at: int) -> bool:
        """Return whether the samples are those of the submessage with its payload at `data[at]`."""
        return self._data is data and self._at == at

    def go_on(self, over: Callable[[], bool], done: int) -> Sequence[Sample]:
        """Return all samples, of which `done` are processed. Raises TurnOverError if the turn is `over` earlier."""
        for sample in self._coming:
            self._cut.append(sample)
            if len(self._cut) % SAMPLES == 0 and over():
                raise TurnOverError(done)
        return self._cut
