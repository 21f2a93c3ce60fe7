# SPDX-License-Identifier: Apache-2.0
"""The profile managed_service alone, with each setting of `entities`; tests/firmware builds it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.patience import seconds
from tests.support.profile_with_diagnostics import ENTITIES
from tests.support.slices import only


@pytest.mark.parametrize("entities", only({"binary", "reference"}, ENTITIES))
def test_the_profile_alone_has_a_service_and_a_managed_publisher(tmp_path: Path, entities: str) -> None:
    """Its node has a state, a service of the program, and a publisher that the state silences."""
    config = tmp_path / "microros.yaml"
    config.write_text(f"version: 1\nprofiles: [managed_service]\nentities: {entities}\n", encoding="utf-8")
    generated = compiler.generate(
        compiler.Options(config=config, interface_paths=(shipped_folder(),)), tmp_path / "out"
    )
    example = generated.out / "examples" / "managed_service" / "main.c"
    text = example.read_text(encoding="utf-8")
    assert 'ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool), "set_bool");' in text
    assert "rclc_executor_add_service(" in text
    assert "rclc_lifecycle_init_change_state_server(" in text
    assert "rcl_publish(&publisher_1, &int32_1, NULL)" in text
    (node,) = generated.planned.resolved.request.application.nodes
    own = {e.topic: (e.kind, e.managed) for e in node.endpoints if not e.of_the_library}
    assert own == {"set_bool": ("service", False), "count": ("publisher", True)}
    assert (generated.out / "src" / "lifecycle" / "xrce_gate.c").is_file(), "the gate of managed publishers"
    command = [
        "gcc",
        "-std=c99",
        *WARNINGS,
        "-Werror",
        f"-I{generated.out / 'include'}",
        "-fsyntax-only",
        str(example),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=seconds(60))
    assert done.returncode == 0, done.stderr
