#!/usr/bin/env python3
"""Moves files and changes texts to the new folders. usage: move.py ROOT STAGE...   (root analysis report interfaces contact vehicle model limits | all)

Every stage may be run again: what has moved stays, what is old is moved and renamed, and edits that are already there are passed over.
Prints what could not be applied ("NOT APPLIED"). Run in a clean working tree; commit after each stage. Format afterwards:
  git diff --name-only HEAD -- '*.cpp' '*.hpp' | xargs clang-format -i
"""
import pathlib
import posixpath
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
NEW = pathlib.Path(__file__).resolve().parent / "new"
TEXT = (".cpp", ".hpp", ".h", ".c", ".in", ".py", ".sh", ".cmake", ".txt", ".md", ".ts", ".mjs", ".js", ".json", ".css", ".def", ".toml",
        ".dox", ".yml", ".pyi", ".map", "NOTICE", "Containerfile", ".gitignore", ".gitattributes", ".clang-tidy", "run")
SKIP = ("CHANGELOG.md", "package-lock.json", "TreadmarkMovedHeaders.cmake", "docs/compatibility.md")
failed = []


def git(*arguments):
    return subprocess.run(["git", "-C", str(ROOT), *arguments], check=True, capture_output=True, text=True).stdout


def tracked():
    return [name for name in git("ls-files").splitlines() if (ROOT / name).is_file() and not (ROOT / name).is_symlink()]


def mv(old, new):
    if not (ROOT / old).exists():
        if not (ROOT / new).exists():
            failed.append(f"no {old}")
        return
    if (ROOT / old).is_dir():  # file by file, so that late comers follow
        for name in git("ls-files", old).splitlines():
            mv(name, new + name[len(old):])
        return
    if (ROOT / new).exists():
        failed.append(f"{new} is there already, {old} stays")
        return
    (ROOT / new).parent.mkdir(parents=True, exist_ok=True)
    git("mv", old, new)


def put(name):
    """A whole new file, from new/."""
    target = ROOT / name
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(NEW / name, target)
    git("add", name)


def remove(name):
    if (ROOT / name).exists():
        git("rm", "-q", "-f", name)


def edit(name, *pairs, plain=True):
    """Replaces texts; what is there already is passed over, what is not is told. The new text may not contain the old one unless 'done'."""
    path = ROOT / name
    text = path.read_text()
    for pair in pairs:
        old, new = pair[:2]
        done = pair[2] if len(pair) > 2 else new
        if plain:
            if done and done in text:
                continue
            if old not in text:
                failed.append(f"{name}: {old[:90]!r}")
                continue
            text = text.replace(old, new)
        else:
            text, count = re.subn(old, new, text, flags=re.M)
            if not count and not (len(pair) > 2 and pair[2] in text):
                failed.append(f"{name}: /{old[:90]}/")
    path.write_text(text)


def everywhere(rules, only=None):
    """rules: (compiled pattern, replacement) over all tracked texts."""
    for name in tracked():
        if name.endswith(SKIP) or not name.endswith(TEXT) or (only and not only(name)):
            continue
        path = ROOT / name
        try:
            text = path.read_text()
        except UnicodeDecodeError:
            continue
        new = text
        for pattern, replacement in rules:
            new = pattern.sub(replacement, new)
        if new != text:
            path.write_text(new)


PRE = r"(?<![\w./-])((?:treadmark/|\$\{PROJECT_(?:SOURCE|BINARY)_DIR\}/)?)"
ENDS = r"(?:cpp|hpp|h|md|css|cmake|ts|mjs|json|py|txt|in)"


def stem(old, new):
    """A file without its ending, as in includes and documents."""
    return re.compile(PRE + re.escape(old) + r"(?![\w/-])"), r"\g<1>" + new


def stems(places):
    """Many files at once."""
    names = "|".join(re.escape(old) for old in sorted(places, key=len, reverse=True))
    return re.compile(PRE + f"({names})" + r"(?![\w/-])"), lambda found: found[1] + places[found[2]]


def folder(old, new, any_name=False):
    """A folder before a file of it; any_name: wherever it stands."""
    after = r"(?=/)" if any_name else rf"(?=/[\w/-]+\.{ENDS}\b)"
    return re.compile(PRE + re.escape(old) + after), r"\g<1>" + new


def links(moved):
    """Relative links of documents after moves (old path: new path), of moved documents and to moved files."""
    back = {new: old for old, new in moved.items()}

    def now(path):
        for old, new in sorted(moved.items(), key=lambda pair: -len(pair[0])):
            if path == old or path.startswith(old.rstrip("/") + "/"):
                return new.rstrip("/") + path[len(old.rstrip("/")):]
        return path

    def before(path):
        for new, old in sorted(back.items(), key=lambda pair: -len(pair[0])):
            if path == new or path.startswith(new.rstrip("/") + "/"):
                return old.rstrip("/") + path[len(new.rstrip("/")):]
        return path

    for name in tracked():
        if not name.endswith(".md") or name == "CHANGELOG.md":
            continue
        here, was = posixpath.dirname(name), posixpath.dirname(before(name))
        text = (ROOT / name).read_text()

        def relink(found):
            target = found[1]
            if "://" in target or target.startswith("mailto:"):
                return found[0]
            if (ROOT / here / target).exists():
                return found[0]
            path = posixpath.normpath(posixpath.join(was, target))
            path = now(path)
            if not (ROOT / path).exists():
                failed.append(f"{name}: link {target}")
                return found[0]
            return "](" + posixpath.relpath(path, here or ".") + (found[2] or "")

        new = re.sub(r"\]\(([^)#\s]+)((?:#[^)]*)?)(?=\))", relink, text)
        if new != text:
            (ROOT / name).write_text(new)


