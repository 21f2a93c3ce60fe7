# SPDX-License-Identifier: Apache-2.0
"""Runs the tool chain: compiles the output folder to a library and an image, and measures them."""
