# SPDX-License-Identifier: Apache-2.0
"""The filter of a time source as a program, a clock that drifts, and a model of the filter in floating point."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from microros_gen.selection.find_components import load_catalogue
from tests.support.components.rendered import UNITS, run
from tests.support.patience import seconds

SECOND_NS = 1_000_000_000
EPOCH_NS = 1_790_000_000 * SECOND_NS
_SANITIZE = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
_WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Werror")


@dataclass(frozen=True)
class Clock:
    """A source whose seconds are shorter by `ppm` than the device's, in integers."""

    ppm: int
    start_ns: int = EPOCH_NS

    def at(self, local_ns: int) -> int:
        """Return its time."""
        return self.start_ns + local_ns + local_ns * self.ppm // 1_000_000


@dataclass(frozen=True)
class Sample:
    """What a source said when the device's clock was `local_ns`."""

    local_ns: int
    reference_ns: int
    uncertainty_ns: int


@dataclass(frozen=True)
class Result:
    """What the program printed for each order."""

    lines: tuple[tuple[int, ...], ...]

    def taken(self, index: int) -> bool:
        """Return whether a sample was taken."""
        return self.lines[index] == (1,)

    def served(self, index: int) -> int:
        """Return the time of a reading."""
        return self.lines[index][0]

    def estimate(self, index: int) -> int:
        """Return the estimate of a reading."""
        return self.lines[index][1]

    def uncertainty(self, index: int) -> int:
        """Return its standard deviation."""
        return self.lines[index][2]

    @property
    def drift_ppb(self) -> int:
        """Return the drift at the end."""
        return self.lines[-1][0]

    @property
    def counts(self) -> tuple[int, ...]:
        """Return the numbers of samples, outliers and steps at the end."""
        return self.lines[-1][1:]


@dataclass
class Filter:
    """Orders for a program; each method returns the position of what it will print."""

    path: Path
    orders: list[str] = field(default_factory=list)

    @staticmethod
    def program(folder: Path, slew_ppm: int, step_us: int) -> Path:
        """Compile the filter alone, with sanitizers."""
        config = f"#define MICROROS_TIME_SLEW_PPM {slew_ppm}u\n#define MICROROS_TIME_STEP_US {step_us}u\n"
        (folder / "microros_config.h").write_text(config)
        component = load_catalogue()["time_source"].folder
        source = component / "src" / "xrce_time_filter.c"
        includes = (f"-I{folder}", f"-I{component / 'include'}")
        flags = ("-std=c99", "-O1", *_WARNINGS, *_SANITIZE, *includes)
        target = folder / "filter"
        run("gcc", *flags, UNITS / "unit_time_filter.c", source, "-o", target)
        return target

    def _order(self, *words: str | int) -> int:
        self.orders.append(" ".join(str(word) for word in words))
        return len(self.orders) - 1

    def sample(self, sample: Sample, now_ns: int | None = None) -> int:
        """Give a sample, at its own time or later."""
        now_ns = sample.local_ns if now_ns is None else now_ns
        return self._order("s", sample.local_ns, sample.reference_ns, sample.uncertainty_ns, now_ns)

    def read(self, now_ns: int) -> int:
        """Read the time."""
        return self._order("r", now_ns)

    def sleep(self) -> int:
        """Let the device sleep."""
        return self._order("w")

    def run(self) -> Result:
        """Run all orders."""
        text = "\n".join([*self.orders, "d"]) + "\n"
        done = subprocess.run(
            [self.path], input=text, capture_output=True, text=True, timeout=seconds(60), check=False
        )
        assert done.returncode == 0, done.stderr
        lines = done.stdout.splitlines()
        return Result(tuple(tuple(int(word) for word in line.split() if word != "-") for line in lines))


def estimates(samples: Iterable[Sample]) -> list[tuple[float, float]]:
    """Return offset (ns, from the first sample's) and drift (ppb) after each sample, by matrices of real numbers.

    The same model as the filter's (drift as a random walk, 10 ppb after a second), written down independently of it.
    """
    found: list[tuple[float, float]] = []
    first: Sample | None = None
    local, offset, drift = 0, 0.0, 0.0
    covariance = [[0.0, 0.0], [0.0, 1e5**2]]
    for sample in samples:
        noise = max(sample.uncertainty_ns, 1000.0) ** 2
        if first is None:
            first, local = sample, sample.local_ns
            covariance[0][0] = noise
            found.append((0.0, 0.0))
            continue
        passed = (sample.local_ns - local) / SECOND_NS
        local = sample.local_ns
        offset += drift * passed
        (a, b), (c, d) = covariance
        d += 100.0 * passed
        a, b, c = a + passed * (b + c) + passed * passed * d, b + passed * d, c + passed * d
        measured = sample.reference_ns - sample.local_ns - (first.reference_ns - first.local_ns)
        residual, total = measured - offset, a + noise
        offset, drift = offset + a / total * residual, drift + c / total * residual
        covariance = [[a - a * a / total, b - a * b / total], [c - c * a / total, d - c * b / total]]
        found.append((offset, drift))
    return found
