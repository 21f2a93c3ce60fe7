# SPDX-License-Identifier: Apache-2.0
"""C type support of messages: the plan (capacities, wire, storage) and its views."""