def targets(renames):
    """CMake targets treadmark::old and treadmark_old."""
    rules = []
    for old, new in renames.items():
        rules.append((re.compile(rf"\btreadmark(::|_){old}(?![\w:])"), rf"treadmark\g<1>{new}"))
    everywhere(rules, lambda name: name.endswith(("CMakeLists.txt", ".cmake", ".in")))


ARCHITECTURE = "tests/architecture/check_architecture.py"


def allowed(change):
    """Changes the table ALLOWED."""
    path = ROOT / ARCHITECTURE
    text = path.read_text()
    found = re.search(r"^ALLOWED = \{\n.*?^\}\n", text, re.S | re.M)
    path.write_text(text[:found.start()] + change(found[0]) + text[found.end():])


def changelog(line):
    path = ROOT / "CHANGELOG.md"
    text = path.read_text()
    if line not in text:
        path.write_text(text.replace("### Changed\n\n", "### Changed\n\n" + line + "\n", 1))


# ------------------------------------------------------------------ stages


def root():
    mv("Containerfile", "scripts/Containerfile")
    remove(".containerignore")
    mv("SECURITY.md", "docs/SECURITY.md")
    links({"SECURITY.md": "docs/SECURITY.md", "Containerfile": "scripts/Containerfile"})
    edit("scripts/Containerfile",
         ("#   podman build -t treadmark .\n", "#   podman build -t treadmark -f scripts/Containerfile build/release\n"),
         ("COPY build/release/treadmark_*.deb build/release/libtreadmark0_*.deb /packages/", "COPY treadmark_*.deb libtreadmark0_*.deb /packages/"))
    edit("docs/SECURITY.md",
         ("# Security\n\n## Reporting\n", "# Security\n\nWhat is taken for hostile, what is promised against it, and where to report what an attacker could use.\n\n"
          "```\ntreadmark --version\n```\n\n## Reporting\n", "```\ntreadmark --version\n```\n\n## Reporting"),
         ("Give the version (`treadmark --version`), the file", "Give the version, the file"))
    edit("docs/conf.py", ('"SECURITY.md", ', "", 'include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"'))
    edit("docs/index.md", ("- [Compatibility](compatibility.md): what stays from version to version\n",
                           "- [Compatibility](compatibility.md): what stays from version to version\n- [Security](SECURITY.md): what is treated as hostile, how to report\n",
                           "](SECURITY.md)"))
    everywhere([(re.compile(r"\[SECURITY\.md\]\(docs/SECURITY\.md\)"), "[docs/SECURITY.md](docs/SECURITY.md)")], lambda name: name == "CONTRIBUTING.md")
    edit("docs/install.md", ("podman build -t treadmark .\n", "podman build -t treadmark -f scripts/Containerfile build/release\n"),
         ("[Containerfile](../scripts/Containerfile)", "[scripts/Containerfile](../scripts/Containerfile)"))
    changelog("- `SECURITY.md` is in `docs`, the recipe of the container in `scripts`: `podman build -f scripts/Containerfile build/release`.")


FOUR = ("measured", "measures", "damage", "geometry")


def analysis():
    moved = {}
    for name in FOUR:
        mv(name, f"analysis/{name}")
        mv(f"tests/{name}", f"tests/analysis/{name}")
        moved[name] = f"analysis/{name}"
    everywhere([folder(f"tests/{name}", f"tests/analysis/{name}", True) for name in FOUR] +
               [folder(name, f"analysis/{name}") for name in FOUR])
    links(moved)
    targets({name: f"analysis_{name}" for name in FOUR})
    for name in FOUR:
        edit(f"analysis/{name}/CMakeLists.txt", (f"treadmark_library({name} ", f"treadmark_library(analysis/{name} "))
    put("analysis/CMakeLists.txt")
    put("analysis/README.md")
    put("tests/analysis/CMakeLists.txt")
    edit("CMakeLists.txt",
         ("add_subdirectory(measured)\nadd_subdirectory(measures)\nadd_subdirectory(damage)\n", "add_subdirectory(analysis)\n"),
         ("add_subdirectory(geometry)\n", "", "add_subdirectory(analysis)"))
    text = (ROOT / "CMakeLists.txt").read_text().replace("add_subdirectory(geometry)\n", "")
    (ROOT / "CMakeLists.txt").write_text(text)
    edit("tests/CMakeLists.txt", ("add_subdirectory(measures)\nadd_subdirectory(measured)\nadd_subdirectory(damage)\n", "add_subdirectory(analysis)\n"))
    text = (ROOT / "tests/CMakeLists.txt").read_text().replace("add_subdirectory(geometry)\n", "")
    (ROOT / "tests/CMakeLists.txt").write_text(text)

    def change(table):
        for name in FOUR:
            table = table.replace(f'"{name}"', f'"analysis/{name}"')
        return table.replace('"analysis/geometry", "analysis/measures", "analysis/damage"', '"analysis"').replace('"analysis/measured", "io", "pictures", "backends", "analysis",', '"io", "pictures", "backends", "analysis",')
    allowed(change)
    edit(ARCHITECTURE, ('CONTRACT_ONLY = ("damage/", "detection/", "geometry/", "measured/", "measures/", "solvers/")',
                        'CONTRACT_ONLY = ("analysis/", "detection/", "solvers/")'))
    everywhere([(re.compile(r"backends\|damage\|geometry\|measured\|measures\|scans"), "backends|analysis|scans")], lambda name: name == "scripts/tidy.sh")
    for name, own in (("damage", "`damage/`"), ("measured", "`measured/`"), ("measures", "`measures/`")):
        readme = ROOT / f"analysis/{name}/README.md"
        lines = readme.read_text().split("\n")
        for i, line in enumerate(lines):
            if "**May include**" in line:
                for other in FOUR:
                    line = line.replace(f"`{other}/`", f"`analysis/{other}/`")
                lines[i] = line
        readme.write_text("\n".join(lines))
    edit("core/README.md",
         ("  ├───► scans, geometry, measures, damage ► model\n", "  ├───► scans, analysis ──────────► model\n"),
         ("backends, scans, geometry, measures, io ► measured ► model\n", "backends, scans, analysis, io ► analysis/measured ► model\n"))
    rows = (ROOT / "core/README.md").read_text().split("\n")
    rows = [line for line in rows if not re.match(r"\| \[`(analysis/)?(measured|measures|damage|geometry)/`\]", line)]
    if not any(line.startswith("| [`analysis/`]") for line in rows):
        at = next(i for i, line in enumerate(rows) if line.startswith("| [`scans/`]"))
        rows.insert(at, "| [`analysis/`](../analysis/README.md) | what shapes, measurements and contacts mean, in numbers and without solving anything "
                        "| `analysis/{measured,measures,geometry,damage}` |")
    (ROOT / "core/README.md").write_text("\n".join(rows))


