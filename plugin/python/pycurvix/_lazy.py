# SPDX-License-Identifier: BSD-3-Clause
"""What is imported when it is first used, or not at all.

The import of NumPy takes longer than all else at the start of a run, which does
not need it; that of typing would come next.
"""
from __future__ import annotations

TYPE_CHECKING = False  # As in typing: checkers of types go by the name.

if TYPE_CHECKING:
    from typing import Any

    import numpy as np
else:

    class _Numpy:

        def __getattr__(self, name: str) -> Any:
            import numpy
            return getattr(numpy, name)

    np = _Numpy()
