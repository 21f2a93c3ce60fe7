# SPDX-License-Identifier: Apache-2.0
"""The XRCE client of one application: its plan and its views."""