PAGES = {
    "cases": ("run_page", "run_overlay_page", "case_figures", "subsurface_figures"),
    "compare": ("compare_page", "compare_figures"),
    "bench": ("bench_page",),
    "assessment": ("assessment_page",),
    "evolve": ("evolution_page",),
    "import": ("import_page", "import_figures"),
    "simulation": ("simulation_page", "simulation_overlay_page", "sweep_page", "history_panels"),
    "surfaces": ("check_page",),
}
SHARED_PAGES = ("page_parts", "overlay_parts", "read_report")
OWN_PAGES = {"geometry": ("geometry_page",), "measure": ("measure_page",)}  # part of what the verb's own library gives


def report():
    rules, moved = [], {}
    # pictures
    mv("pictures", "report/pictures")
    mv("tests/pictures", "tests/report/pictures")
    # pages, beside their verbs
    places = {f"app/report/pages/{one}": f"app/{verb}/pages/{one}" for verb, names in PAGES.items() for one in names}
    places |= {f"app/report/pages/{one}": f"app/pages/{one}" for one in SHARED_PAGES}
    places |= {f"app/{verb}/{one}": f"app/{verb}/pages/{one}" for verb, names in OWN_PAGES.items() for one in names}
    for old, new in places.items():
        for ending in (".cpp", ".hpp"):
            if (ROOT / (old + ending)).exists():
                mv(old + ending, new + ending)
    rules.append(stems(places))
    if (ROOT / "app/report/pages/CMakeLists.txt").exists():
        remove("app/report/pages/CMakeLists.txt")
    # the mechanism
    if (ROOT / "app/report").exists():
        for name in git("ls-files", "app/report").splitlines():
            if name.startswith("app/report/pages/"):  # what is new there: no verb of its own
                mv(name, "app/pages/" + name.rsplit("/", 1)[1])
            else:
                mv(name, "report/" + name[len("app/report/"):])
    if git("ls-files", "tests/app/report").strip():
        mv("tests/app/report", "tests/report")
    rules += [folder("app/report/pages", "app/pages", True), folder("tests/app/report", "tests/report", True), folder("app/report", "report", True),
              folder("tests/pictures", "tests/report/pictures", True), folder("pictures", "report/pictures")]
    everywhere(rules)
    links({"pictures": "report/pictures", "app/report": "report"})
    for name in ("report/README.md", "report/CMakeLists.txt", "app/pages/CMakeLists.txt", "core/version.hpp", "core/version.cpp.in",
                 "cmake/TreadmarkRevision.cmake"):
        put(name)
    targets({"pictures": "report_pictures", "app_report_pages": "app_pages", "app_report": "report"})
    edit("report/pictures/CMakeLists.txt", ("treadmark_library(pictures ", "treadmark_library(report/pictures "))
    edit("report/write_assets.cmake", ("namespace treadmark::app::report {", "namespace treadmark::report {"),
         ("}  // namespace treadmark::app::report", "}  // namespace treadmark::report"))
    # namespaces: treadmark::report, and treadmark::app::pages, whose sources use its words
    words = set()
    for header in (ROOT / "report").glob("*.hpp"):
        words |= set(re.findall(r"^(?:struct|class|enum class|using) (\w+)", header.read_text(), re.M))
    mechanism = words | {"to_html", "page_style", "page_script", "plot", "plots_of"}
    page_folders = ["app/pages"] + [f"app/{verb}/pages" for verb in PAGES]

    def is_page(name):
        return posixpath.dirname(name) in page_folders

    for name in tracked():
        if not name.endswith((".cpp", ".hpp")):
            continue
        text = old = (ROOT / name).read_text()
        if name.startswith("report/"):
            text = text.replace("namespace treadmark::app::report", "namespace treadmark::report")
        elif is_page(name) or name.startswith("tests/report/"):
            own = "treadmark::app::pages"
            if name.startswith("tests/report/") and not re.search(r'#include "treadmark/app/(\w+/)?pages/', text) and "app::report" in text:
                own = "treadmark::report"
            if "namespace treadmark::app::report {" in text:
                text = text.replace("namespace treadmark::app::report {\n",
                                    f"namespace {own} {{\n" + ("\nusing namespace report;\n" if own.endswith("pages") and name.endswith(".cpp") else ""))
                text = text.replace("namespace treadmark::app::report", f"namespace {own}")
                text = text.replace("using namespace report;\nnamespace {", "using namespace report;\n\nnamespace {")
            if is_page(name) and name.endswith(".hpp"):
                lines = text.split("\n")
                for i, line in enumerate(lines):
                    if line.lstrip().startswith(("#", "//")):
                        continue
                    code, mark, comment = line.partition("//")
                    code = re.sub(r"(?<![\w:.>\"/])(" + "|".join(sorted(words)) + r")\b(?=[ &*>:,)])", r"report::\1", code)
                    lines[i] = code + mark + comment
                text = "\n".join(lines)
        text = re.sub(r"\bapp::report::(\w+)", lambda m: ("report::" if m[1] in mechanism else "app::pages::") + m[1], text)
        if text != old:
            (ROOT / name).write_text(text)
    path = ROOT / "app/cli/without_report.cpp"
    text = path.read_text()
    if "namespace treadmark::app::report {" in text:
        body = re.search(r"namespace treadmark::app::report \{\n(.*?)\n\}  // namespace treadmark::app::report", text, re.S)
        first = re.search(r"^std::string to_html.*\n", body[1], re.M)[0]
        rest = body[1].replace(first, "", 1).replace("namespace {\n\n[[noreturn]]", "namespace {\n\n[[noreturn]]")
        helper = re.search(r"namespace \{\n.*?\}  // namespace\n\n", rest, re.S)[0]
        rest = rest.replace(helper, "")
        new = ("namespace treadmark::report {\n" + helper + first + "\n}  // namespace treadmark::report\n\n"
               "namespace treadmark::app::pages {\n\nusing namespace report;\n\n" + rest + "\n}  // namespace treadmark::app::pages")
        path.write_text(text[:body.start()] + new + text[body.end():])
    edit("docs/public-headers.md", ("| `app/version.hpp` |", "| `core/version.hpp` | its version and commit |\n| `app/version.hpp` |", "| `core/version.hpp` |"))
    edit("CONTRIBUTING.md", ("3. A test in `tests/app/`, a line in the README if users should meet it there.\n",
                             "3. A test in `tests/app/`, a line in the README if users should meet it there.\n"
                             "4. A page of its result, if it has one, in `app/<verb>/pages/` (in the words of `report/page.hpp`), a room of `app/pages/CMakeLists.txt`.\n", "`app/pages/CMakeLists.txt`"))
    # sources that are compiled together now
    everywhere([(re.compile(r"(?<![:\w.])Column\b(?=[ {>])"), "report::Column")],
               lambda name: name.endswith(".cpp") and (is_page(name) or name.startswith("tests/report/")) and name.count("/") > 1 and "pictures" not in name)
    everywhere([(re.compile(r"\bjoined\("), "one_line(")], lambda name: name == "app/bench/pages/bench_page.cpp")
    everywhere([(re.compile(r"\bkMostPoints\b"), "kMostPointsOfCurve")], lambda name: name == "app/simulation/pages/simulation_overlay_page.cpp")
    everywhere([(re.compile(r"(?<![\w:])Value\b"), "CandidateValue")], lambda name: name == "app/compare/pages/compare_figures.cpp")
    for name in ("tests/report/page_reader.cpp",):
        edit(name, ("using namespace app::report;", "using namespace report;"))
    # version and commit in core
    edit("app/version.hpp",
         ('#include <vector>\n\nnamespace treadmark::app {\n\nstd::string version();       ///< "0.2.0"\n'
          'std::string git_revision();  ///< short commit hash of the sources, "unknown" outside a repository\n'
          'std::string source_time();   ///<',
          '#include <vector>\n\n#include "treadmark/core/version.hpp"\n\nnamespace treadmark::app {\n\nusing treadmark::git_revision;\nusing treadmark::version;\n'
          'std::string source_time();  ///<'))
    edit("app/version.cpp.in", ('std::string version() { return "@PROJECT_VERSION@"; }\nstd::string git_revision() { return "@TREADMARK_GIT_REVISION@"; }\n', "",
                                "namespace treadmark::app {\n\nstd::string source_time()"))
    edit("report/write_page.cpp", ('#include "treadmark/app/version.hpp"\n', "", '#include "treadmark/core/version.hpp"'))
    text = (ROOT / "report/write_page.cpp").read_text()
    if "core/version.hpp" not in text:
        at = text.index('#include "treadmark/report/html_text.hpp"')
        (ROOT / "report/write_page.cpp").write_text(text[:at] + '#include "treadmark/core/version.hpp"\n' + text[at:])
    lines = (ROOT / "app/CMakeLists.txt").read_text()
    begin = lines.find("# Commit and its time:")
    if begin >= 0:
        end = lines.index('set(in "")')
        lines = lines[:begin] + lines[end:]
    lines = lines.replace("if(TREADMARK_HAVE_REPORT)\n  add_subdirectory(report)\nendif()\n", "if(TREADMARK_HAVE_REPORT)\n  add_subdirectory(pages)\nendif()\n")
    (ROOT / "app/CMakeLists.txt").write_text(lines)
    edit("core/CMakeLists.txt", ("treadmark_library(core ", 'configure_file(version.cpp.in version.cpp @ONLY)\ntreadmark_library(core ', "version.cpp.in"))
    edit("core/CMakeLists.txt", (r"(treadmark_library\(core[^)]*\)\n)(?!target_sources\(treadmark_core PRIVATE \"\$\{CMAKE_CURRENT_BINARY_DIR\}/version)",
                                 r'\1target_sources(treadmark_core PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/version.cpp")' + "\n", "/version.cpp"), plain=False)
    edit("CMakeLists.txt",
         ("include(TreadmarkTargets)\n", "include(TreadmarkTargets)\ninclude(TreadmarkRevision)\n", "include(TreadmarkRevision)"),
         ("add_subdirectory(pictures)\n", "", "add_subdirectory(report)"))
    text = (ROOT / "CMakeLists.txt").read_text()
    if "add_subdirectory(report)" not in text:
        text = text.replace("add_subdirectory(io)\n", "add_subdirectory(io)\nadd_subdirectory(report)\n")
    (ROOT / "CMakeLists.txt").write_text(text)
    edit("cmake/TreadmarkTargets.cmake", ("    install(FILES ${headers} DESTINATION include/treadmark/${folder}/${room})\n",
                                          "    cmake_path(SET place NORMALIZE include/treadmark/${folder}/${room})\n"
                                          "    install(FILES ${headers} DESTINATION \"${place}\")\n"))
    for verb in OWN_PAGES:
        edit(f"app/{verb}/CMakeLists.txt", (f"treadmark_library(app/{verb} LIGHT PUBLIC", f"treadmark_library(app/{verb} LIGHT ROOMS pages PUBLIC"))
    # tests
    edit("tests/report/CMakeLists.txt",
         ("treadmark_test(app_report_tests ", "treadmark_test(report_tests "),
         ("${PROJECT_BINARY_DIR}/app/report/web", "${PROJECT_BINARY_DIR}/report/web"),
         ("app_report_test_sources", "report_test_sources"))
    edit("tests/CMakeLists.txt",
         ("if(TREADMARK_HAVE_VEHICLE AND TREADMARK_HAVE_SCANS)\n  add_subdirectory(pictures)\nendif()\n",
          "if(TREADMARK_HAVE_VEHICLE AND TREADMARK_HAVE_SCANS)\n  add_subdirectory(report/pictures)\nendif()\n"
          "if(TREADMARK_HAVE_REPORT AND TREADMARK_HAVE_SCANS AND TREADMARK_HAVE_HDF5)\n  add_subdirectory(report)\nendif()\n"))
    text = (ROOT / "tests/app/CMakeLists.txt").read_text()
    text = text.replace("if(TREADMARK_HAVE_REPORT AND TREADMARK_HAVE_SCANS AND TREADMARK_HAVE_HDF5)\n  add_subdirectory(report)\nendif()\n", "")
    (ROOT / "tests/app/CMakeLists.txt").write_text(text)
    edit("tests/architecture/check_packages.py", ('web = pathlib.Path(sys.argv[1]) / "app" / "report" / "web"', 'web = pathlib.Path(sys.argv[1]) / "report" / "web"'))

    def change(table):
        table = table.replace('    "pictures": [', '    "report/pictures": [')
        table = table.replace('"pictures"', '"report"').replace('"io", "report"],\n', '"io", "report/pictures"],\n')
        if '    "report": [' not in table:
            table = table.replace('    "backends": [', '    "report": ["core", "model", "analysis/measured", "io", "report"],\n    "backends": [', 1)
        return table
    allowed(change)
    everywhere([(re.compile(r"\(core\|model\|io\|pictures\|"), "(core|model|io|report|"), (re.compile(r"\^\(core\|model\|io\|pictures\|"), "^(core|model|io|report|")],
               lambda name: name in (".clang-tidy", "scripts/tidy.sh"))
    edit("io/README.md", ("draw (`pictures/`)", "draw (`report/pictures/`)"))
    edit("report/pictures/README.md",
         ("* **May include** `core/`, `model/`, `io/`, `pictures/`.", "* **May include** `core/`, `model/`, `io/`, `report/pictures/`."))
    edit("app/README.md",
         (r"^\| `report/` \|.*\n", "| `pages/` | what a result looks like as a page (`report/page.hpp`): the page of a result folder, and what pages share "
          "(`read_report.hpp`, `page_parts.hpp`); each page is beside its verb, in `<verb>/pages/` |\n", "| `pages/` |"), plain=False)
    edit("core/README.md", ("  └───► pictures ──► io ────────► model\n", "  └───► report ──► report/pictures ──► io ► model\n"))
    rows = (ROOT / "core/README.md").read_text()
    rows = re.sub(r"^\| \[`(?:report/)?pictures/`\].*\n", "| [`report/`](../report/README.md) | what people look at: HTML pages from plain data, results as SVG "
                  "| `report/pictures/{histories,imports}`, `report/web` its scripts |\n", rows, flags=re.M)
    rows = rows.replace("stability,track,report,cli}", "pages,stability,track,cli}")
    (ROOT / "core/README.md").write_text(rows)


