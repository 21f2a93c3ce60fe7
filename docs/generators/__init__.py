# SPDX-License-Identifier: Apache-2.0
"""Pages of the site that are made from the code: command line, YAML files, C API. Text in, Markdown out."""

from __future__ import annotations
