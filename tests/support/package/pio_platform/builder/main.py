# SPDX-License-Identifier: Apache-2.0
"""SCons script of the platform."""

from SCons.Script import Default, DefaultEnvironment

env = DefaultEnvironment()
env.Replace(CC="gcc", CXX="g++", AR="ar", RANLIB="ranlib", LINK="g++", PROGNAME="program")
env.Append(CCFLAGS=["-Wall", "-Werror", "-ffunction-sections"], LINKFLAGS=["-Wl,--gc-sections"])
Default(env.BuildProgram())
