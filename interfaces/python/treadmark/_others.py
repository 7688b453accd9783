# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Other packages, where they are there and asked for."""
from __future__ import annotations

import importlib
from typing import Any, Sequence

from ._inputs import checked


def needed(package: str, what: str) -> Any:
    """A package that is asked for. Errors: ImportError that names it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise ImportError(f"{what} needs {package}, which is not installed (Debian: python3-{package}; else pip install {package})", name=package) from error


@checked
class Drawn:
    """A result with a table."""

    to_pandas: Any

    def _axes(self) -> tuple[str | None, Any]:
        return None, None

    def plot(self, y: str | Sequence[str] | None = None, x: str | None = None, **options: Any) -> Any:
        """Columns of to_pandas() over another one, by pandas with its options (``ax``, ``style``, ``kind``); gives the axes of matplotlib back. Needs both."""
        needed("matplotlib", "plot")
        across, up = self._axes()
        return self.to_pandas().plot(x or across, y or up, **options)
