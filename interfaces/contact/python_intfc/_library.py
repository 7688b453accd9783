# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Loads the library from ../bin and passes Python's values to it."""
import ctypes
import os
import platform

import numpy as np

_name = "contact_addon_win64.dll" if platform.system() == "Windows" else "contact_addon_linux64.so"
_folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "bin")
cntc_dll = ctypes.CDLL(os.path.join(os.path.normpath(_folder), _name))


class Out:
    """Numbers that a function writes: `shape` of C ints or doubles."""

    def __init__(self, shape, kind=ctypes.c_double):
        self.array = np.zeros(shape, dtype=kind)


def ints(values):
    return np.atleast_1d(np.asarray(values, dtype=ctypes.c_int)).ravel()


def reals(values):
    return np.atleast_1d(np.asarray([] if values is None else values, dtype=ctypes.c_double)).ravel()


def number(value, otherwise=0.0):
    """A number; what is none, such as [], counts as not given."""
    return float(value) if np.ndim(value) == 0 and value is not None else otherwise


def _address(value):
    if isinstance(value, Out):
        value = value.array
    if isinstance(value, (bool, int, np.integer)):
        return ctypes.byref(ctypes.c_int(int(value)))
    if isinstance(value, float):
        return ctypes.byref(ctypes.c_double(value))
    if isinstance(value, np.ndarray):
        return value.ctypes.data_as(ctypes.c_void_p)
    return value  # bytes


def call(function, *values):
    """Calls a function of the library; int and float go by address. Returns what it wrote: nothing, a value or array, or several."""
    getattr(cntc_dll, function)(*map(_address, values))
    written = [v.array if v.array.ndim else v.array.item() for v in values if isinstance(v, Out)]
    return written[0] if len(written) == 1 else tuple(written) if written else None


def value(kind=ctypes.c_double):
    return Out((), kind)


def integer():
    return Out((), ctypes.c_int)