FMU = ("fmu_file", "model", "model_description", "resources", "variables", "vehicle_model", "wheels_model", "without_vehicle")


def interfaces():
    rules = []
    for one in FMU:
        for ending in (".cpp", ".hpp"):
            if (ROOT / f"interfaces/fmi/{one}{ending}").exists():
                mv(f"interfaces/fmi/{one}{ending}", f"app/fmu/{one}{ending}")
    rules.append(stems({f"interfaces/fmi/{one}": f"app/fmu/{one}" for one in FMU}))
    for ending in (".cpp", ".hpp"):
        mv(f"app/cli/output_files{ending}", f"app/cases/output_files{ending}")
    rules.append(stem("app/cli/output_files", "app/cases/output_files"))
    everywhere(rules)
    edit("app/cases/output_files.hpp", ("namespace treadmark::cli", "namespace treadmark::app"))
    edit("app/cases/output_files.cpp", ("namespace treadmark::cli", "namespace treadmark::app"))
    calls = re.compile(r"(?<![\w:])(output_folders|write_result_folder|write_comparison_folder)\(")
    everywhere([(calls, r"app::\1(")], lambda name: name.startswith("app/cli/") and name.endswith(".cpp"))
    everywhere([(re.compile(r"\bcli::(output_folders|write_result_folder|write_comparison_folder)\b"), r"app::\1")],
               lambda name: name.startswith(("interfaces/python/", "tests/")))
    # what the program says of an FMU's messages stands with the description of models
    edit("interfaces/fmi/instance.hpp", ("""struct Category {
  const char *name, *description;
};
inline constexpr Category kCategories[] = {
    {"logStatusError", "calls that failed, with the reason; always told"},
    {"logStatusDiscard", "steps that could not be computed, with the reason; always told"},
    {"logAll", "what is to be known of the FMU; with logging on"},
};

""", "", "/// Takes messages to the importer; category: of kCategories.\nusing Logger = std::function<void(Outcome outcome, const char* category, const char* message)>;\n\n/// Thrown"))
    edit("app/fmu/variables.hpp", ("namespace treadmark::fmi {\n", """namespace treadmark::fmi {

/// Kinds of messages to an importer.
struct Category {
  const char *name, *description;
};
inline constexpr Category kCategories[] = {
    {"logStatusError", "calls that failed, with the reason; always told"},
    {"logStatusDiscard", "steps that could not be computed, with the reason; always told"},
    {"logAll", "what is to be known of the FMU; with logging on"},
};
""", "kCategories"))
    edit("app/fmu/model_description.cpp", ('#include "treadmark/interfaces/fmi/instance.hpp"\n', "", "#include <vector>\n\n#include \"treadmark/app/version.hpp\"\n#include \"treadmark/io/"))
    put("app/fmu/CMakeLists.txt")
    put("interfaces/fmi/CMakeLists.txt")
    targets({"fmi_files": "app_fmu"})
    edit("app/CMakeLists.txt", ("add_subdirectory(cli)\n", "if(TREADMARK_HAVE_FMU)\n  add_subdirectory(fmu)\nendif()\nadd_subdirectory(cli)\n", "add_subdirectory(fmu)"),
         ("PRIVATE treadmark::solvers_kalker_subsurface ", "PRIVATE treadmark::report_pictures treadmark::solvers_kalker_subsurface ", "PRIVATE treadmark::report_pictures"))
    edit("app/CMakeLists.txt", ('target_sources(treadmark_app PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/version.cpp")\n',
                                'target_sources(treadmark_app PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/version.cpp")\n'
                                "# What writes files stays out of shared libraries that write none.\n"
                                "set_source_files_properties(cases/output_files.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)\n", "cases/output_files.cpp PROPERTIES"))
    edit("interfaces/python/CMakeLists.txt",
         ("# The calls of C are in it, too, and what else is not in a library.", "# The calls of C are in it, too."))
    text = (ROOT / "interfaces/python/CMakeLists.txt").read_text().replace('"${PROJECT_SOURCE_DIR}/app/cases/output_files.cpp" ', "")
    (ROOT / "interfaces/python/CMakeLists.txt").write_text(text)

    def change(table):
        return re.sub(r'^    "app/cli": .*\n', "", table, flags=re.M)
    allowed(change)
    edit(ARCHITECTURE,
         ("# What programs that are linked with the shared library include.",
          "# What nobody else includes: the command line is no library.\nALONE = (\"app/cli\", \"tests/\")\n\n# What programs that are linked with the shared library include.",
          "ALONE = "),
         ('                yield f"{own} must not include {target}"\n',
          '                yield f"{own} must not include {target}"\n'
          '            elif target.startswith(ALONE[0] + "/") and not relative.startswith(ALONE):\n'
          '                yield f"{ALONE[0]} is included by itself only, not {target}"\n', "elif target.startswith(ALONE"))
    edit("tests/architecture/check_architecture_test.py",
         ('    def test_no_other_programs(self):\n',
          '    def test_arrows_between_programs_and_interfaces(self):\n'
          '        self.expect("app/cli/a.cpp", \'#include "treadmark/interfaces/fmi/b.hpp"\\n\', "app must not include interfaces/fmi/b.hpp")\n'
          '        for name in ("interfaces/python/a.cpp", "app/cases/a.cpp"):\n'
          '            self.expect(name, \'#include "treadmark/app/cli/b.hpp"\\n\', "by itself only")\n\n'
          '    def test_no_other_programs(self):\n', "test_arrows_between"))
    edit("interfaces/README.md",
         ("`fmi/variables.hpp` is what all else follows from; `fmi/model.hpp` computes",
          "what they compute and what is in their files is in `app/fmu/`, which the verb `fmu` calls, too"),
         ("* **May include** all that `app/` may, and `app/`. No other folder needs this one, but for the\n  verb `fmu`.\n",
          "* **May include** all that `app/` may, and `app/` but for `app/cli/`. No other folder includes this one.\n"))
    edit("app/README.md", ("| `geometry/` | a wheelset", "| `fmu/` | FMUs: what they compute (`model.hpp`, `variables.hpp`), their description and their file: `fmu_file.hpp` |\n| `geometry/` | a wheelset", "| `fmu/` |"))


