# SPDX-License-Identifier: Apache-2.0
"""The time of a simulation: publishes /clock, which stands still, runs at another speed, and is set."""
