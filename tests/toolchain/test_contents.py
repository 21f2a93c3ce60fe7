# SPDX-License-Identifier: Apache-2.0
"""What of microros_config.h counts for an object: the lines whose names are in the code that it was made from."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.toolchain.contents import CONFIG, Contents, without_comments

SOURCE = "src/part.c"
CONFIG_TEXT = "#define SIZE 10u\n#define ROOM (SIZE + 1u)\n"


def digest(out: Path, source: str, config: str = CONFIG_TEXT) -> str:
    """Return the digest of what counts for an object of `source`, without that of its text."""
    for name, text in ((SOURCE, source), (CONFIG, config)):
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_text(text, encoding="utf-8")
    return Contents(out).of_files([SOURCE, CONFIG])


@pytest.mark.parametrize(
    "source",
    [
        "/* up to SIZE */ int a;\n",
        "int a; // ROOM\n",
        "/* 'SIZE\n * \"ROOM */\nint a;\n",
        'char b[] = "//"; /* SIZE */\n',
        "int a; // goes on \\\n with SIZE\n",
    ],
)
def test_a_name_in_a_comment_does_not_count(tmp_path: Path, source: str) -> None:
    assert digest(tmp_path, source) == digest(tmp_path, source, CONFIG_TEXT.replace("10u", "11u"))


@pytest.mark.parametrize(
    "source",
    [
        "int a = SIZE;\n",
        "int a = ROOM;\n",
        'char b[] = "/*"; int a = SIZE; /* */\n',
        "char b = '\"'; int a = SIZE; // \"\n",
        'char b[] = "\\"/*"; int a = SIZE; char c[] = "*/";\n',
        'char b[] = "\\\n/*"; int a = SIZE; char c[] = "*/";\n',
        "// don't\nint a = SIZE; // it's\n",
        "#error don't /* x */ SIZE\n",
        '#error "not closed /*\nint a = SIZE; /* */\n',
        "int a = 8 / SIZE / 2;\n",
    ],
)
def test_a_name_in_the_code_counts(tmp_path: Path, source: str) -> None:
    assert digest(tmp_path, source) != digest(tmp_path, source, CONFIG_TEXT.replace("10u", "11u"))


@settings(deadline=None)
@given(st.text(alphabet="/*\"'\\\n aS#", max_size=24))
def test_the_compiler_sees_no_name_that_is_left_out(text: str) -> None:
    """Every `S` that gcc's preprocessor replaces is in the text without comments."""
    compiler = shutil.which("gcc")
    if compiler is None:
        pytest.skip("no gcc")
    command = [compiler, "-std=c99", "-E", "-P", "-w", "-DS=replaced_by_it", "-x", "c", "-"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    assert done.stdout.count("replaced_by_it") <= len(re.findall(r"\bS\b", without_comments(text)))
