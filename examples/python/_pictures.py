# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Where tutorials put their pictures: the folder that is given to them, or the current one. Without matplotlib there are none."""
import pathlib
import sys

FOLDER = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")


def save(name, draw, panels=1):
    """Calls draw(axes, ...) and saves what it drew; says where."""
    try:
        import matplotlib
    except ImportError:
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot

    FOLDER.mkdir(parents=True, exist_ok=True)
    figure, axes = pyplot.subplots(1, panels, figsize=(5.2 * panels, 3.8), layout="constrained")
    draw(*(axes if panels > 1 else [axes]))
    figure.savefig(FOLDER / name, dpi=110)
    print("picture:", FOLDER / name)
