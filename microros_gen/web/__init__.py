# SPDX-License-Identifier: Apache-2.0
"""A small HTTP server for pages and data of running programs."""
