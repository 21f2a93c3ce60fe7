# SPDX-License-Identifier: Apache-2.0
"""`rate:` of publishers against the line: what they need, what is refused, and that what is proposed does."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest

from microros_gen import compiler
from microros_gen.agent.framing import encode_frame
from microros_gen.client.plan.line_load import LineLoad, fitting_rate_of_line, message_sizes, rate_text
from microros_gen.client.plan.line_media import can_frame_bits
from microros_gen.client.plan.streams import longest_frame, usual_frame
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from tests.support.command_line import Runner
from tests.support.paths import TESTS

IMU = "topic: imu/data, type: sensor_msgs/msg/Imu"
BEST_EFFORT = "qos: {reliability: best_effort}"
TEXT = """\
version: 1
profiles: [pure_sender]
transport: {{type: {transport}}}
limits: {{"*": {{string: 20}}}}
nodes:
  - name: imu
    publishers:
{publishers}
"""


def text_of(*publishers: str, transport: str = "serial") -> str:
    lines = "\n".join(f"      - {{{publisher}}}" for publisher in publishers)
    return TEXT.format(transport=transport, publishers=lines)


def planned(folder: Path, text: str) -> compiler.Planned:
    config = folder / "microros.yaml"
    config.write_text(text, encoding="utf-8")
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    return compiler.plan(compiler.resolve(compiler.read(options)))


def load_of(folder: Path, text: str) -> LineLoad:
    load = planned(folder, text).project.line
    assert load is not None
    return load


def refusal(folder: Path, text: str) -> str:
    with pytest.raises(UserError) as refused:
        planned(folder, text)
    (diagnostic,) = refused.value.diagnostics
    return diagnostic.headline()


def test_an_imu_at_100_hz_is_more_than_115200_baud_carry(tmp_path: Path) -> None:
    line = refusal(tmp_path, text_of(f"{IMU}, rate: 100 Hz, {BEST_EFFORT}"))
    assert line.endswith(
        "microros.yaml:8:60: error: the publishers with a rate need 36500 bytes/s, and the line carries 11520 with"
        " `baud: 115200` (/imu/data 36500). Write `rate: 31 Hz` at /imu/data or `transport: {baud: 460800}`, or lower"
        " the limits of the messages [MG-7130]"
    )


def test_what_is_proposed_is_enough_and_the_next_one_is_not(tmp_path: Path) -> None:
    others = "topic: count, type: std_msgs/msg/Int32, rate: 10 Hz"
    line = refusal(tmp_path, text_of(f"{IMU}, rate: 100 Hz", others))
    rate, baud = re.findall(r"rate: (\d+) Hz` at /imu/data or `transport: {baud: (\d+)}", line)[0]
    load_of(tmp_path, text_of(f"{IMU}, rate: {rate} Hz", others))
    assert "MG-7130" in refusal(tmp_path, text_of(f"{IMU}, rate: {int(rate) + 1} Hz", others))
    load_of(tmp_path, text_of(f"{IMU}, rate: 100 Hz", others, transport=f"serial, baud: {baud}"))
    slower = text_of(f"{IMU}, rate: 100 Hz", others, transport="serial, baud: 230400")
    assert "MG-7130" in refusal(tmp_path, slower)


def test_a_rate_below_one_hz_is_proposed_in_thousandths(tmp_path: Path) -> None:
    slow = text_of(f"{IMU}, rate: 10 Hz, {BEST_EFFORT}", transport="serial, baud: 1200")
    assert "`rate: 0.328 Hz`" in refusal(tmp_path, slow)
    load_of(tmp_path, slow.replace("rate: 10 Hz", "rate: 0.328 Hz"))
    assert "MG-7130" in refusal(tmp_path, slow.replace("rate: 10 Hz", "rate: 0.329 Hz"))


def test_where_the_others_need_all_of_it_only_the_baud_rate_helps(tmp_path: Path) -> None:
    both = [f"topic: {name}, type: sensor_msgs/msg/Imu, rate: 40 Hz, {BEST_EFFORT}" for name in ("a", "b")]
    line = refusal(tmp_path, text_of(*both))
    assert "Write `transport: {baud: 460800}`, or lower the limits" in line
    beyond = [f"topic: {name}, type: sensor_msgs/msg/Imu, rate: 5 kHz, {BEST_EFFORT}" for name in ("a", "b")]
    assert "Lower several rates" in refusal(tmp_path, text_of(*beyond))


def test_a_faster_line_has_more_heartbeats_and_still_carries_what_is_proposed(tmp_path: Path) -> None:
    """At 300 baud two messages of the MTU need a minute; the round trip, and with it the HEARTBEAT, follows."""
    line = refusal(
        tmp_path, text_of("topic: n, type: std_msgs/msg/Int32, rate: 40 Hz", transport="serial, baud: 300")
    )
    (baud,) = re.findall(r"baud: (\d+)}", line)
    text = text_of("topic: n, type: std_msgs/msg/Int32, rate: 40 Hz", transport=f"serial, baud: {baud}")
    load = load_of(tmp_path, text)
    assert load.fits
    assert load.heartbeats == Fraction(usual_frame(13) * 1000, load.heartbeat_ms)


def test_above_the_usual_rates_the_number_itself_is_proposed(tmp_path: Path) -> None:
    load = load_of(
        tmp_path, text_of(f"{IMU}, rate: 2 kHz, {BEST_EFFORT}", transport="serial, baud: 12000000")
    )
    assert fitting_rate_of_line(load, lambda _: 100) == math.ceil(load.load * 10) > 4_000_000


def test_the_numbers_are_in_resolve_and_in_what_generate_prints(tmp_path: Path, run: Runner) -> None:
    config = tmp_path / "microros.yaml"
    publishers = (f"{IMU}, rate: 25 Hz", "topic: other, type: std_msgs/msg/Int32")
    config.write_text(text_of(*publishers), encoding="utf-8")
    load = load_of(tmp_path, config.read_text(encoding="utf-8"))
    row = f"{math.ceil(load.load)} bytes/s of 11520"
    table = run("resolve", "-c", str(config)).out
    assert re.search(
        rf"^line +{row} +the largest message times rate of /imu/data, and 200 of HEARTBEAT; \d+ if",
        table,
        re.M,
    )
    assert "publishers without a rate: 1" in table
    assert re.search(
        rf"^line +{row} \(", run("generate", "-c", str(config), "-o", str(tmp_path / "out")).out, re.M
    )


def test_a_sealed_message_takes_its_record_too(tmp_path: Path) -> None:
    """32 bytes with each message: they count for the rates, and for how long the largest messages take."""
    device = "liveliness: ping\nsession: {key: 7}\n"

    def text(rate: str, more: str = "") -> str:
        count = f"topic: count, type: std_msgs/msg/Int32, rate: {rate}, {BEST_EFFORT}"
        return text_of(count, transport=f"serial{more}") + device

    assert load_of(tmp_path, text("200 Hz")).load == 200 * usual_frame(16)
    assert load_of(tmp_path, text("200 Hz", ", seal: psa")).load == 200 * usual_frame(16 + 32)
    load_of(tmp_path, text("400 Hz"))
    line = refusal(tmp_path, text("400 Hz", ", seal: psa"))
    (rate,) = re.findall(r"rate: (\d+) Hz` at /count or", line)
    load_of(tmp_path, text(f"{rate} Hz", ", seal: psa"))
    assert "MG-7130" in refusal(tmp_path, text(f"{int(rate) + 1} Hz", ", seal: psa"))
    slow = [planned(tmp_path, text("1 Hz", f", baud: 9600{seal}")) for seal in ("", ", seal: psa")]
    plain, sealed = (found.project.runtime.times.retry_first_ms for found in slow)
    assert 60 <= sealed - plain <= 70


def test_a_line_of_which_nothing_is_known_carries_everything(tmp_path: Path) -> None:
    load = load_of(tmp_path, text_of(f"{IMU}, rate: 100 kHz, {BEST_EFFORT}", transport="udp"))
    (publisher,) = load.publishers
    assert (load.medium.capacity, load.fits) == (None, True)
    assert load.text == f"{sum(publisher.messages) * 100_000} bytes/s"


def stuffed(bits: list[int]) -> int:
    """Return how many bits there are after one of the other value was put after each five equal ones."""
    sent: list[int] = []
    for bit in bits:
        sent.append(bit)
        if len(sent) >= 5 and len({*sent[-5:]}) == 1:
            sent.append(1 - bit)
    return len(sent)


@pytest.mark.parametrize(
    ("size", "data", "crc"), [(7, 8, 27), (11, 12, 27), (15, 16, 27), (16, 20, 32), (63, 64, 32)]
)
def test_a_frame_of_can_has_every_stuff_bit_that_is_possible(size: int, data: int, crc: int) -> None:
    before = 41 + 8 * data
    worst = [0, *(index // 4 % 2 for index in range(before - 1))]
    assert can_frame_bits(size) == stuffed(worst) + crc + 13
    random = Random(size)
    assert all(stuffed([random.getrandbits(1) for _ in range(before)]) < stuffed(worst) for _ in range(200))


def test_a_bus_carries_the_acknowledgements_of_the_agent_too(tmp_path: Path) -> None:
    """An Int32 is a message of 16 bytes, a frame of 20; HEARTBEAT and ACKNACK have 13 bytes, a frame of 16."""
    number = "topic: n, type: std_msgs/msg/Int32, rate: 100 Hz"
    bus = "canfd, id: 1, bitrate: 125000"
    load = load_of(tmp_path, text_of(number, transport=bus))
    sample, control = can_frame_bits(16), can_frame_bits(13)
    assert load.heartbeats == 2 * control * 10
    assert load.load == 100 * (sample + control) + load.heartbeats
    assert load.text == f"{load.load} bit/s of 125000"
    best_effort = load_of(tmp_path, text_of(f"{number}, {BEST_EFFORT}", transport=bus))
    assert best_effort.load == 100 * sample


def test_what_a_bus_does_not_carry_is_refused(tmp_path: Path) -> None:
    bus = "canfd, id: 1, bitrate: {}"
    fast = "topic: n, type: std_msgs/msg/Int32, rate: {} Hz"
    line = refusal(tmp_path, text_of(fast.format(1000), transport=bus.format(125_000)))
    assert "need 552020 bit/s, and the line carries 125000 with `bitrate: 125000`" in line
    rate, bitrate = re.findall(r"rate: (\d+) Hz` at /n or `transport: {bitrate: (\d+)}`", line)[0]
    load_of(tmp_path, text_of(fast.format(rate), transport=bus.format(125_000)))
    assert "MG-7130" in refusal(tmp_path, text_of(fast.format(int(rate) + 1), transport=bus.format(125_000)))
    load_of(tmp_path, text_of(fast.format(1000), transport=bus.format(bitrate)))
    assert "MG-7130" in refusal(tmp_path, text_of(fast.format(1000), transport=bus.format(500_000)))


def test_a_bit_rate_without_rates_is_reported(tmp_path: Path) -> None:
    number = "topic: n, type: std_msgs/msg/Int32"
    found = planned(tmp_path, text_of(number, transport="canfd, id: 1, bitrate: 125000"))
    assert [d.id for d in found.warnings if "bitrate" in d.message] == ["MG-7133"]


def test_a_rate_changes_nothing_that_is_generated(tmp_path: Path) -> None:
    without, with_rate = (planned(tmp_path, text_of(IMU + rate)) for rate in ("", ", rate: 10 Hz"))
    assert without.project.line is None
    assert without.project.runtime == with_rate.project.runtime


def test_what_does_not_use_the_line_does_not_count(tmp_path: Path) -> None:
    local = "topic: n, type: std_msgs/msg/Int32, local: only, rate: 1 kHz"
    subscriptions = "    subscriptions: [{topic: n, type: std_msgs/msg/Int32, local: only}]\n"
    text = text_of(local, f"{IMU}, rate: 10 Hz") + subscriptions
    found = planned(tmp_path, text.replace("pure_sender", "pure_sender, pure_reader"))
    assert found.project.line is not None
    assert [publisher.topic for publisher in found.project.line.publishers] == ["/imu/data"]
    assert any("'rate' of /n has no effect" in d.headline() and d.id == "MG-7131" for d in found.warnings)


def test_a_rate_below_the_promised_deadline_is_refused(tmp_path: Path) -> None:
    slow = "topic: n, type: std_msgs/msg/Int32, rate: 10 Hz, qos: {deadline: 30 ms}"
    assert refusal(tmp_path, text_of(slow)).endswith(
        "error: /n is published at 10 Hz and promises a deadline of 30 ms. Write a rate of 33.334 Hz or more, or a"
        " later deadline [MG-7132]"
    )
    load_of(tmp_path, text_of(slow.replace("10 Hz", "33.334 Hz")))


@pytest.mark.parametrize("rate", ["0 Hz", "0.000 kHz", "10", "10 MHz", "-1 Hz", "1e3 Hz"])
def test_what_is_no_rate_is_refused(tmp_path: Path, rate: str) -> None:
    assert "a rate above 0 such as 100 Hz or 1 kHz" in refusal(tmp_path, text_of(f"{IMU}, rate: {rate}"))


@pytest.mark.parametrize(
    ("rate", "text"),
    [
        (Fraction(100), "100 Hz"),
        (Fraction(1, 3), "0.333 Hz"),
        (Fraction(3, 2), "1.5 Hz"),
        (Fraction(1000), "1000 Hz"),
    ],
)
def test_rates_are_written_with_at_most_three_decimals(rate: Fraction, text: str) -> None:
    assert rate_text(rate) == text


def test_a_message_is_as_long_as_the_recorded_ones() -> None:
    recorded = (TESTS / "exchanges" / "golden" / "best_effort.txt").read_text(encoding="utf-8").splitlines()
    samples = [line.split()[2] for line in recorded if re.search(r" > 8101....0701", line)]
    assert {len(sample) // 2 for sample in samples} == {*message_sizes(4, 512)} == {16}


@pytest.mark.parametrize("body", [1, 495, 496, 497, 500, 501, 1000, 1004, 1005, 4999])
def test_fragments_carry_the_whole_submessage(body: int) -> None:
    """Each has a message header and that of FRAGMENT, as xrce_stream_reliable_fragments.c sends them."""
    sizes = message_sizes(body, 512)
    if 4 + 4 + 4 + body <= 512:
        assert sizes == (12 + body,)
    else:
        assert sum(size - 8 for size in sizes) == 4 + 4 + body
        assert all(size == 512 for size in sizes[:-1])
        assert 8 < sizes[-1] <= 512


def test_a_frame_is_rarely_longer_than_the_usual_one_and_never_than_the_longest() -> None:
    random = Random(1)
    frames = [encode_frame(random.randbytes(size), 1) for size in range(40, 500)]
    assert sum(len(frame) for frame in frames) <= sum(usual_frame(size) for size in range(40, 500))
    assert all(len(frame) <= longest_frame(size) for frame, size in zip(frames, range(40, 500), strict=True))
    assert len(encode_frame(b"\x7e" * 100, 1)) >= 1 + 2 * 100
