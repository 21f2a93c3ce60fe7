# SPDX-License-Identifier: Apache-2.0
"""The DDS-XRCE wire format (OMG DDS-XRCE 1.0, formal/2020-02-01, clause 8): messages, submessages and CDR. No state."""
