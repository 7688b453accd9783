#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""scripts/source-archive.sh: twice the same bytes, every file of the commit, and a build from it knows the commit.

usage: source_archive_test.py ROOT CMAKE
Exit status 77 without a repository.
"""
import pathlib
import subprocess
import sys
import tarfile
import tempfile

root, cmake = pathlib.Path(sys.argv[1]), sys.argv[2]


def call(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


if subprocess.run(["git", "-C", root, "rev-parse", "HEAD"], capture_output=True).returncode != 0:
    print("no repository")
    sys.exit(77)
with tempfile.TemporaryDirectory() as name:
    work = pathlib.Path(name)
    script = root / "scripts" / "source-archive.sh"
    sums = [call("bash", script, "HEAD", work / folder, env={"PATH": "/usr/bin:/bin", "HOME": name, "TZ": zone}, umask=mask)
            for folder, zone, mask in (("a", "UTC", 0o022), ("b", "Asia/Tokyo", 0o077))]
    assert sums[0] == sums[1] and len(sums[0].split()[0]) == 64, sums
    (archive,) = (work / "a").iterdir()
    assert archive.read_bytes() == (work / "b" / archive.name).read_bytes()
    with tarfile.open(archive) as tar:
        held = {member.name.split("/", 1)[1] for member in tar.getmembers() if not member.isdir()}
        tar.extractall(work)
    committed = set(call("git", "-C", root, "ls-tree", "-r", "--name-only", "HEAD").splitlines())
    assert held == committed, held ^ committed
    source = work / archive.name.removesuffix(".tar.gz")
    call(cmake, "--preset", "smallest", "-B", work / "build", cwd=source)
    commit = call("git", "-C", root, "rev-parse", "HEAD").strip()
    version = "".join((work / "build" / folder / "version.cpp").read_text() for folder in ("app", "core"))
    assert f'"{commit[:8]}"' in version, version
    time = call("git", "-C", root, "log", "-1", "--format=%cd", "--date=format-local:%Y-%m-%dT%H:%M:%SZ", env={"TZ": "UTC", "PATH": "/usr/bin:/bin"}).strip()
    assert f'"{time}"' in version, (time, version)
print(sums[0].strip())
