# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Makes a site of the documents: sphinx-build -c docs . FOLDER, from the root. What stands in docs/index.md is its navigation."""
import pathlib
import re

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


def setup(app):
    app.connect("source-read", add_navigation)
    app.connect("build-finished", add_front)
