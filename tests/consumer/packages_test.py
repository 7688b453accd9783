#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Makes packages of a build as scripts/packages.sh begins to, looks into them, and runs the program from them where they were unpacked.
Licences are added later (cmake/finish_packages.py).

usage: packages_test.py BUILD FOLDER
"""
import fnmatch
import os
import pathlib
import shutil
import subprocess
import sys

# What each package must have, by the name without -gpl.
CONTENTS = {
    "treadmark": ["usr/bin/treadmark", "usr/share/man/man1/treadmark.1", "usr/share/doc/@/examples/wheel-flat.toml"],
    "libtreadmark0": ["usr/lib/*libtreadmark.so.0"],
    "libtreadmark-dev": ["usr/include/treadmark.h", "usr/lib/*libtreadmark.so", "usr/lib/*cmake/Treadmark/TreadmarkConfig.cmake"],
    "python3-treadmark": ["usr/lib/python3/dist-packages/treadmark/__init__.py"],
}


def told(*words, **more):
    return subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True, **more).stdout


def main():
    build, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    needed = [tool for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps", "file") if not shutil.which(tool)]
    if needed:
        print(f"needs {', '.join(needed)} (scripts/install-packages.sh --tests)", file=sys.stderr)
        return 1 if os.environ.get("CI") == "true" else 77
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    told("cpack", "-G", "DEB", "-B", str(folder / "made"), "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", cwd=build)
    faults, unpacked = [], {}
    for package in sorted((folder / "made").glob("*.deb")):
        name = told("dpkg-deb", "-f", str(package), "Package").strip()
        plain = name.removesuffix("-gpl")
        root = unpacked[plain] = folder / plain
        told("dpkg-deb", "-x", str(package), str(root))
        wanted = [*CONTENTS.get(plain, []), f"usr/share/doc/{name}/NOTICE"]
        names = [path.relative_to(root).as_posix() for path in root.rglob("*")]
        faults += [f"{package.name} has no {path}" for path in wanted if not fnmatch.filter(names, path.replace("@", plain))]
        depends = told("dpkg-deb", "-f", str(package), "Depends")
        if plain == "treadmark" and "libc6" not in depends:
            faults.append(f"{package.name} depends on {depends!r}")
    faults += [f"there is no package {name}" for name in ("treadmark", "libtreadmark0", "libtreadmark-dev") if name not in unpacked]
    if not faults:
        libraries = next(unpacked["libtreadmark0"].glob("usr/lib/**/libtreadmark.so.0")).parent
        version = told(str(unpacked["treadmark"] / "usr/bin/treadmark"), "--version", env={**os.environ, "LD_LIBRARY_PATH": str(libraries)})
        print(version.splitlines()[0])
    print("\n".join(faults), file=sys.stderr)
    shutil.rmtree(folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
