#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The documents make a site without a warning, in which every link and picture is there, and nothing comes from elsewhere.

usage: site_test.py ROOT [SITE]    SITE: where it was made already
Exit status 77 where Sphinx is missing, unless CI=true. Where there is Node.js, the page's own search finds words first where they are explained.
"""
import html.parser
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

root = pathlib.Path(sys.argv[1])
try:
    import furo  # noqa: F401
    import myst_parser  # noqa: F401
    import sphinx  # noqa: F401
except ImportError as error:
    print(f"{error}: install python3-sphinx, python3-myst-parser and furo")
    sys.exit(1 if os.environ.get("CI") == "true" else 77)


class Page(html.parser.HTMLParser):
    """Names that can be linked to, and what the page links to or loads."""

    def __init__(self, text):
        super().__init__()
        self.names, self.links, self.loads, self.within, self.nested = set(), [], [], False, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names.update(given[key] for key in ("id", "name") if given.get(key))
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
            self.nested += [given["href"]] if self.within else []
            self.within = True
        if tag in ("img", "script", "link") and (given.get("src") or given.get("href")):
            self.loads.append(given.get("src") or given["href"])

    def handle_endtag(self, tag):
        self.within = self.within and tag != "a"


FIRST = {"wear": "docs/evolve", "conicity": "docs/geometry", "scan": "docs/scans", "stability": "docs/stability", "accuracy": "docs/verification",
         "noise": "docs/profiles", "cite": "docs/faq", "doubtful": "docs/faq"}
# What a browser gives the search that it finds here too; found: names of pages, the first one first.
SEARCH = """
const fs = require("fs"), vm = require("vm"), [site, query] = process.argv.slice(1);
const element = new Proxy(function () {}, { get: (_, key) => key === Symbol.toPrimitive ? () => "" : element, set: () => true, apply: () => element });
const context = vm.createContext({ window: { location: { search: "?q=" + query } }, URLSearchParams, localStorage: element, console,
  SPHINX_HIGHLIGHT_ENABLED: false, document: { getElementById: () => null }, _ready: () => {}, found: [] });
const code = (name) => fs.readFileSync(site + "/" + name, "utf8");
vm.runInContext(code("_static/language_data.js") + code("_static/searchtools.js").replace("// print the results", "return found.push(...results);")
  + code("searchindex.js") + `;Search.query(${JSON.stringify(query)});`, context);
console.log(context.found.reverse().map((item) => item[0]).join(" "));
"""


def wrong_finds(site):
    for query, page in FIRST.items():
        found = subprocess.run(["node", "-e", SEARCH, str(site), query], capture_output=True, text=True, check=True).stdout.split()
        if found[:1] != [page] or "CHANGELOG" in found:
            yield f"the search for {query} finds {found[:3]}, not {page} first, or the change log"


with tempfile.TemporaryDirectory() as name:
    site = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(name) / "site").resolve()
    if len(sys.argv) == 2:
        made = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-c", root / "docs", root, site], capture_output=True, text=True)
        assert made.returncode == 0, made.stdout + made.stderr
    assert (site / "index.html").exists(), "no page at the root"
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}
    assert len(pages) > 40 and pages[site / "index.html"].links == ["docs/index.html"], len(pages)
    wrong = []
    for path, page in pages.items():
        wrong += [f"{path.relative_to(site)} loads {load}" for load in page.loads if urllib.parse.urlparse(load).scheme in ("http", "https")]
        wrong += [f"{path.relative_to(site)}: {link} is a link within a link" for link in page.nested]
        for link in page.links + page.loads:
            parts = urllib.parse.urlparse(link)
            if parts.scheme:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not target.exists():
                wrong.append(f"{path.relative_to(site)}: no {link}")
            elif parts.fragment and "=" not in parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].names:
                wrong.append(f"{path.relative_to(site)}: no place {link}")
    wrong += wrong_finds(site) if shutil.which("node") else []
    assert not wrong, "\n".join(sorted(set(wrong)))
    print(f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links")