SEARCH = ("search_mesh", "wheel_mesh", "rail_sections", "reference_locus", "wheel_locus", "natural_curve")
INPUT = ("contact_basic", "contact_case", "contact_control", "contact_digits", "contact_friction", "contact_geometry", "contact_material",
         "contact_subsurface", "contact_text", "contact_wheel_rail", "contact_wheelset", "read_inp")
OUTPUT = ("write_mat", "write_subs")


def contact():
    places = {f"detection/{one}": f"detection/contact_program/{one}" for one in SEARCH}
    places |= {f"io/cases/{one}": f"io/cases/contact_program/{one}" for one in INPUT}
    places |= {"io/cases/writing/write_inp": "io/cases/contact_program/write_inp"}
    places |= {f"io/results/{one}": f"io/results/contact_program/{one}" for one in OUTPUT}
    places |= {"app/cases/element_table": "app/cases/contact_program/element_table"}
    move_files(places)
    rooms("detection/CMakeLists.txt", "detection", "contact_program")
    rooms("io/cases/CMakeLists.txt", "io/cases", "writing contact_program", "writing")
    rooms("io/results/CMakeLists.txt", "io/results", "contact_program")
    rooms("app/CMakeLists.txt", "app", "cases cases/contact_program compare surfaces", "cases compare surfaces")
    for name in ("detection/contact_program/README.md",):
        put(name)
    edit("detection/README.md",
         ("* `search_mesh.hpp`, `wheel_mesh.hpp`, `rail_sections.hpp`, `reference_locus.hpp`, `wheel_locus.hpp`: as the reference program (CONTACT)\n"
          "  does it, for agreement with its results only.\n",
          "* [`contact_program/`](contact_program/README.md): as the reference program (CONTACT) does it, for agreement with its results only.\n"))
    edit("io/README.md",
         ("| `cases/` | case files (`read_toml.hpp`) and CONTACT's input (`read_inp.hpp`), their keys and rules |",
          "| `cases/` | case files of both kinds (`read_case.hpp`), their keys and rules; `cases/contact_program/` CONTACT's input, read and written, and its table of digits |"),
         ("as JSON, HDF5, VTK, `.mat`, text; tables", "as JSON, HDF5, VTK, text (`results/contact_program/`: `.mat` and `.subs`); tables"))
    edit("core/README.md", ("| [`detection/`](../detection/README.md) | where two surfaces touch | |",
                            "| [`detection/`](../detection/README.md) | where two surfaces touch | `detection/contact_program` |"),
         ("| folder | what it is | rooms |\n", "What imitates CONTACT stands on every floor in a room `contact_program` and, as its library, in `interfaces/contact`:\n"
          "[`detection/contact_program`](../detection/contact_program/README.md) says where.\n\n| folder | what it is | rooms |\n", "What imitates CONTACT"))


