# SPDX-License-Identifier: Apache-2.0
"""The page of the error texts of the C library, from a library with every component that can be built."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from generators.markdown import table
from microros_gen.selection.find_components import load_catalogue

_APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [{components}]
errors: text
pools: {{publishers: 1, subscriptions: 1, services: 1, clients: 1}}
"""
_TEXT = re.compile(
    r'^const MICROROS_FLASH char microros_error_(\w+)\[\] =\s*((?:"[^"\n]*"(?: XRCE_\w+)?\s*)+);',
    re.MULTILINE,
)
_INTRODUCTION = """\
# Error texts

After a failed call, `rcl_get_error_string()` has the text of the error (`errors: text`, the default) or `E` and
its number (`errors: code`, which saves flash). `E01` is an error that the application set. In the texts, `%s` is a
name, `%d` a detail, `%n` what was found and `%m` what fits; the library replaces them.
"""


def page() -> str:
    """Return the page: the number of each error, and its text."""
    texts = dict(_TEXT.findall(_sources("error_text*.c")))
    errors = [error for component in load_catalogue().values() for error in component.contributes.errors]
    rows = [
        (f"E{error.code:02}", f"`{_shown(error.text) if error.text else _words(texts[error.name])}`")
        for error in sorted(errors, key=lambda error: error.code)
    ]
    return _INTRODUCTION + "\n" + table(("number", "text"), rows) + "\n"


def _shown(text: str) -> str:
    return text.replace("|", "\\|")


def _words(literals: str) -> str:
    """Return what the string literals say; a macro between them is where the agent is."""
    text = re.sub(r'"\s*XRCE_PLACE_\w+\s*"|"\s*XRCE_PLACE_\w+\s*$', "AGENT", literals.strip())
    return re.sub(r'"\s*"|^"|"$', "", text.replace('AGENT"', "AGENT")).replace("|", "\\|")


def _sources(files: str) -> str:
    """Return the named files, with texts, of a library with every component of the micro-ROS layer."""
    components = load_catalogue().values()
    # One that opens endpoints in nodes is left out: its texts are in its component.yaml.
    found = (c for c in components if not any(endpoint.every_node for endpoint in c.implies))
    ready = [c.name for c in found if c.ready and c.layer == "micro-ROS"]
    text = _APPLICATION.format(components=", ".join(f"+{name}" for name in ready))
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "microros.yaml").write_text(text, encoding="utf-8", newline="\n")
        command = [sys.executable, "-m", "microros_gen", "generate", "-c", f"{folder}/microros.yaml"]
        done = subprocess.run([*command, "-o", f"{folder}/out"], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return "".join(p.read_text(encoding="utf-8") for p in sorted(Path(folder, "out").rglob(files)))
