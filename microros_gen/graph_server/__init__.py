# SPDX-License-Identifier: Apache-2.0
"""The graph server of D1.4 (4.7.5, 4.7.12): answers queries of the ROS graph by service, page by page."""
