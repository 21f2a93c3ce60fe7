/* SPDX-License-Identifier: Apache-2.0 */
/* Empty: some sketches include a file of this name. The transport is in micro_ros_arduino_wifi.h. */
