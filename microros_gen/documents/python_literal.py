# SPDX-License-Identifier: Apache-2.0
"""Reads a Python literal from a text that somebody else wrote."""

from __future__ import annotations

import ast
import warnings
from typing import Any


def python_literal(text: str) -> Any:
    """Return the value of a literal (number, string, tuple, list). Raises ValueError for anything else.

    What Python itself warns of, such as an unknown escape, is for whoever wrote `text` and not for the terminal.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.literal_eval(text)
    except (SyntaxError, ValueError, TypeError, MemoryError, RecursionError) as error:
        raise ValueError("no literal of Python") from error
