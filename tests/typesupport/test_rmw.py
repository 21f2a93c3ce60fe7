# SPDX-License-Identifier: Apache-2.0
"""rmw_serialize and rmw_deserialize of a generated library against rclpy, for every message type of the wheels."""

from __future__ import annotations

import ctypes
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from microros_gen.application.model import LimitRule
from microros_gen.cli import main as cli
from tests.support.slices import first
from tests.support.typesupport import cdr
from tests.support.typesupport.build import Generated, generate, run
from tests.support.typesupport.decoder import Decoder
from tests.support.typesupport.encoder import with_python
from tests.support.typesupport.padding import padding
from tests.support.typesupport.values import CStructs, Randomizer, to_ros

pytestmark = [pytest.mark.ros, pytest.mark.builds]

rclpy_serialization = pytest.importorskip("rclpy.serialization")

# So that each message of the wheels fits a message of XRCE.
LIMITS = LimitRule(("*",), string=13, sequence=3)
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+cdr_decode]
interfaces: [{packages}]
pools: {{publishers: 1}}
transport: {{type: udp, mtu: 60000}}
limits: {{"*": {{string: 13, sequence: 3}}}}
"""
SOURCES = ("*__type_support.c", "*__decode.c", "*__storage.c", "*__functions.c")
FOLDERS = ("cdr_decode", "memory", "rosidl_runtime")
SAMPLES = {"short": ("full", "random"), "all": ("empty", "full", "random", "random")}
LONG_SAMPLES = ("empty", "full", *("random",) * 200)
LITTLE, BIG = b"\0\1\0\0", b"\0\0\0\0"
MARK = 16


class Serialized(ctypes.Structure):
    """rmw_serialized_message_t; its allocator is all zero, so that no call may allocate."""

    _fields_ = (
        ("buffer", ctypes.c_void_p),
        ("buffer_length", ctypes.c_size_t),
        ("buffer_capacity", ctypes.c_size_t),
        ("allocator", ctypes.c_void_p * 5),
    )


@dataclass(frozen=True)
class Product:
    """What `generate` wrote, compiled, and the plan of the same types."""

    library: ctypes.CDLL
    generated: Generated


@pytest.fixture(scope="module")
def product(packages: list[str], tmp_path_factory: pytest.TempPathFactory) -> Product:
    """Every interface of the wheels in one application."""
    folder = tmp_path_factory.mktemp("rmw")
    config, out = folder / "microros.yaml", folder / "out"
    config.write_text(APPLICATION.format(packages=", ".join(packages)))
    with pytest.raises(SystemExit) as end:
        cli.main(["generate", "-c", str(config), "-o", str(out)])
    assert end.value.code == 0
    generated = generate(packages, (LIMITS,), tmp_path_factory.mktemp("rmw_plan"))
    return Product(compiled(out), generated)


def compiled(out: Path) -> ctypes.CDLL:
    """Compile the types at once, and what the functions of rmw call."""
    types = sorted(path for ending in SOURCES for path in (out / "src").rglob(ending))
    unity = out / "types.c"
    unity.write_text("".join(f'#include "{path}"\n' for path in types))
    others = [path for name in FOLDERS for path in sorted((out / "src" / name).glob("*.c"))]
    others += [out / "src/publish/rmw_serialize.c", *sorted((out / "src/support").glob("error_*.c"))]
    others += [*sorted((out / "src/cdr").glob("*.c")), *sorted((out / "src/write").glob("rmw_encode_*.c"))]
    library = out / "types.so"
    options = ["-std=c99", "-O0", "-fPIC", "-shared", "-Wl,-Bsymbolic", f"-I{out / 'include'}"]
    # tcc takes a twentieth of the time of gcc.
    run(["tcc" if shutil.which("tcc") else "gcc", *options, unity, *others, "-o", library])
    return ctypes.CDLL(str(library))


class Functions:
    """The functions of rmw for one type."""

    def __init__(self, product: Product, c_name: str) -> None:
        get = product.library[f"rosidl_typesupport_c__get_message_type_support_handle__{c_name}"]
        get.restype = ctypes.c_void_p
        self._handle = ctypes.c_void_p(get())
        self._library = product.library

    def serialize(self, message: Any) -> bytes:
        """Return encapsulation and body, from a buffer of the size that was told before."""
        size = ctypes.c_size_t()
        reported = self._library.rmw_uros_get_serialized_message_size
        assert reported(ctypes.byref(message), self._handle, ctypes.byref(size)) == 0
        room = ctypes.create_string_buffer(b"\xa5" * (size.value + MARK), size.value + MARK)
        into = Serialized(ctypes.addressof(room), 0, size.value)
        assert self._library.rmw_serialize(ctypes.byref(message), self._handle, ctypes.byref(into)) == 0
        assert into.buffer_length == size.value
        assert room.raw[size.value :] == b"\xa5" * MARK, "wrote behind the buffer"
        return room.raw[: size.value]

    def deserialize(self, data: bytes, message: Any) -> bool:
        """Read encapsulation and body into a message that has storage."""
        room = ctypes.create_string_buffer(data, len(data))
        whole = Serialized(ctypes.addressof(room), len(data), len(data))
        return bool(
            self._library.rmw_deserialize(ctypes.byref(whole), self._handle, ctypes.byref(message)) == 0
        )


def check_samples(product: Product, samples: tuple[str, ...]) -> int:
    """Serialize and deserialize samples of each type; return how many messages."""
    generated = product.generated
    structs, compared = CStructs(generated.messages), 0
    for seed, plan in enumerate(with_python(generated)):
        source = Randomizer(generated.messages, 4000 + seed)
        functions, decoder = Functions(product, plan.c_name), Decoder(product.library, generated, plan)
        for mode in samples:
            tree = source.tree(plan.name, plan.limits, mode)
            written = functions.serialize(structs.fill(plan.name, tree))
            theirs = rclpy_serialization.serialize_message(to_ros(generated.messages, plan.name, tree))
            length, gaps = padding(generated.messages, plan.name, tree)
            expected = bytearray(theirs[: len(LITTLE) + length])
            for gap in gaps:
                expected[len(LITTLE) + gap] = 0
            assert written == expected, (plan.name, mode)
            big = BIG + cdr.encode(generated.messages, plan.name, tree, True)
            for data in (theirs, big):
                message = decoder.bind()
                assert functions.deserialize(data, message), (plan.name, mode)
                assert decoder.structs.read(plan.name, message) == tree, (plan.name, mode)
            compared += 1
    return compared


@pytest.mark.parametrize("samples", first(SAMPLES.values()), ids=SAMPLES)
def test_rmw_writes_and_reads_what_ros_does(product: Product, samples: tuple[str, ...]) -> None:
    """Encapsulation and body are rclpy's (padding zero); rclpy's bytes give the contents back, in both byte orders."""
    assert check_samples(product, samples) > 200 * len(samples)


@pytest.mark.parametrize("bits", ["7fc00000", "ffc00001", "7f800001", "7fffffff", "80000000"])
def test_no_bit_of_a_number_is_lost(product: Product, bits: str) -> None:
    """What is not a number keeps its sign and payload, also what would signal."""
    data = LITTLE + bytes.fromhex(bits)[::-1]
    plan = product.generated.plan("std_msgs/msg/Float32")
    functions, message = Functions(product, plan.c_name), ctypes.c_uint32()
    assert functions.deserialize(data, message)
    assert f"{message.value:08x}" == bits
    assert functions.serialize(message) == data
    assert functions.deserialize(BIG + bytes.fromhex(bits), message)
    assert f"{message.value:08x}" == bits


@pytest.mark.long
def test_rmw_writes_and_reads_what_ros_does_200_times(product: Product) -> None:
    assert check_samples(product, LONG_SAMPLES) > 200 * len(LONG_SAMPLES)
