# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Makes a site of the documents: sphinx-build -c docs . FOLDER, from the root. What stands in docs/index.md is its navigation.

With the name of a page of `treadmark live` in TREADMARK_LIVE_PAGE, the first page holds it, and examples of the gallery open in it.
"""
import os
import pathlib
import re
import shutil
import urllib.parse

project = "Treadmark"
copyright = "Treadmark contributors"
extensions = ["myst_parser"]
html_theme = "furo"
root_doc = "docs/index"
include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md", "**/README.md"]
exclude_patterns = ["build*", "out*", "shared", "**/node_modules", ".*"]
html_title = "Treadmark"
html_copy_source = False
html_scaled_image_link = False  # thumbnails lead to their sections
html_static_path = ["site"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_search_scorer = str(pathlib.Path(__file__).parent / "site" / "scorer.js")
myst_heading_anchors = 4
myst_enable_extensions = ["html_image"]
# Programs and files of other kinds are shown as they are.
highlight_language = "none"


live_page = pathlib.Path(os.environ.get("TREADMARK_LIVE_PAGE", ""))
solve = "try.html"  # its name on the site


def with_example(root, command):
    """The command, and the way to the page that solves with its example where that needs no further files and is a single instant."""
    toml = pathlib.Path(root, command[1]).read_text(encoding="utf-8")
    if re.search(r"^\[+patch|^[^#\n]*\b(file|cases_file|steps)\b", toml, re.M):
        return command[0]
    return f'{command[0]}\n<p><a href="{solve}#case={urllib.parse.quote(toml, safe="")}">Change it in the browser</a></p>\n'


def add_page_that_solves(app, name, source):
    if not live_page.is_file():
        return
    if name == root_doc:
        source[0] = source[0].replace("\n\n", f'\n\n<p><a href="{solve}">A contact to try</a>: change it, or drop a profile of your own; it is solved in the browser.</p>\n'
                                      f'<iframe class="try" src="{solve}" title="A contact to try" loading="lazy"></iframe>\n\n', 1)
    elif name == "docs/gallery":
        source[0] = re.sub(r"^```\ntreadmark run (examples/[\w-]+\.toml) [^`]*```\n", lambda command: with_example(app.srcdir, command), source[0], flags=re.M)


def add_navigation(app, name, source):
    index = pathlib.Path(app.srcdir, "docs", "index.md").read_text(encoding="utf-8")
    listed = re.findall(r"\]\(([\w-]+)\.md\)", index)
    if name == root_doc:
        for title, items in re.findall(r"^## (.*?)\n\n((?:- .*\n)+)", index, re.M):
            pages = "\n".join(re.findall(r"\]\(([\w-]+)\.md\)", items))
            source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n\n{pages}\n```\n"
    elif not (name.startswith("docs/") and name.removeprefix("docs/") in listed):
        unsearched = "nosearch: true\n" if name == "CHANGELOG" else ""
        source[0] = f"---\norphan: true\n{unsearched}---\n" + source[0]
    # Beside a comment the parser does not see a picture; descriptions of pictures it takes for YAML.
    source[0] = re.sub(r"\s*<!--.*?-->", "", source[0])
    source[0] = re.sub(r'<img [^>]*>', lambda image: re.sub(r'(alt="[^"]*)"', lambda alt: alt[0].replace(": ", " – "), image[0]), source[0])


def add_front(app, exception):
    front = pathlib.Path(app.outdir, "index.html")  # where people and servers look first
    front.write_text('<!DOCTYPE html>\n<meta charset="utf-8">\n<title>Treadmark</title>\n<meta http-equiv="refresh" content="0; url=docs/index.html">\n'
                     '<a href="docs/index.html">Documents of Treadmark</a>\n', encoding="utf-8")
    if live_page.is_file():
        shutil.copyfile(live_page, front.parent / "docs" / solve)


def setup(app):
    app.connect("source-read", add_page_that_solves)
    app.connect("source-read", add_navigation)
    app.connect("build-finished", add_front)
