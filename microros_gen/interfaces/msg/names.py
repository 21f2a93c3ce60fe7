# SPDX-License-Identifier: Apache-2.0
"""Which names ROS 2 Jazzy takes in a .msg file (rosidl_adapter), and which it cannot compile."""

from __future__ import annotations

import keyword
import re
from collections.abc import Collection

from microros_gen.interfaces.msg.fault import Caveat, Fault
from microros_gen.interfaces.types import FieldType, Primitive, Value, element_of

_LOWER = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*")
_UPPER = re.compile(r"[A-Z][A-Z0-9]*(?:_[A-Z0-9]+)*")
_CAMEL = re.compile(r"[A-Z][A-Za-z0-9]*")
_SAMPLE = "Sample_"
_SUFFIXES = ("_Request", "_Response", "_Goal", "_Result", "_Feedback")

_C99 = """auto break case char const continue default do double else enum extern float for goto if inline int
long register restrict return short signed sizeof static struct switch typedef union unsigned void volatile
while"""
_CPP17 = """alignas alignof and and_eq asm bitand bitor bool catch char16_t char32_t class compl const_cast
constexpr decltype delete dynamic_cast explicit export false friend mutable namespace new noexcept not not_eq
nullptr operator or or_eq private protected public reinterpret_cast static_assert static_cast template this
thread_local throw true try typeid typename using virtual wchar_t xor xor_eq"""

_PYTHON_LISTS = (Primitive.BOOL, Primitive.BYTE, Primitive.IDL_CHAR)  # of any other number: array.array
_MACROS = {
    "errno": "a macro of <errno.h>, which C++ of ROS 2 Jazzy includes: the file does not compile there",
    "linux": "a macro of compilers on Linux: the file does not compile there",
    "unix": "a macro of compilers on Linux: the file does not compile there",
}

_MACROS_C = """NULL EOF BUFSIZ RAND_MAX E2BIG EACCES EADDRINUSE EAGAIN EBADF EBUSY ECHILD ECONNREFUSED ECONNRESET
EDEADLK EDOM EEXIST EFAULT EFBIG EILSEQ EINPROGRESS EINTR EINVAL EIO EISDIR EMFILE EMSGSIZE ENODEV ENOENT ENOEXEC ENOMEM
ENOSPC ENOSYS ENOTCONN ENOTDIR ENOTEMPTY ENOTSUP ENOTTY ENXIO EOVERFLOW EPERM EPIPE EPROTO ERANGE EROFS ESPIPE ESRCH
ETIMEDOUT EWOULDBLOCK EXDEV"""
_LARGEST = re.compile(r"U?INT(?:_LEAST|_FAST)?(?:8|16|32|64|PTR|MAX)_M(?:AX|IN)|SIZE_MAX|PTRDIFF_M(?:AX|IN)")

C_KEYWORDS = frozenset(_C99.split())
"""ISO/IEC 9899:1999 6.4.1, those that a field's name can be (lower case, no leading underscore)."""

CPP_KEYWORDS = frozenset(_CPP17.split())
"""ISO/IEC 14882:2017 5.11 and its alternative tokens, without those of C99."""


CONSTANT_MACROS = frozenset(_MACROS_C.split())
"""Macros of the headers that C++ of ROS 2 Jazzy includes (ISO/IEC 9899:1999 7.5, 7.17, 7.19; POSIX <errno.h>)."""


def is_package_name(name: str) -> bool:
    """Return whether `name` can be a package: lower case, digits and single underscores, a letter first."""
    return _LOWER.fullmatch(name) is not None


def is_type_name(name: str) -> bool:
    """Return whether `name` can be a message type: CamelCase, or with an affix that rosidl makes."""
    name = name.removeprefix(_SAMPLE)
    for suffix in _SUFFIXES:
        name = name.removesuffix(suffix)
    return _CAMEL.fullmatch(name) is not None


def package_name_fault(name: str) -> Fault | None:
    """Return what is wrong with a package's name, or None."""
    if is_package_name(name):
        return None
    rule = "lower case letters, digits and single underscores, a letter first"
    return Fault(f"'{name}' is not a package name: {rule}", hint=None, id="MG-2020")


