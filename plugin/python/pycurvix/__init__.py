# SPDX-License-Identifier: BSD-3-Clause
"""3D curves from COLMAP reconstructions.

>>> import pycurvix
>>> curves = pycurvix.reconstruct(workspace_path='proj')
>>> curves.write('curves.dxf')

Conventions are COLMAP's: pixels with the centre of the top-left one at
(0.5, 0.5); cameras look along +z, with x right and y down; a pose takes points
of the world to the camera. The world keeps the frame and unit of the input.

What cannot be done raises `Error`, by the subclass that fits, with a sentence
that says what, where and what to do.
"""
import os as _os
import sys as _sys

_flags = _sys.getdlopenflags()
try:
    # Functions of libraries are looked up when they are called, as in the program, and not all of them here.
    _sys.setdlopenflags(_os.RTLD_LAZY)
    from . import _core
finally:
    _sys.setdlopenflags(_flags)

from ._core import (ArgumentError, CancelledError, DataError, Error, InternalError, NotFoundError, ToolError,
                    UnsupportedError, __version__)
from ._curves import CurveKind, Curves, FitKind, read
from ._options import OptionInfo, Options
from ._run import evaluate, evaluate_holdout, project, reconstruct, write
from ._scene import Scene

__all__ = ['ArgumentError', 'CancelledError', 'CurveKind', 'Curves', 'DataError', 'Error', 'FitKind', 'InternalError',
           'NotFoundError', 'OptionInfo', 'Options', 'Scene', 'ToolError', 'UnsupportedError', '__version__', 'evaluate',
           'evaluate_holdout', 'project', 'read', 'reconstruct', 'write']
