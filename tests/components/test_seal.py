# SPDX-License-Identifier: Apache-2.0
"""Sealed messages in an application file: what is selected, and what they exclude."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from tests.support.components.rendered import UNITS, planned, run

POOLS = "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\n"
KEY, PING = "session: {key: 7}\n", "liveliness: ping\n"
PSA = "transport: {seal: psa}\n"


@pytest.mark.parametrize("provider", ["psa", "application"])
def test_files_of_each_provider(tmp_path: Path, provider: str) -> None:
    config, out = tmp_path / "microros.yaml", tmp_path / "out"
    config.write_text(POOLS + KEY + PING + PSA.replace("psa", provider))
    compiler.generate(compiler.Options(config=config, interface_paths=(shipped_folder(),)), out)
    sources = (out / "sources.txt").read_text().split()
    assert ("src/seal/seal_psa.c" in sources) == (provider == "psa")
    assert "src/seal/xrce_noise.c" in sources
    assert json.loads((out / "manifest.json").read_text())["features"]["seal"]["values"]["seal"] == provider
    readme = (out / "README.md").read_text()
    assert "bool microros_seal_psk(" in readme
    assert ("bool microros_seal_agree(" in readme) == (provider == "application")


def test_without_seal_nothing_of_it_is_in_the_output(tmp_path: Path) -> None:
    config, out = tmp_path / "microros.yaml", tmp_path / "out"
    config.write_text(POOLS)
    compiler.generate(compiler.Options(config=config, interface_paths=(shipped_folder(),)), out)
    assert "seal/" not in (out / "sources.txt").read_text()


@pytest.mark.parametrize(
    ("line", "flags", "name"),
    [
        ("target: qemu-mps2-an386\ntransport: {type: serial, seal: application}\n", (), "the serial line"),
        (
            "transport: {type: serial, device: /dev/ttyS7, seal: application}\n",
            ("-DSEAL_HAS_DEVICE",),
            "/dev/ttyS7",
        ),
    ],
    ids=["board", "host"],
)
def test_texts_name_the_other_end(tmp_path: Path, line: str, flags: tuple[str, ...], name: str) -> None:
    """The line of a board has no name: without one, a text has a gap."""
    config, out = tmp_path / "microros.yaml", tmp_path / "out"
    config.write_text(POOLS + KEY + PING + line)
    compiler.generate(compiler.Options(config=config, interface_paths=(shipped_folder(),)), out)
    sources = [out / "src" / part for part in ("seal/rmw_seal.c", "support/error_texts.c")]
    unit = UNITS / "unit_seal_place.c"
    run(
        "gcc",
        "-std=c99",
        "-w",
        *flags,
        f"-I{out / 'include'}",
        f"-I{UNITS}",
        unit,
        *sources,
        "-o",
        tmp_path / "unit",
    )
    assert run(tmp_path / "unit").split("\n")[:-1] == [name] * 3


@pytest.mark.parametrize(
    ("application", "identifier"),
    [
        (POOLS + KEY + PING + "components: [+seal]\n", "MG-3260"),
        (POOLS + PING + PSA, "MG-3261"),
        (POOLS + "session: {key: device}\n" + PING + PSA, "MG-3261"),
        (POOLS + KEY + "liveliness: none\n" + PSA, "MG-3262"),
        (POOLS + KEY + PING + PSA + "components: [+sleep_cycles]\n", "MG-3263"),
        (POOLS + KEY + PING + "transport: {seal: psa, agent: discover}\n", "MG-3263"),
        (POOLS + KEY + PING + "transport: {type: custom, seal: psa}\n", "MG-3014"),
        (POOLS + KEY + PING + "transport: {type: canfd, id: 5, seal: psa}\n", "MG-3014"),
        (POOLS + KEY + PING + PSA + "target: ./own.yaml\n", "MG-3275"),
        (POOLS + KEY + PING + "transport: {mtu: 65500, seal: psa}\n", "MG-3270"),
        (POOLS + KEY + PING + "transport: {type: tcp, mtu: 65502, seal: psa}\n", "MG-3270"),
        (POOLS + KEY + PING + "transport: {type: serial, mtu: 65504, seal: psa}\n", "MG-3270"),
        (POOLS + KEY + PING + "transport: {seal: aes}\n", None),
    ],
)
def test_what_contradicts_sealed_messages(tmp_path: Path, application: str, identifier: str | None) -> None:
    own = "target: own\nsummary: a host with a custom transport\nextends: host\ntransport: custom\n"
    (tmp_path / "own.yaml").write_text(own)
    with pytest.raises(UserError) as caught:
        planned(tmp_path, application)
    found = [diagnostic.id for diagnostic in caught.value.diagnostics]
    assert identifier in found if identifier else found