def type_name_fault(name: str) -> Fault | None:
    """Return what is wrong with a message type's name, or None."""
    if is_type_name(name):
        return None
    rule = "CamelCase, letters and digits only, a capital letter first"
    return Fault(f"'{name}' is not a message type: {rule}", hint=None, id="MG-2130")


def field_name_fault(name: str) -> Fault | None:
    """Return what is wrong with a field's name and a hint, or None."""
    if _LOWER.fullmatch(name) is None:
        rule = "lower case letters, digits and single underscores, a letter first, no underscore last"
        hint = _suggestion(_separated(name).lower(), _LOWER)
        return Fault(f"'{name}' is not a field name: {rule}", hint=hint, id="MG-2016")
    language = "C" if name in C_KEYWORDS else "C++" if name in CPP_KEYWORDS else None
    if language is not None:
        return Fault(
            f"'{name}' is a keyword of {language}, so no field can have this name",
            hint=f"For example '{name}_value'",
            id="MG-2131",
        )
    return None


def field_name_warning(name: str) -> Caveat | None:
    """Return a warning and its hint for a name that some nodes of ROS 2 cannot use, or None."""
    if name in _MACROS:
        return Caveat(f"'{name}' is {_MACROS[name]}", hint="Choose another name", id="MG-2014")
    if keyword.iskeyword(name):
        message = f"'{name}' is a keyword of Python: rclpy cannot use this message"
        return Caveat(message, hint="Choose another name", id="MG-2132")
    return None


def constant_name_warning(name: str) -> Caveat | None:
    """Return a warning and its hint for a constant whose name C++ takes for a macro, or None."""
    if name in CONSTANT_MACROS or _LARGEST.fullmatch(name) is not None:
        message = f"'{name}' is a macro of C: the C++ code that ROS 2 Jazzy generates does not compile"
        return Caveat(message, hint="Choose another name", id="MG-2013")
    return None


def interface_name_warning(name: str, parts: Collection[str]) -> Caveat | None:
    """Return a warning and its hint for a service or action that has the name of one of its parts, or None."""
    if name in {*parts, "Event"} and parts:
        message = f"the C++ code that ROS 2 Jazzy generates for an interface named '{name}' does not compile"
        return Caveat(message, hint="Rename it", id="MG-2025")
    return None


def value_warning(kind: FieldType, value: Value) -> Caveat | None:
    """Return a warning and its hint for a constant or default that rosidl_generator_py stops at, or None.

    C and C++ come out of it; Python, which a package has unless it leaves it out, does not.
    """
    if kind is Primitive.WCHAR:
        message = "ROS 2 Jazzy generates no Python code for a value of type wchar"
        return Caveat(message, hint="Use uint16, which has the same bytes", id="MG-2015")
    if kind is Primitive.IDL_CHAR and isinstance(value, int) and value < 0:
        message = "ROS 2 Jazzy generates no Python code for a char below 0"
        return Caveat(message, hint="Use int8, which has the same bytes", id="MG-2133")
    element = element_of(kind)
    if value == () and isinstance(element, Primitive) and element not in _PYTHON_LISTS:
        message = "ROS 2 Jazzy ignores an empty default in Python"
        return Caveat(message, hint="Remove it: it has no effect", id="MG-2134")
    return None


def constant_name_fault(name: str) -> Fault | None:
    """Return what is wrong with a constant's name and a hint, or None."""
    if _UPPER.fullmatch(name) is not None:
        return None
    rule = "upper case letters, digits and single underscores, a letter first, no underscore last"
    hint = _suggestion(_separated(name).upper(), _UPPER)
    return Fault(f"'{name}' is not a constant name: {rule}", hint=hint, id="MG-2135")


def _separated(name: str) -> str:
    """Return `camelCase` as `camel_Case`."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name)


def _suggestion(name: str, form: re.Pattern[str]) -> str | None:
    """Return a hint with the name nearest to `name` that has the form, or None if none exists."""
    if name[0] in "<[":
        return "The type and its size are written without a space"
    better = re.sub(r"_+", "_", re.sub(r"[^A-Za-z0-9]", "_", name)).strip("_")
    return f"For example '{better}'" if form.fullmatch(better) else None
