#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Runs a program that was written for CONTACT's library version, as it is, and compares what comes out with CONTACT's numbers.

Exit status: 0 agrees, 1 differs or failed, 77 the programs, gfortran or numpy are not there (in CI that is 1)."""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

SYSTEM_PYTHON = "/usr/bin/python3"  # Debian's, which has its packages
HERE = pathlib.Path(__file__).resolve().parent
FORCE, STRESS = 0.005, 0.01  # relative to F_n, to the greatest one


class Differs(Exception):
    pass


def skip(why):
    print(why)
    sys.exit(1 if os.environ.get("CI") == "true" else 77)


def expect_near(what, found, expected, tolerance):
    if not abs(found - expected) <= tolerance:
        raise Differs(f"{what}: {found}, expected {expected} within {tolerance:.3g}")


def expect(what, right):
    if not right:
        raise Differs(what)


class Clients:
    def __init__(self, args, folder):
        self.library, self.fortran_include, self.folder = args.library, args.fortran, folder
        shared = pathlib.Path(os.environ.get("TREADMARK_SHARED", args.source.parent / "shared"))
        self.own_package = args.source / "interfaces" / "contact" / "python_intfc"
        self.data, self.reference = shared / "data", shared / "reference"
        self.clients = self.data / "contact_clients"

    def need_clients(self):
        if not self.clients.is_dir():
            skip(f"the programs are not in {self.clients}")

    # Python

    def lay_out(self, package):
        """bin/ with the library beside the package; a folder to run in, with the profiles."""
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / self.library.name).symlink_to(self.library)
        (self.folder / "python_intfc").symlink_to(package)
        run = self.folder / "run"
        run.mkdir()
        for file in self.data.glob("contact_examples/MBench*"):
            (run / file.name).symlink_to(file)
        return run

    def python(self, run, *arguments):
        if subprocess.run([SYSTEM_PYTHON, "-c", "import numpy"], capture_output=True, check=False).returncode:
            skip(f"{SYSTEM_PYTHON} has no numpy")
        environment = dict(os.environ, PYTHONPATH=str(self.folder), LD_LIBRARY_PATH="", CONTACTDIR=str(self.folder))
        done = subprocess.run([SYSTEM_PYTHON, "-B", *arguments], cwd=run, env=environment, capture_output=True, text=True, check=False)
        expect(f"the script ended with status {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}", done.returncode == 0)
        return done.stdout

    def script(self, name, package, results):
        """Runs a script, unchanged, and gives the values of the names `results` of it at its end."""
        self.need_clients()
        run = self.lay_out(package)
        shutil.copy(self.clients / "examples" / f"{name}.py", run)
        shutil.copy(HERE / "run_script.py", run)
        out = self.python(run, "run_script.py", name, *results)
        lines = out.splitlines()
        return lines[:-1], json.loads(lines[-1])

    def own_module(self):
        self.need_clients()
        run = self.lay_out(self.own_package)
        shutil.copy(HERE / "module_check.py", run)
        print(self.python(run, "module_check.py", str(self.clients / "python_intfc")))

    def wrapper(self):
        self.need_clients()
        run = self.lay_out(self.clients / "python_intfc")
        out = self.python(run, "-c", "import python_intfc as c; r = c.initlibrary(); print(len(r[0]), r[1], r[2]); c.closelibrary()")
        expect(out, out.splitlines()[-1] == "78 2520 0")

    def subsurface(self):
        self.need_clients()
        run = self.lay_out(self.own_package)
        shutil.copy(HERE / "subsurface_script.py", run)
        print(self.python(run, "subsurface_script.py"))

    def tractcurv(self, package=None):
        lines, found = self.script("python_tractcurv", package or self.own_package, ["all_fx"])
        expect(lines, lines[-1] == "Done")
        expected = [c["patches"][0] for c in json.loads((self.reference / "tractcurv.json").read_text())]
        fx = found["all_fx"]
        expect(f"{len(fx)} calculations", len(fx) == len(expected) == 120)
        worst = max(abs(f - e["fx_N"]) / e["fn_N"] for f, e in zip(fx, expected))
        print(f"F_x of 120 calculations: within {100 * worst:.4f} % of F_n")
        expect_near("F_x / F_n", worst, 0.0, FORCE)

    def tractcurv_wrapper(self):
        self.need_clients()
        self.tractcurv(self.clients / "python_intfc")

    def mbench(self, package=None):
        lines, found = self.script("python_mbench", package or self.own_package, ["results"])
        expect("42 cases are started", sum(line.startswith("Starting case") for line in lines) == 42)
        size = re.search(r"mx= (\d+) , my= (\d+)", "\n".join(lines))
        expect_near("mx", int(size[1]), 45, 1)
        expect_near("my", int(size[2]), 67, 1)
        expect("it ends with Done", lines[-1] == "Done")
        worst = 0.0
        for side, one in zip(("left", "right"), found["results"]):
            cases = json.loads((self.reference / f"mbench_a22_{side}.json").read_text())
            for i, case in enumerate(cases):
                expect(f"{side} {i}: patches", one["npatch"][i] == len(case["patches"]))
                for k, patch in enumerate(case["patches"]):
                    for name, key in (("fn", "fn_N"), ("fx", "fx_N"), ("fs", "fs_N")):
                        worst = max(worst, abs(one["cp_force"][name][i][k] - patch[key]) / patch["fn_N"])
                    expect_near(f"{side} {i} y", one["cp_pos"]["ytr"][i][k], patch["reference"]["y_tr_mm"], 0.01)
                    expect_near(f"{side} {i} z", one["cp_pos"]["ztr"][i][k], patch["reference"]["z_tr_mm"], 0.001)
        print(f"forces of 42 cases: within {100 * worst:.4f} % of F_n")
        expect_near("forces / F_n", worst, 0.0, FORCE)

    def mbench_wrapper(self):
        self.need_clients()
        self.mbench(self.clients / "python_intfc")

    # Fortran

    def compile(self, source, name, extra=()):
        compiler = shutil.which("gfortran")
        if compiler is None:
            skip("there is no gfortran")
        program = self.folder / name
        done = subprocess.run(
            [compiler, *extra, "-O1", "-w", f"-I{self.fortran_include}", f"-I{self.folder}", f"-J{self.folder}", *map(str, source), "-o", program,
             f"-L{self.library.parent}", f"-l:{self.library.name}", f"-Wl,-rpath,{self.library.parent}"], capture_output=True, text=True, check=False)
        expect(f"{name} does not compile: {done.stderr[-3000:]}", done.returncode == 0)
        return program

    def fortran(self, name):
        """A program of others; their file of interfaces asks for another preprocessor than gfortran's, so its macros are put in."""
        self.need_clients()
        interfaces = (self.clients / "fortran" / "contact_addon.ifc").read_text()
        interfaces = re.sub(r"CNAME_\((\w+)\)", r'"\1"', "\n".join(l for l in interfaces.splitlines() if not l.startswith("#")))
        (self.folder / "contact_addon.ifc").write_text(interfaces + "\n")
        source = self.folder / f"{name}.f90"
        shutil.copy(self.clients / "fortran" / source.name, source)
        return self.compile([source], name, ["-cpp", "-fdec", "-ffree-line-length-none", "-fopenmp"])

    def run(self, program, *arguments, threads=2, at=None):
        at = at or self.folder / "run"
        at.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([program, *arguments], cwd=at, capture_output=True, text=True, check=False,
                              env=dict(os.environ, OMP_NUM_THREADS=str(threads)))
        expect(f"status {done.returncode}: {done.stderr[-2000:]}", done.returncode == 0)
        return done.stdout

    def compare_text(self, found, expected, tolerance):
        """Line by line the same words, and numbers within the tolerance (of the numbers' kind) but for times."""
        pattern = re.compile(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
        lines = [[l for l in text.splitlines() if l.strip() and "CPU" not in l] for text in (found, expected)]
        expect(f"{len(lines[0])} lines, expected {len(lines[1])}", len(lines[0]) == len(lines[1]))
        for a, b in zip(*lines):
            words = [pattern.sub("#", re.sub(r"(?<=[=,(])\s*|\s+", " ", l)).replace(" ", "") for l in (a, b)]
            expect(f"{a!r} is not {b!r}", words[0] == words[1])
            for x, y in zip(pattern.findall(a), pattern.findall(b)):
                expect_near(f"{a!r}, expected {b!r}", float(x), float(y), tolerance(y))

    def own_fortran(self):
        program = self.compile([self.fortran_include / "contact_addon.f90", HERE / "fortran_program.f90"], "own", ["-std=f2018", "-Wall"])
        print(self.run(program))

    def test_caddon(self):
        program = self.fortran("test_caddon")
        expected = (self.clients / "reference" / "test_caddon.ref_out").read_text()
        # One unit of the last printed digit, or 1e-4 of a number.
        self.compare_text(self.run(program), expected,
                          lambda text: max(1e-4 * abs(float(text)), 1.5 * 10.0 ** -len(text.partition(".")[2])) if "." in text else 0.0)

    def test_mbench(self):
        program = self.fortran("test_mbench")
        run = self.folder / "run"
        (run / "profiles").mkdir(parents=True)
        for file in self.data.glob("contact_examples/MBench*"):
            (run / "profiles" / file.name).symlink_to(file)
        expected = (self.clients / "reference" / "test_mbench.ref_out").read_text()
        self.compare_text(self.run(program, at=run), expected, lambda text: 0.5 if "." in text and abs(float(text)) > 10.0 else 0.01)

    # Case, F_x, F_y over mu F_n, M_z over mu F_n c, slip in %.
    TABLE = """75 -0.603232 0 0 43.9  257 -0.233661 -0.244040 -0.523836 46.3  378 -0.638929 0.299388 -0.460719 78.0
        629 0 -0.608238 -0.726345 100  719 -0.490151 0 0 31.7  901 -0.235742 -0.254693 -0.199281 31.7
        1022 -0.736438 0.216209 -0.221340 68.3  1273 0 -0.756353 -0.397057 100  1363 -0.500932 0 0 40
        1545 -0.255828 -0.331210 -0.099458 33.3  1666 -0.808360 0.153349 -0.172158 71.1  1917 0 -0.843663 -0.246633 100
        2007 -0.635365 0 0 43.9  2189 -0.332986 -0.574391 -0.074442 41.5  2310 -0.903533 0.067300 -0.226383 90.2
        2561 0 -0.856581 -0.211555 97.6  2651 -0.964137 0 0 82.9  2833 -0.454392 -0.778114 -0.264314 100
        2954 -0.842101 0.083015 -0.511078 100  3205 0 -0.609438 -0.583879 97.6"""

    def test_table(self):
        program = self.fortran("test_table")
        one, two = (self.run(program, "11", threads=n) for n in (1, 2))
        found = [[[float(x) for x in re.findall(r"=\s*([-\d.]+)", l)] for l in text.splitlines() if l.startswith("Fx=")] for text in (one, two)]
        expect("two threads give other numbers than one", found[0] == found[1])
        expect(f"{len(found[0])} cases", len(found[0]) == 3220)
        numbers = [float(x) for x in self.TABLE.split()]
        for case, *forces, slip in zip(*[iter(numbers)] * 5):
            for found_force, force in zip(found[0][int(case) - 1], forces):
                expect_near(f"case {case:.0f}", found_force, force, 1e-3)
            expect_near(f"slip of case {case:.0f}", found[0][int(case) - 1][3], slip, 3.0)

    def testbank(self):
        """The folders that programs with profiles expect around them."""
        for name in ("profiles",):
            shutil.copytree(self.data / "contact_testbank" / name, self.folder / "testbank" / name)
        (self.folder / "examples").symlink_to(self.data / "contact_examples")
        return self.folder / "testbank" / "run"

    def test_varprof(self):
        program = self.fortran("test_varprof")
        at = self.testbank()
        for name in ("cross_brute", "wing_brute", "two_patches", "rounded_flat_d09"):
            self.run(program, name, at=at)
            found = [[float(x) for x in re.findall(r"(?:F_n|F_x|F_s|approach|p_max) (\S+)", l)]
                     for l in (at / f"{name}.out").read_text().splitlines() if l.startswith("  F_n")]
            patches = [p for c in json.loads((self.reference / f"tb_{name}.json").read_text()) for p in c["patches"]]
            expect(f"{name}: {len(found)} patches, expected {len(patches)}", len(found) == len(patches))
            for numbers, patch in zip(found, patches):
                for number, key in zip(numbers[:3], ("fn_N", "fx_N", "fs_N")):
                    expect_near(f"{name} {key}", number, patch[key], FORCE * patch["fn_N"])
                expect_near(f"{name} approach", numbers[3], patch["approach_mm"], STRESS * patch["approach_mm"])
                expect_near(f"{name} p_max", numbers[4], patch["pmax_MPa"], STRESS * patch["pmax_MPa"])

    def test_memory(self):
        """Resident memory after the first part of many steps stays."""
        program = self.fortran("test_memory")
        run = self.folder / "run"
        (run / "profiles").mkdir(parents=True)
        for file in (*self.data.glob("contact_examples/MBench*"), *self.data.glob("contact_examples/S1002_flat*")):
            (run / "profiles" / file.name).symlink_to(file)
        (run / "profiles" / "uic60_true.prr").symlink_to(self.data / "contact_examples" / "MBench_UIC60_v3.prr")
        for test, few, many, growth in (("1", 40, 400, 1000), ("2", 40, 400, 1000), ("3", 10, 40, 1000), ("4", 1, 2, 4000)):
            peaks = []
            for count in (few, many):
                process = subprocess.Popen([program, test, str(count), "0"], cwd=run, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                out = process.stdout.read()
                _, status, usage = os.wait4(process.pid, 0)
                expect(f"test {test} ended with {status}: {out[-500:]}", status == 0 and b"ERROR" not in out)
                peaks.append(usage.ru_maxrss)
            print(f"test {test}: at most {peaks[0]} kB in {few} steps, {peaks[1]} kB in {many}")
            expect_near(f"memory of test {test} [kB]", peaks[1], peaks[0], growth)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--library", required=True, type=pathlib.Path)
    parser.add_argument("--source", required=True, type=pathlib.Path)
    parser.add_argument("--fortran", required=True, type=pathlib.Path, help="folder of contact_addon.f90")
    parser.add_argument("client")
    args = parser.parse_args()
    begin = time.time()
    with tempfile.TemporaryDirectory() as folder:
        try:
            getattr(Clients(args, pathlib.Path(folder)), args.client)()
        except Differs as reason:
            print(f"{args.client}: {reason}")
            return 1
    print(f"{args.client}: {time.time() - begin:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
