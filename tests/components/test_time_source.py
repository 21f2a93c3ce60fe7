# SPDX-License-Identifier: Apache-2.0
"""The filter of a time source against simulated clocks and a model in floating point, and the key `time_source`."""

from __future__ import annotations

import random
from pathlib import Path
from statistics import median

import pytest

from microros_gen import compiler
from microros_gen.components.time_source.plan import NEVER_US, TimeSourcePlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned
from tests.support.components.time_filter import EPOCH_NS, SECOND_NS, Clock, Filter, Sample, estimates

MS = 1_000_000
JITTER_NS = 20 * MS
BARE = "version: 1\nprofiles: [pure_sender]\nnodes: [{name: n}]\ncomponents: [+time_source]\n"


@pytest.fixture(scope="module")
def slewing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Filter.program(tmp_path_factory.mktemp("slewing"), slew_ppm=500, step_us=NEVER_US)


@pytest.fixture(scope="module")
def stepping(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Filter.program(tmp_path_factory.mktemp("stepping"), slew_ppm=100_000, step_us=1_000_000)


def hour(seed: int, clock: Clock) -> list[Sample]:
    """Return the samples of an hour, one in 10 s, each wrong by 20 ms at most."""
    rng = random.Random(seed)
    times = [at_s * SECOND_NS + rng.randrange(SECOND_NS) for at_s in range(5, 3606, 10)]
    return [Sample(t, clock.at(t) + rng.randint(-JITTER_NS, JITTER_NS), JITTER_NS) for t in times]


@pytest.mark.parametrize("ppm", [-50, 50])
def test_an_hour_at_50_ppm_and_20_ms_of_jitter(slewing: Path, ppm: int) -> None:
    """The figure of docs/verification/figures.md."""
    clock, errors, newest = Clock(ppm), list[int](), list[int]()
    for seed in range(20):
        samples = hour(seed, clock)
        newest.append(abs(samples[-1].reference_ns - clock.at(samples[-1].local_ns)))
        found = Filter(slewing)
        for sample in samples:
            found.sample(sample)
        end = samples[-1].local_ns
        last = found.read(end)
        result = found.run()
        assert result.counts == (len(samples), 0, 0)
        assert result.drift_ppb == pytest.approx(ppm * 1000, abs=2000)
        errors.append(abs(result.served(last) - clock.at(end)))
        model_offset, model_drift = estimates(samples)[-1]
        start = samples[0].reference_ns - samples[0].local_ns
        assert result.estimate(last) == pytest.approx(end + start + model_offset, abs=50_000, rel=0)
        assert result.drift_ppb == pytest.approx(model_drift, abs=50)
    for what, found_errors in (("filter", errors), ("newest sample", newest)):
        median_ms, worst_ms = median(found_errors) / MS, max(found_errors) / MS
        print(f"{ppm} ppm, {what}: median {median_ms:.1f} ms, worst of 20 {worst_ms:.1f} ms")
    assert median(errors) < 2 * MS
    assert max(errors) < 5 * MS


def test_every_estimate_is_that_of_the_model(slewing: Path) -> None:
    """Uneven times, uncertainties from 1 us to 1 s, each sample as good as it says."""
    rng, clock, samples, local = random.Random(5), Clock(-80), list[Sample](), 7 * SECOND_NS
    for _ in range(400):
        uncertainty = round(10 ** rng.uniform(3, 9))
        samples.append(Sample(local, clock.at(local) + round(rng.gauss(0, 0.5) * uncertainty), uncertainty))
        local += round(10 ** rng.uniform(8, 11.5))
    found = Filter(slewing)
    reads = []
    for sample in samples:
        found.sample(sample)
        reads.append(found.read(sample.local_ns))
    result = found.run()
    start = samples[0].reference_ns - samples[0].local_ns
    assert result.counts[1] == 0
    for sample, read, (offset, _) in zip(samples, reads, estimates(samples), strict=True):
        tolerance = max(20_000, result.uncertainty(read) // 10)
        assert result.estimate(read) - sample.local_ns - start == pytest.approx(offset, abs=tolerance)


def test_it_never_goes_back(slewing: Path) -> None:
    """Readings a nanosecond apart and far apart, while the source jumps by hours in both directions."""
    rng, found, local, reads = random.Random(1), Filter(slewing), SECOND_NS, list[int]()
    shift = 0
    for turn in range(300):
        if turn % 25 == 24:
            shift = rng.randint(-4, 4) * 3_600 * SECOND_NS
        found.sample(Sample(local, EPOCH_NS + local + shift + rng.randint(-MS, MS), MS))
        for _ in range(20):
            reads.append(found.read(local))
            local += rng.choice((1, 1, 2, 999, SECOND_NS // 3, 40 * SECOND_NS))
        local += 1
    result = found.run()
    times = [result.served(read) for read in reads]
    assert times == sorted(times)
    assert result.counts[2] == 0
    assert result.counts[1] >= 7 * 8, "each jump is an outlier first"


def test_a_wrong_time_is_slewed_at_the_declared_rate(slewing: Path) -> None:
    clock, found = Clock(0), Filter(slewing)
    for at in range(30):
        found.sample(Sample(at * SECOND_NS + 1, clock.at(at * SECOND_NS + 1), 1000))
    for at in range(30, 60):
        found.sample(Sample(at * SECOND_NS + 1, clock.at(at * SECOND_NS + 1) - 50 * MS, 1000))
    reads = {at: found.read(at * SECOND_NS + 1) for at in (60, 80, 100, 140, 200)}
    result = found.run()
    pending = {at: result.served(index) - result.estimate(index) for at, index in reads.items()}
    assert result.counts == (53, 7, 0)
    assert pending[60] == pytest.approx(50 * MS - 23 * MS // 2, abs=MS), (
        "500 us a second since the eighth outlier"
    )
    assert pending[60] - pending[80] == pytest.approx(20 * MS // 2, abs=1000)
    assert pending[140] == pending[200] == 0


def test_from_a_declared_error_on_the_time_is_set(stepping: Path) -> None:
    clock, found = Clock(0), Filter(stepping)
    before = after = 0
    for at in range(1, 40):
        local = at * SECOND_NS
        shift = 0 if at <= 10 else -2 * SECOND_NS if at <= 25 else -2 * SECOND_NS + 900 * MS
        if at == 18:
            before = found.read(local)
        found.sample(Sample(local, clock.at(local) + shift, 1000))
        if at == 18:
            after = found.read(local)
    end = found.read(60 * SECOND_NS)
    result = found.run()
    assert result.served(before) - result.served(after) == 2 * SECOND_NS
    assert result.counts == (39 - 14, 14, 1), "900 ms are less than the declared second"
    assert abs(result.served(end) - clock.at(60 * SECOND_NS) + 1100 * MS) < MS


def test_a_single_outlier_changes_nothing(slewing: Path) -> None:
    clock, found = Clock(50), Filter(slewing)
    for at in range(1, 200):
        wrong = 3600 * SECOND_NS if at % 50 == 0 else 300 * MS if at % 30 == 0 else 0
        found.sample(Sample(at * SECOND_NS, clock.at(at * SECOND_NS) + wrong, MS))
    end = found.read(200 * SECOND_NS)
    result = found.run()
    assert result.counts == (199 - 8, 8, 0)
    assert abs(result.served(end) - clock.at(200 * SECOND_NS)) < MS // 10


def test_without_its_source_the_learned_drift_goes_on(slewing: Path) -> None:
    clock, found = Clock(50), Filter(slewing)
    samples = hour(3, clock)
    for sample in samples:
        found.sample(sample)
    end = samples[-1].local_ns
    ages = (0, 600, 3600, 86_400)
    reads = [found.read(end + age * SECOND_NS) for age in ages]
    result = found.run()
    doubts = [result.uncertainty(read) for read in reads]
    assert doubts == sorted(doubts)
    assert doubts[0] < doubts[1] < doubts[2] < doubts[3]
    for age, read, doubt in zip(ages, reads, doubts, strict=True):
        error = abs(result.served(read) - clock.at(end + age * SECOND_NS))
        assert error < 4 * doubt
    assert abs(result.served(reads[2]) - clock.at(end + 3600 * SECOND_NS)) < 8 * MS, (
        "180 ms without the drift"
    )


def test_over_a_sleep_the_drift_is_kept_and_the_time_is_not(slewing: Path) -> None:
    clock, found = Clock(50), Filter(slewing)
    samples = hour(4, clock)
    for sample in samples:
        found.sample(sample)
    found.sleep()
    began = samples[-1].local_ns + 10
    slept = Clock(50, EPOCH_NS + 8 * 3600 * SECOND_NS)
    found.sample(Sample(began, slept.at(began), 1000))
    reads = [found.read(began + age * SECOND_NS) for age in (0, 600)]
    result = found.run()
    assert result.served(reads[0]) == slept.at(began)
    assert abs(result.served(reads[1]) - slept.at(began + 600 * SECOND_NS)) < 2 * MS, (
        "30 ms without the drift"
    )


def test_numbers_at_every_limit(slewing: Path, stepping: Path) -> None:
    """Sanitizers see every overflow; counts are those of the orders."""
    for program in (slewing, stepping):
        rng, found, local, count = random.Random(9), Filter(program), 0, 0
        for _ in range(3000):
            local += rng.choice((1, 1000, SECOND_NS, 10**13, 10**15))
            reference = rng.choice((0, EPOCH_NS, EPOCH_NS + local, (1 << 62) - 1, rng.randrange(1 << 62)))
            uncertainty = rng.choice((0, 1, 10**3, 10**6, 10**9))
            if local > 3 * 10**18:
                found.sleep()
                local = 1
            found.sample(Sample(local, reference, uncertainty), local + rng.choice((0, 1, 10**9)))
            found.read(local + rng.choice((10**9, 10**15)))
            count += 1
        accepted, rejected, _ = found.run().counts
        assert accepted + rejected == count


def part_of(found: compiler.Planned) -> TimeSourcePlan:
    part = found.project.runtime.features.of("time_source")
    assert isinstance(part, TimeSourcePlan)
    return part


@pytest.mark.parametrize(
    ("key", "expected"),
    [
        ("", (10_000, 500, NEVER_US, 60_000)),
        ("time_source: {}", (10_000, 500, NEVER_US, 60_000)),
        ("time_source: {period: 1 s, slew_ppm: 7, step: 250 ms}", (1_000, 7, 250_000, 60_000)),
        ("time_source: {period: 100 s}", (100_000, 500, NEVER_US, 600_000)),
        ("time_source: {source: application, holdover: 90 s}", (0, 500, NEVER_US, 90_000)),
    ],
)
def test_the_key(tmp_path: Path, key: str, expected: tuple[int, ...]) -> None:
    part = part_of(planned(tmp_path, f"{BARE}{key}\n"))
    assert (part.period_ms, part.slew_ppm, part.step_us, part.holdover_ms) == expected


@pytest.mark.parametrize(
    ("key", "identifier", "hint"),
    [
        ("{source: application, period: 1 s}", "MG-3210", "Remove it"),
        ("{period: 1 ms}", "MG-3211", "Write period: 10 s"),
        ("{step: 1 us}", "MG-3211", "Write step: 1 s"),
        ("{holdover: 10 ms}", "MG-3211", "Write holdover: 60 s"),
        ("{period: 10 s, holdover: 9 s}", "MG-9865", "Write holdover: 60 s"),
        ("{holdover: 9999 ms}", "MG-9865", "Write holdover: 60 s"),
        ("{perod: 1 s}", "MG-1002", "Did you mean 'period'?"),
    ],
)
def test_mistakes_have_place_and_hint(tmp_path: Path, key: str, identifier: str, hint: str) -> None:
    with pytest.raises(UserError) as error:
        planned(tmp_path, f"{BARE}time_source: {key}\n")
    (found,) = error.value.diagnostics
    assert found.id == identifier
    assert found.span is not None
    assert hint in (found.hint or "")


ALONE = """\
version: 1
profiles: [pure_sender]
components: [+time_source]
nodes: [{name: n, publishers: [{topic: a, type: std_msgs/msg/Int32, local: only}],
         subscriptions: [{topic: a, type: std_msgs/msg/Int32, local: only}]}]
"""


@pytest.mark.parametrize(
    ("text", "place"),
    [
        (f"{ALONE}time_source: {{period: 1 s}}\n", "6:14"),
        (ALONE, "3:1"),
        (
            f"{BARE}time_source: {{source: agent}}\n".replace("+time_source", "+time_source, +agentless"),
            "5:14",
        ),
    ],
)
def test_an_image_without_an_agent_has_no_one_to_ask(tmp_path: Path, text: str, place: str) -> None:
    with pytest.raises(UserError) as error:
        planned(tmp_path, text)
    (found,) = error.value.diagnostics
    assert (found.id, found.span and f"{found.span.line}:{found.span.column}") == ("MG-3215", place)
    assert found.hint == "Write time_source: {source: application}, or drop the component time_source"


@pytest.mark.parametrize(
    "text",
    [
        f"{ALONE}time_source: {{source: application}}\n",
        ALONE.replace("local: only}", "local: also}", 1),
        ALONE.replace("nodes: [", "nodes: [{name: m, publishers: [{topic: b, type: std_msgs/msg/Int32}]}, "),
        ALONE.replace("[+time_source]", "[+time_source, +logging, +logging_rosout]"),
    ],
)
def test_one_with_an_agent_or_with_its_own_source_is_planned(tmp_path: Path, text: str) -> None:
    assert part_of(planned(tmp_path, text)).slew_ppm == 500


def test_the_key_needs_the_component(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="needs the component 'time_source', which nothing selects"):
        planned(
            tmp_path,
            f"{BARE.replace(', +time_source', '').replace('[+time_source]', '[]')}time_source: {{}}\n",
        )
