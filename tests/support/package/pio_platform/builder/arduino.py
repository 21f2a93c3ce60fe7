# SPDX-License-Identifier: Apache-2.0
"""SCons script of the framework: the functions of Arduino on this computer (MICROROS_ARDUINO_HOST names the folder)."""

import os

from SCons.Script import DefaultEnvironment

env = DefaultEnvironment()
folder = os.environ["MICROROS_ARDUINO_HOST"]
env.Append(CPPPATH=[folder], CPPDEFINES=[("ARDUINO", 10819), ("MICRO_ROS_CLIENT_KEY", 0x12345678)])
env.Append(LIBS=[env.BuildLibrary("$BUILD_DIR/arduino", folder)])