def move_files(places):
    for old, new in places.items():
        found = False
        for ending in (".cpp", ".hpp"):
            if (ROOT / (old + ending)).exists():
                mv(old + ending, new + ending)
                found = True
            found = found or (ROOT / (new + ending)).exists()
        if not found:
            failed.append(f"no {old}")
    everywhere([stems(places)])
    links({old + ending: new + ending for old, new in places.items() for ending in (".hpp", ".cpp")})


def rooms(name, library, wanted, before=None):
    """Names the rooms of a library in its CMakeLists.txt."""
    if before:
        edit(name, (f"treadmark_library({library} LIGHT ROOMS {before} ", f"treadmark_library({library} LIGHT ROOMS {wanted} "))
        return
    text = (ROOT / name).read_text()
    if f"ROOMS {wanted}" in text:
        return
    new = re.sub(rf"treadmark_library\({library}( LIGHT)? ", rf"treadmark_library({library}\1 ROOMS {wanted} ", text)
    if new == text:
        failed.append(f"{name}: rooms {wanted}")
    (ROOT / name).write_text(new)


VEHICLE = {
    "track": ("banded_symmetric", "beam_element", "rail_element", "rail_on_seats", "rail_in_time", "moving_rail", "loaded_rail", "lateral_track",
              "track_receptance", "fit_lumped"),
    "contacts": ("check_rail", "contact_on_rail", "contact_table", "creep_law", "creep_table", "elastic_contact", "full_contact",
                 "switched_contact", "table_contact"),
    "stability": ("eigenmodes", "stability", "falling_speed"),
}


