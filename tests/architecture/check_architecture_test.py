# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Plants one violation at a time in a small tree and expects the checker to find it and nothing else."""
import pathlib
import tempfile
import unittest

from check_architecture import AT_ROOT, FOLDERS_AT_ROOT, HOSTS, check

LICENCE = "// SPDX-License-Identifier: Apache-2.0\n"
CLEAN = {
    "core/pose.hpp": "#include <vector>\n",
    "core/parallel.cpp": '#include <oneapi/tbb/parallel_for.h>\n#include "treadmark/core/pose.hpp"\n',
    "io/tables/number.hpp": "#include <nlohmann/json.hpp>\n",
    "io/tables/json_of.hpp": '#include "treadmark/io/tables/number.hpp"\n',
    "io/cases/schema.cpp": '#include "treadmark/io/tables/number.hpp"\n#include "treadmark/core/pose.hpp"\n',
    "io/results/json.cpp": '#include "treadmark/io/tables/number.hpp"\n#include "treadmark/io/cases/case.hpp"\n',
    "backends/spline/fit.cpp": '#include "treadmark/backends/create.hpp"\n',
    "detection/search.cpp": '#include "treadmark/core/pose.hpp"\n',
    "solvers/kalker/normal/solve.cpp": '#include "treadmark/solvers/kalker/problem.hpp"\n',
    "solvers/wheelrail/pair.cpp": '#include "treadmark/detection/search.hpp"\n#include "treadmark/solvers/kalker/problem.hpp"\n',
    "scans/cgal/front.cpp": "#include <CGAL/a.h>\n",
    "scans/cgal/holes.cpp": "#include <CGAL/b.h>\n",
    "app/cli/main.cpp": '#include <CLI/CLI.hpp>\n#include "treadmark/backends/create.hpp"\n',
    "app/cli/run.cpp": "#include <CLI/CLI.hpp>\n",
    "tests/io/read_test.cpp": '#include <hdf5.h>\n#include "samples.hpp"\n#include "treadmark/app/run.hpp"\n',
    "tests/io/write_test.cpp": "#include <hdf5.h>\n",
    "build/generated.cpp": '#include "treadmark/app/run.hpp"\n',
}


