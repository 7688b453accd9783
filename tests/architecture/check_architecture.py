#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Checks that the sources keep to the architecture. Prints a line a violation; exit status 1 when there is one.

usage: check_architecture.py ROOT

Checked: how much stands at the root, who may include whom, one source file per heavy third-party header, surfaces asked
through their contract only, licence lines, no package hosts, no other programs started, no rounded number cast to an integer that may not hold it,
nothing of the standard library that LLVM's of Debian 12 lacks but through core/platform.
"""
import pathlib
import re
import subprocess
import sys

# A folder and the folders it may include from. The longest match decides.
ALLOWED = {
    "core": ["core"],
    "model": ["core", "model"],
    "analysis/measures": ["core", "model", "analysis/measured", "analysis/measures"],
    "analysis/measured": ["core", "model", "analysis/measured"],
    "analysis/damage": ["core", "model", "analysis/damage"],
    "analysis/geometry": ["core", "model", "analysis/measured", "analysis/geometry"],
    "io": ["core", "model", "analysis/measured", "io"],
    "report/pictures": ["core", "model", "analysis/measured", "io", "report/pictures"],
    "report": ["core", "model", "analysis/measured", "io", "report"],
    "backends": ["core", "model", "analysis/measured", "backends"],
    "scans": ["core", "model", "analysis/measured", "scans"],
    "detection": ["core", "model", "detection"],
    "solvers/kalker": ["core", "model", "solvers/kalker"],
    "solvers/wheelrail": ["core", "model", "detection", "solvers/kalker", "solvers/wheelrail"],
    "solvers/optimisation": ["core", "solvers/optimisation"],
    "solvers/vehicle": ["core", "model", "detection", "solvers/kalker", "solvers/wheelrail", "solvers/vehicle"],
    "app": ["core", "model", "io", "report", "backends", "analysis", "scans", "detection", "solvers", "app"],
    "interfaces": ["core", "model", "io", "report", "backends", "analysis", "scans", "detection", "solvers", "app", "interfaces"],
    "examples": ["core", "model", "io", "report", "backends", "analysis", "scans", "detection", "solvers", "app"],
    "bench": ["core", "model", "io", "report", "backends", "analysis", "scans", "detection", "solvers", "app", "bench"],
    "tests": ["core", "model", "io", "report", "backends", "analysis", "scans", "detection", "solvers", "app", "interfaces", "bench", "tests"],
}

# What a stranger sees first: entries at the root, hidden ones too, and those of them that are folders.
AT_ROOT, FOLDERS_AT_ROOT = 32, 18

# What nobody else includes: the command line is no library.
ALONE = ("app/cli", "tests/")

# What programs that are linked with the shared library include.
FOR_C = "treadmark.h"

# Headers that cost compile time or bind to a version: in one .cpp of the whole library ("all") or of each folder, in one header of
# ours, in no header at all ("source"), or in any .cpp below one folder (CGAL: one algorithm a file, for what the compiler takes of memory).
HEAVY = {
    r"hdf5(_hl)?\.h": "all",
    r"expat\.h": "folder",
    r"fftw3\.h": "all",
    r"embree[34]/.*": "backends/mesh/embree_version.hpp",
    r"(openvdb|nanovdb)/.*": "folder",
    r"CGAL/.*": "scans/cgal/",
    r"nanoflann\.hpp": "all",
    r"nlopt\.h(pp)?": "all",
    r"(oneapi/)?tbb(/.*|\.h)": "all",
    r"nlohmann/.*": "io/tables/number.hpp",  # io::Json is its only name
    r"treadmark/io/tables/(number|json_of)\.hpp": "source",
    r"toml\+\+/.*": "folder",
    r"CLI/.*": "app",  # any file of the command line program, nowhere else
}
HEAVY_FREE = ("tests", "bench")

# Know nothing of a surface but its contract (core/surface.hpp), so that surfaces made of others may stand in for them.
CONTRACT_ONLY = ("analysis/", "detection/", "solvers/")

# What comes from files must never reach a shell, so the program and its libraries start no other programs; but for those
# that hold OpenCASCADE and OpenVDB and what prints and opens pages, by their paths and without a shell.
STARTS_PROGRAMS = re.compile(r"(?<![\w.>])(system|w?popen|v?fork|exec[lv]p?e?|posix_spawnp?)\s*\(")
MAY_START = ("tests", "bench")
STARTS_ITS_OWN = ("core/helper_process.cpp", "app/cli/page_file.cpp")

# A double beyond an integer's range has no value as one (core/to_whole.hpp). What is cast is one by its names and its words.
INTEGER = r"(?:unsigned|int|long|long long|short|std::size_t|std::ptrdiff_t|std::u?int\d+_t)"
CAST = re.compile(rf"static_cast<{INTEGER}>\(|(?<![\w:<]){INTEGER}\(")
REAL = re.compile(r"(?<!\w)(?:floor|ceil|trunc|round|rint|nearbyint|sqrt|log10|log2?|exp|pow|hypot|fabs|fmod)\(|(?<![\w.])\d[\d']*\.\d|"
                  r"static_cast<(?:double|float)>| / [\w.]*(?:[Ss]tep|[Cc]ell|[Ss]trip)(?:_[as])?\b")
INIT = r"(?: = [^,;()]*(?:\([^()]*\)[^,;()]*)*)?"
DECLARED = rf"(?<![\w:])(?:{{}})[&*]? +(?:const )?(\w+{INIT}(?:, \w+(?= = |[,;]){INIT})*)"
REALS = re.compile(DECLARED.format(r"double|float|std::(?:vector|span)<(?:const )?(?:double|float)>"))
OTHERS = re.compile(DECLARED.format(r"(?!double|float|return|const|else|case|std::(?:vector|span)<(?:const )?(?:double|float)>)[\w:]+(?:<[^<>;(){}]*>)?"))
CALL = re.compile(r"(?<!\w)(?!(?:min|max|clamp|abs|floor|ceil|trunc|round|rint|nearbyint|sqrt|log10|log2?|exp|pow|hypot|fabs|fmod)\()\w+\([^()]*\)")
PLACES = re.compile(r"begin\(\)|_bound\(|count_if\(|find\(|data\(\)")  # differences of iterators
ROUNDED_TO_LONG = re.compile(r"(?<!\w)ll?(?:round|rint)\(")
MAY_CAST = ("tests", "bench", "examples")
BOUNDED_BESIDE = ("core/to_whole.hpp", "backends/analytic/wheels/wheel_lanes_kernel.hpp", "backends/displacement/band_rows.hpp",
                  "backends/offset/sheet_points.hpp", "backends/spline/nurbs/nurbs_kernel.hpp")

# Whoever loads the libraries may have set a locale that writes and reads 1,5.
BY_LOCALE = re.compile(r"(?<!\w)(strto(?:d|f|ld)|atof|sto(?:d|f|ld)|[vs]n?printf|sscanf)\s*\(")
MAY_FOLLOW_LOCALE = ("tests", "bench", "examples")

# What LLVM's standard library of Debian 12, or that of its compiler for browsers, lacks: first what core/platform has instead, then
# what a line of older C++ does as well.
PLATFORM = "core/platform/"
MISSING = re.compile(r"\bstd::(?:ranges::|(?:from|to)_chars\(|bit_cast\b|comp_ellint_\d)|\brenameat2\(|"
                     r"\bstd::(?:views::|format\(|jthread\b|stop_\w+|atomic_ref\b|source_location\b|make_\w+_for_overwrite\b|execution\b|osyncstream\b|"
                     r"ellint_\d|cyl_\w+|sph_\w+|expint\b|riemann_zeta\b)|"
                     # two iterators in place of a range, which ours takes of find_if alone
                     r"\branges::(?!find_if\()\w+\(\s*(?:[\w.>-]+(?:\.|->))?(?:c?r?begin(?:\(\))?|first)\s*,\s*"
                     r"(?:[\w.>-]+(?:\.|->))?(?:c?r?end(?:\(\))?|last)\s*[,)]")
MAY_NEED = "tests/faults/shim/"

# A name that another process may have too, now or before it died: what makes its own name never opens what stands there.
SHARED_NAME = re.compile(r"\bgetpid\(|\b(?:temp_directory_path|TempDir)\(\)\)? *\n? */(?!.*XXXXXX)")
MAY_NAME = ("core/output_file.cpp", MAY_NEED)

# Put together here, so that this file does not contain them.
HOSTS = [".".join(parts) for parts in (
    ("pypi", "org"), ("pythonhosted", "org"), ("anaconda", "org"), ("npmjs", "org"), ("npmjs", "com"), ("crates", "io"),
    ("proxy", "golang", "org"), ("rubygems", "org"), ("maven", "apache", "org"), ("deb", "debian", "org"),
    ("security", "debian", "org"), ("archive", "ubuntu", "com"), ("conan", "io"))]

SKIPPED = re.compile(r"(\.git|\.cache|__pycache__|third_party)$")
SKIPPED_AT_ROOT = re.compile(r"(build|out)")  # as in .gitignore
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)
SOURCE = (".cpp", ".hpp", ".h", ".c", ".cc", ".cpp.in", ".hpp.in")
LICENSED = SOURCE + (".py", ".sh", ".cmake", ".cmake.in", ".ts", ".mjs", ".css")


def files(folder, at_root=True):
    for path in sorted(folder.iterdir()):
        if path.is_symlink():
            continue
        if path.is_dir():
            if not SKIPPED.match(path.name) and not (at_root and SKIPPED_AT_ROOT.match(path.name)):
                yield from files(path, False)
        else:
            yield path


def layer(relative):
    """The longest folder of ALLOWED that contains the file, or None."""
    fits = [name for name in ALLOWED if relative.startswith(name + "/")]
    return max(fits, key=len, default=None)


def check_includes(relative, text, heavy_users):
    own = layer(relative)
    if own is None:
        yield "no layer: add its folder to ALLOWED in tests/architecture/check_architecture.py"
        return
    for quoted, angled in INCLUDE.findall(text):
        if quoted.startswith("treadmark/") or angled.startswith("treadmark/"):
            target = (quoted or angled)[len("treadmark/"):]
            if not any(target.startswith(name + "/") for name in ALLOWED[own]):
                yield f"{own} must not include {target}"
            elif target.startswith(ALONE[0] + "/") and not relative.startswith(ALONE):
                yield f"{ALONE[0]} is included by itself only, not {target}"
        elif quoted and quoted != FOR_C and own not in ("tests", "interfaces"):
            yield f'include "{quoted}" must read "treadmark/<folder>/<file>"'
        header = quoted or angled
        for pattern, scope in HEAVY.items():
            if not re.fullmatch(pattern, header) or own in HEAVY_FREE:
                continue
            if scope == "app":
                if not relative.startswith("app/"):
                    yield f"{header} is for app/ only"
            elif scope.endswith(".hpp"):
                if relative != scope:
                    yield f"{header} is for {scope} only"
            elif relative.startswith("io/tables/"):
                continue
            elif not relative.endswith(".cpp"):
                yield f"{header} belongs into one .cpp, not into a header"
            elif scope == "source":
                continue
            elif scope.endswith("/"):
                if not relative.startswith(scope):
                    yield f"{header} is for {scope} only"
            else:
                group = relative.rsplit("/", 1)[0] if scope == "folder" else ""
                heavy_users.setdefault((pattern, group), (header, set()))[1].add(relative)


def declared(pattern, text):
    return {name.split("=")[0].strip() for names in pattern.findall(text) for name in re.sub(r"\([^()]*\)", "", names).split(",")}


def unchecked_casts(text):
    """Casts of doubles to integers, as they stand in a source."""
    reals = declared(REALS, text) - declared(OTHERS, text)
    for found in ROUNDED_TO_LONG.finditer(text):
        yield found.group()
    for found in CAST.finditer(text):
        depth, end = 1, found.end()
        while depth > 0 and end < len(text):
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        cast = text[found.end():end]
        told = re.sub(r"to_whole<[^;]*|\[[^\[\]]*\]|[\w.>-]+(?:\.|->)size\(\)", "", cast)
        while (shorter := CALL.sub("", told)) != told:
            told = shorter
        if PLACES.search(cast) or "static_cast<" in re.sub("static_cast<(double|float)>", "", told):
            continue
        if REAL.search(told) or reals & set(re.findall(r"(?<![\w.:>])[A-Za-z]\w*\b(?![(:<]|\.\w|->)", told)):
            yield found.group() + cast


def at_root(root):
    """Names at the root, folders with a slash: those that git keeps, or all where it keeps none."""
    if (root / ".git").exists():
        names = subprocess.run(["git", "-C", str(root), "ls-files"], capture_output=True, text=True, check=True).stdout.splitlines()
        return {re.sub("/.*", "/", name) for name in names}
    return {path.name + "/" * path.is_dir() for path in root.iterdir() if not SKIPPED.match(path.name) and not SKIPPED_AT_ROOT.match(path.name)}


def check_root(names):
    for kind, most, there in (("entries", AT_ROOT, names), ("folders", FOLDERS_AT_ROOT, [name for name in names if name.endswith("/")])):
        if len(there) > most:
            yield f"{len(there)} {kind} at the root, more than {most}: find the new one a place in a folder"


def check(root):
    """All violations below a folder, as texts "file: what"."""
    violations, heavy_users = list(check_root(at_root(root))), {}
    for path in files(root):
        relative = path.relative_to(root).as_posix()
        data = path.read_bytes()
        if b"\0" in data:
            continue
        text = data.decode("utf-8", "replace")
        if relative.endswith(SOURCE):
            violations += [f"{relative}: {what}" for what in check_includes(relative, text, heavy_users)]
            if relative.startswith(CONTRACT_ONLY) and re.search(r"\bdynamic(_pointer)?_cast\b", text):
                violations.append(f"{relative}: dynamic_cast: ask a question of the contract instead")
            found = STARTS_PROGRAMS.search(text)
            if found and layer(relative) not in MAY_START and relative not in STARTS_ITS_OWN:
                violations.append(f"{relative}: {found.group(1)}: no other program is started")
            if (found := BY_LOCALE.search(text)) and layer(relative) not in MAY_FOLLOW_LOCALE:
                violations.append(f"{relative}: {found.group(1)} follows the locale: use finite_number (core/number_text.hpp) or fmt")
            if layer(relative) not in MAY_CAST and relative not in BOUNDED_BESIDE:
                violations += [f"{relative}: {cast}: use to_whole (core/to_whole.hpp)" for cast in unchecked_casts(text)]
            if not relative.startswith((PLATFORM, MAY_NEED)):
                violations += [f"{relative}: {name}: not in every standard library, see {PLATFORM}" for name in sorted(set(MISSING.findall(text)))]
            if not relative.startswith(MAY_NAME):
                violations += [f"{relative}: {name.strip()}: use OutputFolder, in tests TemporaryFolder" for name in sorted(set(SHARED_NAME.findall(text)))]
        if relative.endswith(LICENSED) and "SPDX-License-Identifier: Apache-2.0" not in text[:400]:
            violations.append(f"{relative}: no SPDX-License-Identifier line at its top")
        violations += [f"{relative}: mentions the package host {host}" for host in HOSTS if host in text.lower()]
    for header, users in heavy_users.values():
        if len(users) > 1:
            violations.append(f"{', '.join(sorted(users))}: {header} belongs into one of them only")
    return violations


def main():
    if len(sys.argv) != 2 or not (pathlib.Path(sys.argv[1]) / "core").is_dir():
        sys.exit(__doc__)
    violations = check(pathlib.Path(sys.argv[1]))
    print("\n".join(violations) or "the architecture is kept")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
