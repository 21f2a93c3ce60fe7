# SPDX-License-Identifier: Apache-2.0
"""A file of references."""

from __future__ import annotations

INT32 = "std_msgs::msg::dds_::Int32_"
PROFILES = f"""<?xml version="1.0" encoding="UTF-8"?>
<profiles>
  <participant profile_name="participant_profile"><rtps><name>counter</name></rtps></participant>
  <topic profile_name="count__t"><kind>NO_KEY</kind><name>rt/count</name><dataType>{INT32}</dataType></topic>
  <data_writer profile_name="count__dw">
    <topic><kind>NO_KEY</kind><name>rt/count</name><dataType>{INT32}</dataType>
      <historyQos><kind>KEEP_LAST</kind><depth>10</depth></historyQos></topic>
    <qos><durability><kind>VOLATILE</kind></durability><reliability><kind>RELIABLE</kind></reliability></qos>
  </data_writer>
</profiles>
"""
