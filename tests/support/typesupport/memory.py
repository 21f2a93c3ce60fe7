# SPDX-License-Identifier: Apache-2.0
"""Counts blocks of memory that generated functions take."""

from __future__ import annotations

import ctypes

ALLOCATE = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p)
DEALLOCATE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)
REALLOCATE = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p)
ZERO_ALLOCATE = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_size_t, ctypes.c_size_t, ctypes.c_void_p)


class Allocator(ctypes.Structure):
    _fields_ = (
        ("allocate", ALLOCATE),
        ("deallocate", DEALLOCATE),
        ("reallocate", REALLOCATE),
        ("zero_allocate", ZERO_ALLOCATE),
        ("state", ctypes.c_void_p),
    )


class Memory:
    """Counts blocks of the C library's allocator, and fails when `left` allocations are used up.

    Blocks of `foreign` are left alone, as by the arena; without `grows` no block changes its size.
    """

    def __init__(self) -> None:
        self.live: set[int] = set()
        self.left = 1 << 30
        self.grows = True
        self.foreign: set[int] = set()
        libc = ctypes.CDLL(None)
        for function in (libc.malloc, libc.calloc, libc.realloc):
            function.restype = ctypes.c_void_p
        self._libc = libc
        self.allocator = Allocator(
            ALLOCATE(lambda size, _: self._new(libc.malloc(ctypes.c_size_t(size)))),
            DEALLOCATE(lambda block, _: self._free(block)),
            REALLOCATE(lambda block, size, _: self._grow(block, size)),
            ZERO_ALLOCATE(
                lambda n, size, _: self._new(libc.calloc(ctypes.c_size_t(n), ctypes.c_size_t(size)))
            ),
            None,
        )

    def _new(self, block: int) -> int | None:
        if self.left == 0:
            self._libc.free(ctypes.c_void_p(block))
            return None
        self.left -= 1
        self.live.add(block)
        return block

    def _free(self, block: int | None) -> None:
        if block and block not in self.foreign:
            self.live.remove(block)
            self._libc.free(ctypes.c_void_p(block))

    def _grow(self, block: int | None, size: int) -> int | None:
        if self.left == 0 or not self.grows:
            return None
        self.left -= 1
        self.live.discard(block or 0)
        grown = self._libc.realloc(ctypes.c_void_p(block), ctypes.c_size_t(size))
        self.live.add(grown)
        return int(grown)
