# SPDX-License-Identifier: BSD-3-Clause
"""NumPy, imported when it is first used.

Its import takes longer than all else at the start of a run, which does not need
it.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
else:

    class _Numpy:

        def __getattr__(self, name: str) -> Any:
            import numpy
            return getattr(numpy, name)

    np = _Numpy()
