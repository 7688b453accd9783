#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""usage: fortran_of_header.py contact_addon.h FOLDER

Writes into FOLDER what Fortran programs need of the header: contact_addon.f90, a module, and caddon_flags.inc, constants to include."""
import pathlib
import re
import sys

HEAD = """! SPDX-License-Identifier: Apache-2.0
! SPDX-FileCopyrightText: Treadmark contributors
! Made from contact_addon.h.
"""
KINDS = {"int": "integer(c_int)", "double": "real(c_double)", "const char": "character(kind=c_char)"}
ARRAYS = set("params values iparam rparam prmudf wx wy x y z iunits fld pn px py sx sy un ux uy sens eldiv icol".split())


def arguments(prototype):
    """(type, name, is an array) of each argument; arrays are those of functions that are given a length."""
    pairs = [re.match(r"(const char|int|double) \*(\w+)", a.strip()).groups() for a in prototype.split(",") if "*" in a]
    sized = any(t == "int" and re.match(r"len|n(?!u)", n) for t, n in pairs)
    return [(t, n, t == "const char" or (sized and n in ARRAYS)) for t, n in pairs]


def subroutine(name, args):
    lines = [f"      subroutine {name}( &"] + [f"            {n}{', &' if i + 1 < len(args) else ' &'}" for i, (_, n, _) in enumerate(args)]
    lines += ["            ) bind(c)"]
    kinds = sorted({re.search(r"c_\w+", KINDS[t])[0] for t, _, _ in args})
    if kinds:
        lines.append("         import :: " + ", ".join(kinds))
    lines += [f"         {KINDS[t]}{', dimension(*)' if array else ''} :: {n}" for t, n, array in args]
    return lines + ["      end subroutine"]


def main(header, folder):
    text = re.sub(r"/\*.*?\*/", "", pathlib.Path(header).read_text(), flags=re.S)
    constants = [f"   integer, parameter :: {n} = {v}" for n, v in re.findall(r"(CNTC_\w+) = (-?\d+)", text)]
    module = ["module contact_addon", "   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int", "   implicit none",
              "   private :: c_char, c_double, c_int", *constants, "   interface"]
    for name, prototype in re.findall(r"void (\w+)\(([^)]*)\);", text):
        module += subroutine(name, arguments(prototype))
    module += ["   end interface", "end module contact_addon"]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "contact_addon.f90").write_text(HEAD + "\n".join(module) + "\n")
    (folder / "caddon_flags.inc").write_text(HEAD + "\n".join(constants) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
