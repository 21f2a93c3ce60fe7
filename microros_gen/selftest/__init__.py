# SPDX-License-Identifier: Apache-2.0
"""The self-test of an output folder: checks of the port's functions, and round trips of the message types."""