def vehicle():
    move_files({f"solvers/vehicle/{one}": f"solvers/vehicle/{room}/{one}" for room, names in VEHICLE.items() for one in names})
    rooms("solvers/vehicle/CMakeLists.txt", "solvers/vehicle", "track contacts stability")
    everywhere([(re.compile(r"\bkArm\b"), "kHalfGauge")], lambda name: name == "solvers/vehicle/implicit_step.cpp")
    put("solvers/vehicle/README.md")
    edit("core/README.md", ("`solvers/vehicle` in time |", "`solvers/vehicle/{track,contacts,stability}` in time |"))


MODEL = {
    "shape": ("profile", "profile_scatter", "slices", "triangle_mesh", "spline_surface", "surface_spec", "surface_difference", "defects",
              "moving_section", "offset_map", "point_cloud", "natural_view", "length_unit", "body_name"),
    "contact": ("contact_settings", "numerical_influence", "theories", "friction", "material", "wheel_on_rail", "hertz_ellipse"),
    "vehicle": ("vehicle_model", "flexible_axle", "flexible_track", "track_layout", "irregularities", "driving", "assessment"),
    "damage": ("fatigue", "flow_law", "wear_law", "surface_record"),
}


def model():
    move_files({f"model/{one}": f"model/{room}/{one}" for room, names in MODEL.items() for one in names})
    rooms("model/CMakeLists.txt", "model", "shape contact vehicle damage")
    put("model/README.md")
    put("cmake/TreadmarkMovedHeaders.cmake")
    changelog("- Public headers of `model/` stand in its rooms `shape`, `contact` and `vehicle`, `pictures/pressure_svg.hpp` in `report/pictures`; "
              "their old names work until 0.3.")
    edit("docs/compatibility.md",
         ("Not promised: texts for people", "Where a public header moves, its old name can be included until the next step of MINOR. With 0.2 those of `model/` moved into `model/shape`,\n"
          "`model/contact` and `model/vehicle`, and `pictures/pressure_svg.hpp` into `report/pictures`.\n\nNot promised: texts for people", "its old name can be included"))
    edit("core/README.md", ("| [`model/`](../model/README.md) | the words in which a problem is described, and the table of theories | |",
                            "| [`model/`](../model/README.md) | the words in which a problem is described, and the table of theories | `model/{shape,contact,vehicle,damage}` |"))
    edit("CMakeLists.txt", ("include(TreadmarkInstall)\n", "include(TreadmarkMovedHeaders)\ninclude(TreadmarkInstall)\n", "TreadmarkMovedHeaders"))
    edit("tests/consumer/install_and_use.cmake",
         ('include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/TreadmarkPublicHeaders.cmake")\n',
          'include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/TreadmarkPublicHeaders.cmake")\n'
          'include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/TreadmarkMovedHeaders.cmake")\n', "TreadmarkMovedHeaders"),
         ('list(JOIN public_headers "," public_headers)\n', 'list(APPEND public_headers ${TREADMARK_OLD_HEADERS})\nlist(JOIN public_headers "," public_headers)\n',
          "TREADMARK_OLD_HEADERS"))


