#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Makes FMUs with the program and looks at them from outside: their files, their descriptions by the official schemas, and whether
they run where nothing of Treadmark or of what it needs is found.

usage: fmu_file_test.py PROGRAM HOST SCHEMAS SOURCES
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile

PROGRAM, HOST, SCHEMAS, SOURCES = sys.argv[1:5]
CASE = """
title = "A <wheel> & its rail"
[rail]
shape.standard = "60E1"
[wheel]
shape.standard = "S1002"
[track]
gauge_mm = 1435.0
cant = "1:40"
[wheelset]
y_mm = 2.0
z_mm = 0.9
nominal_radius_mm = 460
velocity_m_s = 20
vpitch_rad_s = -43.5
[discretisation]
dx_mm = 2.0
ds_mm = 1.0
"""
# What every machine has. Everything else must come from the FMU.
RUN_TIME = re.compile(r"(linux-vdso|lib(c|m|stdc\+\+|gcc_s|dl|rt|pthread|asan|ubsan|tsan))\.so|.*/ld-linux")


class FmuFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        (cls.folder / "case.toml").write_text(CASE)
        cls.pair, cls.said = cls.make(cls, "pair")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def make(self, name, *arguments, source=None):
        output = self.folder / f"{name}.fmu"
        done = subprocess.run([PROGRAM, "fmu", source or self.folder / "case.toml", "-o", output, *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return output, done.stdout

    def validate(self, archive, version):
        description = archive.read("modelDescription.xml")
        tree = xml.etree.ElementTree.fromstring(description)
        names = [v.get("name") for v in tree.find("ModelVariables")]
        self.assertEqual(len(names), len(set(names)))
        units = {u.get("name") for u in tree.iter("Unit")}
        used = {e.get("unit") for e in tree.find("ModelVariables").iter() if e.get("unit")}
        self.assertEqual(used - units, set())
        if not shutil.which("xmllint"):
            self.assertNotEqual(os.environ.get("CI"), "true", "xmllint is missing")
            return tree
        schema = pathlib.Path(SCHEMAS) / f"schema{version}" / f"fmi{version}ModelDescription.xsd"
        done = subprocess.run(["xmllint", "--noout", "--schema", schema, "-"], input=description, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return tree

    def test_names_that_are_no_text(self):
        for name in (b"\xff", "\ufffe".encode("utf-8", "surrogatepass"), b"a\x01<&\""):
            output = pathlib.Path(os.fsdecode(bytes(self.folder) + b"/" + name + b".fmu"))
            done = subprocess.run([PROGRAM, "fmu", self.folder / "case.toml", "-o", output], capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            with zipfile.ZipFile(output) as archive:
                xml.etree.ElementTree.fromstring(archive.read("modelDescription.xml"))

    def test_runs_where_only_the_run_time_is(self):
        self.assertRegex(self.said, r"pair.fmu: wheel on a rail: A <wheel> & its rail, FMI 3.0 co-simulation, \d+ variables")
        with zipfile.ZipFile(self.pair) as archive:
            self.assertIsNone(archive.testzip())
            names = archive.namelist()
            self.assertTrue({"modelDescription.xml", "resources/case.toml", "documentation/index.html", "documentation/licenses/LICENSE",
                             "documentation/licenses/LICENSE-FMI.txt", "binaries/x86_64-linux/treadmark.so"} <= set(names))
            for name in names:
                self.assertNotIn("..", name)
            tree = self.validate(archive, 3)
            self.assertEqual(tree.get("description"), "wheel on a rail: A <wheel> & its rail")
            archive.extractall(self.folder / "pair")
        binaries = self.folder / "pair" / "binaries" / "x86_64-linux"
        bare = {"LD_LIBRARY_PATH": ""}
        needed = subprocess.run(["/usr/bin/ldd", binaries / "treadmark.so"], env=bare, capture_output=True, text=True)
        self.assertEqual(needed.returncode, 0, needed.stderr)
        for line in needed.stdout.splitlines():
            if not RUN_TIME.match(line.strip()):
                self.assertIn(f"=> {binaries}/", line)
        host = subprocess.run([HOST, self.folder / "pair"], env=bare, capture_output=True, text=True)
        self.assertEqual(host.returncode, 0, host.stderr)
        self.assertRegex(host.stdout, r"^(\S+ ){2}-\d+(\.\d+)?\n$")  # its own line, and none of the FMU's
        solved = subprocess.run([PROGRAM, "run", self.folder / "case.toml", "--json", "-"], capture_output=True, text=True)
        force = float(re.search(r'"fz_tr_N": *([-+.e\d]+)', solved.stdout).group(1))
        self.assertAlmostEqual(float(host.stdout.split()[2]) / -force, 1.0, delta=1e-9)

    def test_pairs_are_small_with_triangles_too(self):
        meshed = self.make("meshed", "--set", "wheel.backend=mesh")[0]
        for fmu in (self.pair, meshed):
            self.assertLess(fmu.stat().st_size, 5e6)
            with zipfile.ZipFile(fmu) as archive:
                self.assertNotRegex(" ".join(archive.namelist()), "embree|hdf5|fftw")
        self.assertLess(self.pair.stat().st_size, 4e6)
        with zipfile.ZipFile(meshed) as archive:
            archive.extractall(self.folder / "meshed")
        host = subprocess.run([HOST, self.folder / "meshed"], capture_output=True, text=True)
        self.assertEqual(host.returncode, 0, host.stderr)
        # our own tree finds what Embree finds in the program
        solved = subprocess.run([PROGRAM, "run", self.folder / "case.toml", "--json", "-", "--set", "wheel.backend=mesh"], capture_output=True, text=True)
        force = float(re.search(r'"fz_tr_N": *([-+.e\d]+)', solved.stdout).group(1))
        self.assertAlmostEqual(float(host.stdout.split()[2]) / -force, 1.0, delta=1e-9)

    def test_offsets_travel_as_nanovdb(self):
        if re.search("left out:.*(NanoVDB|OpenVDB)", subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout):
            self.skipTest("this build leaves out files of offsets")
        flat = self.folder / "flat.toml"
        flat.write_text(CASE.replace('"S1002"', '"S1002"\n[[wheel.flats]]\nlength_mm = 60\ndepth_mm = 0.01'))
        subprocess.run([PROGRAM, "convert", flat, self.folder / "wheel.vdb", "--body", "wheel", "--resolution", "2"], check=True, capture_output=True)
        (self.folder / "offsets.toml").write_text(CASE.replace('shape.standard = "S1002"', 'shape.file = "wheel.vdb"'))
        fmu = self.make("offsets", source=self.folder / "offsets.toml")[0]
        self.assertLess(fmu.stat().st_size, 5e6)
        with zipfile.ZipFile(fmu) as archive:
            self.assertIn("resources/files/1/wheel.nvdb", archive.namelist())
            archive.extractall(self.folder / "offsets")
        bare = {"LD_LIBRARY_PATH": "", "TREADMARK_MODULES": "/nowhere"}
        host = subprocess.run([HOST, self.folder / "offsets"], env=bare, capture_output=True, text=True)
        self.assertEqual(host.returncode, 0, host.stderr)
        self.assertRegex(host.stdout, r"^(\S+ ){2}-\d+(\.\d+)?\n$")

    def test_same_input_same_bytes(self):
        before = self.pair.read_bytes()
        self.assertEqual(self.make("pair")[0].read_bytes(), before)
        self.assertEqual([p.name for p in self.folder.iterdir() if "resources" in p.name], [])

    def test_wheelset_for_fmi_2(self):
        with zipfile.ZipFile(self.make("set", "--fmi", "2", "--wheelset", "--set", "friction.coefficient=0.25")[0]) as archive:
            tree = self.validate(archive, 2)
            self.assertIn("binaries/linux64/treadmark.so", archive.namelist())
            self.assertIn("coefficient = 0.25", archive.read("resources/case.toml").decode())
        variables = tree.find("ModelVariables")
        self.assertEqual([int(v.get("valueReference")) for v in variables], list(range(len(variables))))
        outputs = [i + 1 for i, v in enumerate(variables) if v.get("causality") == "output"]
        self.assertEqual([int(u.get("index")) for u in tree.find("ModelStructure/Outputs")], outputs)
        left = next(u for u in tree.find("ModelStructure/Outputs") if variables[int(u.get("index")) - 1].get("name") == "left.patches")
        depends = {variables[int(i) - 1].get("name") for i in left.get("dependencies").split()}
        self.assertIn("wheelset.y", depends)
        self.assertIn("left.rail.dy", depends)
        self.assertNotIn("right.rail.dy", depends)

    def test_vehicle(self):
        simulation = pathlib.Path(SOURCES) / "examples" / "flat-at-speed.toml"
        done = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True)
        if re.search("left out:.*vehicles", done.stdout):
            self.skipTest("this build leaves out vehicles")
        with zipfile.ZipFile(self.make("vehicle", source=simulation)[0]) as archive:
            tree = self.validate(archive, 3)
            self.assertEqual(tree.find("DefaultExperiment").get("stopTime"), "0.1675")
            self.assertIn("files/1/manchester.toml", archive.read("resources/overrides.txt").decode())

    def test_refusals(self):
        for arguments, why in ((["--case", "7"], "there is no case 7"), (["--fmi", "1"], "--fmi"), (["--set", "wheel.nothing=1"], "unknown key")):
            done = subprocess.run([PROGRAM, "fmu", self.folder / "case.toml", "-o", self.folder / "no.fmu", *arguments], capture_output=True,
                                  text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(why, done.stderr)
            self.assertFalse((self.folder / "no.fmu").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