class Planted(unittest.TestCase):
    def violations(self, planted, licence=LICENCE):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**CLEAN, **planted}.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text((licence if name in planted else LICENCE) + text)
            return check(pathlib.Path(folder))

    def expect(self, name, text, found, **more):
        violations = self.violations({name: text}, **more)
        self.assertEqual(len(violations), 1, violations)
        self.assertIn(name, violations[0])
        self.assertIn(found, violations[0])

    def test_clean_tree(self):
        self.assertEqual(self.violations({}), [])

    def test_layers(self):
        for name, header in [("core/a.hpp", "io/b.hpp"), ("core/a.cpp", "backends/b.hpp"), ("io/a.cpp", "detection/b.hpp"),
                             ("io/results/a.cpp", "solvers/kalker/b.hpp"), ("backends/a.cpp", "io/b.hpp"),
                             ("backends/mesh/a.cpp", "detection/b.hpp"), ("detection/a.cpp", "backends/b.hpp"),
                             ("solvers/kalker/a.cpp", "detection/b.hpp"), ("solvers/kalker/fastsim/a.cpp", "solvers/wheelrail/b.hpp"),
                             ("solvers/wheelrail/a.cpp", "backends/b.hpp"), ("solvers/wheelrail/a.cpp", "app/b.hpp"),
                             ("solvers/wheelrail/a.cpp", "io/b.hpp"), ("app/a.cpp", "tests/b.hpp"),
                             ("core/a.cpp", "tests/b.hpp"), ("io/a.cpp", "app/b.hpp")]:
            with self.subTest(name=name, header=header):
                self.expect(name, f'#include "treadmark/{header}"\n', f"must not include {header}")
                self.expect(name, f"#  include <treadmark/{header}>\n", f"must not include {header}")

    def test_arrows_between_programs_and_interfaces(self):
        self.expect("app/cli/a.cpp", '#include "treadmark/interfaces/fmi/b.hpp"\n', "app must not include interfaces/fmi/b.hpp")
        for name in ("interfaces/python/a.cpp", "app/cases/a.cpp"):
            self.expect(name, '#include "treadmark/app/cli/b.hpp"\n', "by itself only")

    def test_root(self):
        there = {name.split("/")[0] for name in CLEAN} - {"build"}
        for most, what, name in ((FOLDERS_AT_ROOT, "folders", "{}/a.md"), (AT_ROOT, "entries", "{}.md")):
            more = {name.format(f"more{i}"): "" for i in range(most - len(there))}
            self.assertEqual(self.violations(more), [])
            self.assertIn(f"{most + 1} {what} at the root", "\n".join(self.violations({**more, name.format("another"): ""})))

    def test_no_other_programs(self):
        for call in ["std::system(text)", "::popen (text)", "fork()", "execvp(a, b)", "posix_spawn(a)"]:
            self.expect("io/a.cpp", f"void f() {{ {call}; }}\n", "no other program is started")
            self.assertEqual(self.violations({"tests/a.cpp": f"void f() {{ {call}; }}\n"}), [])
        self.assertEqual(self.violations({"io/a.cpp": "void f() { built.system(1); subsystem(2); a->system(3); }\n"}), [])

    def test_nothing_that_a_standard_library_lacks(self):
        for text in ("std::ranges::sort(v);", "std::from_chars(a, b, x);", "std::to_chars(a, b, x);", "std::bit_cast<double>(n)", "std::comp_ellint_1(k)",
                     "::renameat2(a, b, c, d, e);", "std::jthread t;", "std::stop_token s", "std::make_unique_for_overwrite<int[]>(3)",
                     "std::format(\"{}\", 1)", "v | std::views::reverse", "std::atomic_ref(x)", "ranges::max_element(begin, end, {}, &A::b)",
                     "ranges::sort(v.begin(), v.end());", "ranges::all_of(first, last, good)"):
            self.expect("detection/a.cpp", text + "\n", "core/platform")
            self.assertEqual(self.violations({"core/platform/a.hpp": text + "\n"}), [])
        self.assertEqual(self.violations({"detection/a.cpp": "ranges::sort(v); ranges::find_if(v.begin(), v.end(), good); from_chars(a, b, x); std::from_chars_result r; fmt::format(s);\n"}), [])

    def test_no_name_that_another_process_may_have(self):
        for text in ("p / std::to_string(getpid())", 'fs::temp_directory_path() / "treadmark"', 'fs::path(::testing::TempDir()) / "a.toml"'):
            self.expect("tests/a.cpp", text + "\n", "TemporaryFolder")
        self.assertEqual(self.violations({"tests/a.cpp": '(fs::temp_directory_path() / "a_XXXXXX").string(); Folder f(temp_directory_path(), kept);\n'}), [])

    def test_no_unchecked_casts(self):
        for cast in ("static_cast<int>(std::floor(x))", "static_cast<std::size_t>(std::max(1.0, std::round(a / b)))",
                     "static_cast<std::int32_t>(std::ceil(f(x) - 1e-9))", "static_cast<int>((x - x0) / step)",
                     "static_cast<std::size_t>(s / points.cell_a)", "std::lround(x)", "std::llround(2.0 * x)",
                     "static_cast<int>(x)", "int(x)", "static_cast<std::size_t>(std::clamp(x, 0.0, last))", "static_cast<long>(0.5 * n)",
                     "static_cast<unsigned>(all[k])", "static_cast<int>(share * kMost)"):
            self.expect("detection/a.cpp", f"double f(double x, double share, const std::vector<double>& all);\nconst auto n = {cast};\n", "to_whole")
        self.assertEqual(self.violations({"detection/a.cpp": "a = to_whole<int>(std::floor(x)) + static_cast<int>(i / 2);\n"
                                          "std::vector<double> x; double y; d = static_cast<int>(x.size()) + static_cast<int>(place(y));\n"
                                          "e = static_cast<int>(std::lower_bound(x.begin(), x.end(), y) - x.begin()) + static_cast<int>(s.y);\n"
                                          "b = static_cast<std::uint64_t>(to_whole<std::int64_t>(std::floor(x)));\n",
                                          "tests/core/a.cpp": "std::lround(x);\n"}), [])

    def test_numbers_that_follow_the_locale(self):
        for call in ("std::strtod(text, &end)", "atof(text)", "std::stod (text)", "std::snprintf(a, 9, b, x)", "sscanf(a, b, &x)"):
            with self.subTest(call=call):
                self.expect("io/results/a.cpp", f"x = {call};\n", "follows the locale")
        self.assertEqual(self.violations({"tests/io/a.cpp": "std::strtod(text, &end);\n", "io/a.cpp": "strtol(text, &end, 10);\n"}), [])

    def test_spelling_of_includes(self):
        self.expect("core/a.cpp", '#include "pose.hpp"\n', "must read")
        self.expect("core/a.cpp", '#include "../app/run.hpp"\n', "must read")
        self.expect("core/outline/a.cpp", '#include "pose.hpp"\n', "must read")  # only /out* and /build* are left out

    def test_heavy_headers(self):
        for header in ("hdf5.h", "treadmark/io/tables/number.hpp", "toml++/toml.h", "fftw3.h", "nanoflann.hpp",
                       "openvdb/openvdb.h", "nanovdb/NanoVDB.h", "CGAL/Simple_cartesian.h", "oneapi/tbb/info.h", "tbb/info.h"):
            with self.subTest(header=header):
                self.expect("io/results/a.hpp", f"#include <{header}>\n", "not into a header")
        self.assertEqual(self.violations({"io/results/a.cpp": '#include "treadmark/io/tables/number.hpp"\n'}), [])
        self.expect("io/results/a.cpp", "#include <nlohmann/json.hpp>\n", "io/tables/number.hpp only")
        self.expect("backends/a.cpp", "#include <oneapi/tbb/parallel_for.h>\n", "one of them only")
        self.expect("backends/mesh/ray_scene.cpp", "#include <embree3/rtcore.h>\n", "embree_version.hpp only")
        self.expect("io/cases/a.cpp", "#include <CLI/CLI.hpp>\n", "app/ only")
        self.expect("backends/a.cpp", "#include <CGAL/Simple_cartesian.h>\n", "scans/cgal/ only")

    def test_questions_beside_the_contract(self):
        for name in ("detection/a.cpp", "solvers/wheelrail/a.hpp", "solvers/kalker/normal/a.cpp"):
            with self.subTest(name=name):
                self.expect(name, "auto* a = dynamic_cast<const A*>(&b);\n", "contract")
                self.expect(name, "auto a = std::dynamic_pointer_cast<const A>(b);\n", "contract")
        self.assertEqual(self.violations({"backends/a.cpp": "auto* a = dynamic_cast<const A*>(&b);\n"}), [])

    def test_unknown_folder(self):
        self.expect("gadgets/a.cpp", "int a;\n", "no layer")

    def test_licence(self):
        self.expect("core/a.hpp", "int a;\n", "SPDX", licence="")
        self.expect("scripts/a.sh", "true\n", "SPDX", licence="")

    def test_package_hosts(self):
        for host in HOSTS:
            self.expect("docs/a.md", f"fetch it from https://{host}/x\n", "package host")


if __name__ == "__main__":
    unittest.main()