def limits():
    edit(ARCHITECTURE,
         ("Checked: who may include whom, one source file per heavy third-party header, surfaces asked through their contract only,\n",
          "Checked: how much stands at the root, who may include whom, one source file per heavy third-party header, surfaces asked\nthrough their contract only, "
          "", "how much stands at the root"),
         ("# What nobody else includes:", "# What a stranger sees first: entries at the root, hidden ones too, and those of them that are folders.\nAT_ROOT, FOLDERS_AT_ROOT = 32, 18\n\n# What nobody else includes:",
          "FOLDERS_AT_ROOT"),
         ('def check(root):\n    """All violations below a folder, as texts "file: what"."""\n    violations, heavy_users = [], {}\n',
          'def at_root(root):\n'
          '    """Names at the root, folders with a slash: those that git keeps, or all where it keeps none."""\n'
          '    if (root / ".git").exists():\n'
          '        names = subprocess.run(["git", "-C", str(root), "ls-files"], capture_output=True, text=True, check=True).stdout.splitlines()\n'
          '        return {re.sub("/.*", "/", name) for name in names}\n'
          '    return {path.name + "/" * path.is_dir() for path in root.iterdir() if not SKIPPED.match(path.name) and not SKIPPED_AT_ROOT.match(path.name)}\n\n\n'
          'def check_root(names):\n'
          '    for kind, most, there in (("entries", AT_ROOT, names), ("folders", FOLDERS_AT_ROOT, [name for name in names if name.endswith("/")])):\n'
          '        if len(there) > most:\n'
          '            yield f"{len(there)} {kind} at the root, more than {most}: find the new one a place in a folder"\n\n\n'
          'def check(root):\n    """All violations below a folder, as texts "file: what"."""\n    violations, heavy_users = list(check_root(at_root(root))), {}\n',
          "def check_root"),
         ("import pathlib\nimport re\nimport sys\n", "import pathlib\nimport re\nimport subprocess\nimport sys\n", "import subprocess"))
    edit("tests/architecture/check_architecture_test.py",
         ('    def test_no_other_programs(self):\n',
          '    def test_root(self):\n'
          '        there = {name.split("/")[0] for name in CLEAN} - {"build"}\n'
          '        for most, what, name in ((FOLDERS_AT_ROOT, "folders", "{}/a.md"), (AT_ROOT, "entries", "{}.md")):\n'
          '            more = {name.format(f"more{i}"): "" for i in range(most - len(there))}\n'
          '            self.assertEqual(self.violations(more), [])\n'
          '            self.assertIn(f"{most + 1} {what} at the root", "\\n".join(self.violations({**more, name.format("another"): ""})))\n\n'
          '    def test_no_other_programs(self):\n', "def test_root"),
         ("from check_architecture import HOSTS, check\n", "from check_architecture import AT_ROOT, FOLDERS_AT_ROOT, HOSTS, check\n"))
    edit("CONTRIBUTING.md",
         ("A test holds the folders to it (`tests/architecture`). `tests/` mirrors the sources.\n",
          "A test holds the folders to it (`tests/architecture`), and the root\nto 32 entries of which 18 are folders: what is new finds a place in one of them. `tests/` mirrors the sources.\n"),
         ("3. What computes it, in `damage/fatigue.cpp`.", "3. What computes it, in `analysis/damage/fatigue.cpp`.", "`analysis/damage/fatigue.cpp`"))


STAGES = {one.__name__: one for one in (root, analysis, report, interfaces, contact, vehicle, model, limits)}

if __name__ == "__main__":
    for stage in STAGES if sys.argv[2:] == ["all"] else sys.argv[2:]:
        STAGES[stage]()
        git("add", "-A", "--", *{name.split("/")[0] for name in git("ls-files").splitlines() if (ROOT / name.split("/")[0]).exists()})
        for what in failed:
            print(f"NOT APPLIED ({stage}): {what}")
        failed.clear()
