# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Runs the cells of a notebook in their order, in its folder, as Jupyter does. Where matplotlib is missing, pictures are not drawn.

usage: run_notebook.py NOTEBOOK
"""
import json
import os
import pathlib
import sys
import unittest.mock

notebook = pathlib.Path(sys.argv[1])
try:
    import matplotlib
    matplotlib.use("Agg")
except ImportError:
    sys.modules["matplotlib"] = unittest.mock.MagicMock()
book = json.loads(notebook.read_text(encoding="utf-8"))
assert book["nbformat"] == 4 and not any(cell.get("outputs") for cell in book["cells"]), "a notebook of version 4 without outputs"
os.chdir(notebook.parent)
names = {"__name__": "__main__"}
for number, cell in enumerate(book["cells"], 1):
    if cell["cell_type"] == "code":
        exec(compile("".join(cell["source"]), f"{notebook.name}, cell {number}", "exec"), names)
