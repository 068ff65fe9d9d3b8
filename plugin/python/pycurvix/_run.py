# SPDX-License-Identifier: BSD-3-Clause
"""What the commands of the program do."""
from __future__ import annotations

import numbers
import os

from . import _core
from ._curves import Curves, read
from ._lazy import TYPE_CHECKING
from ._options import Options, core_options
from ._scene import Scene, core_scene

if TYPE_CHECKING:
    from typing import Any, Callable, Mapping, Optional, Union

    from numpy.typing import NDArray

    from ._scene import Path

    Progress = Callable[[str, int, int], Optional[bool]]
    OptionValues = Union[Options, Mapping[str, Any]]


def _paths(*paths: Path) -> _core.Paths:
    return _core.Paths(*(os.fspath(path) for path in paths))


def reconstruct(workspace_path: Path = '', *, input_path: Path = '', image_path: Path = '', output_path: Path = '',
                mask_path: Path = '', scene: Scene | None = None, options: OptionValues | None = None,
                progress: Progress | None = None) -> Curves:
    """Images and poses in, curves out.

    With a workspace this is the run of ``colmap_curvix reconstruct``, with the
    same files in its folder of results. With a scene, nothing is read but its
    images and nothing is written; bundle adjustment by COLMAP is left out.

    Parameters
    ----------
    workspace_path : path
        A folder with ``sparse/`` and ``images/``, or with ``dense/``.
    input_path, image_path, output_path, mask_path : path, optional
        The folders of the model, images, results and masks, as on the command
        line.
    scene : Scene
        Instead of a workspace.
    options : Options or mapping, optional
        By the names of the command line: ``{'CurveFilter.min_length_px': 20}``.
    progress : callable, optional
        Called with the name of the stage, the steps done and the steps in all,
        from the thread that called this. Returning False stops the run. What it
        raises stops it, too, and is raised.

    Returns
    -------
    Curves
        Without any curve, ``report['result']['why_empty']`` says why.

    Raises
    ------
    ArgumentError, NotFoundError, DataError, UnsupportedError
        As the program would say it.
    TypeError
        `scene` is something else.
    CancelledError
        `progress` returned False. Results are as they were, and the stages that
        had ended are resumed by the next run.
    KeyboardInterrupt
        Ctrl-C; as above.

    Notes
    -----
    Other threads of Python run meanwhile. Sentences worth telling go to the
    logger ``pycurvix`` as warnings.

    Examples
    --------
    >>> curves = pycurvix.reconstruct('proj', options={'preset': 'paper'})
    >>> curves.report['result']['num_curves']
    """
    if (scene is None) == (not os.fspath(workspace_path)):
        raise _core.ArgumentError('give either workspace_path or scene')
    core = core_options(options)
    if scene is not None:
        of_scene = core_scene(scene)
        if any(os.fspath(path) for path in (input_path, image_path, output_path, mask_path)):
            raise _core.ArgumentError('paths belong to a workspace; a scene takes none')
        return Curves(_core=_core.reconstruct_scene(of_scene, core, progress))
    paths = _paths(workspace_path, input_path, image_path, output_path, mask_path)
    return Curves(_core=_core.reconstruct_workspace(paths, core, progress))


def evaluate(curves: Curves | Path, truth_path: Path, *, unit_mm: float = 1000, step: float = 0.002,
             min_num_views: int = 4) -> dict[str, Any]:
    """Compare curves with known ones, as ``colmap_curvix evaluate`` does.

    Parameters
    ----------
    curves : Curves or path
    truth_path : path
        The exact curves: gt.txt of ``colmap_curvix synthesize``, say.
    unit_mm : float
        Length of a world unit in millimetres; thresholds are 5, 10 and 20 mm.
    step : float
        Distance of the samples compared, world units.
    min_num_views : int
        True samples count as visible if so many views show an edge there.

    Returns
    -------
    dict
        What ``--json 1`` prints: P5, R5, F5, acc and so on; None where there is
        nothing to measure.

    Raises
    ------
    ArgumentError, NotFoundError, DataError
    """
    import json
    known = curves if isinstance(curves, Curves) else read(curves)
    return json.loads(_core.evaluate(known._core, os.fspath(truth_path), unit_mm, step, min_num_views))


def evaluate_holdout(workspace_path: Path, holdout_every: int = 8, *, curves_path: Path = '', input_path: Path = '',
                     image_path: Path = '', mask_path: Path = '', options: OptionValues | None = None,
                     progress: Progress | None = None) -> dict[str, Any]:
    """Compare with images held out, as ``colmap_curvix evaluate`` does.

    Parameters
    ----------
    workspace_path : path
    holdout_every : int
        The workspace is reconstructed without one of so many views, in which
        its curves are looked for.
    curves_path : path, optional
        Compare these curves instead of reconstructing.
    input_path, image_path, mask_path, options, progress
        As of `reconstruct`.

    Returns
    -------
    dict
        What ``--json 1`` prints.

    Raises
    ------
    As `reconstruct`.
    """
    import json
    if not isinstance(holdout_every, numbers.Integral):
        raise _core.ArgumentError(f'holdout_every is {holdout_every!r}, which is not a whole number')
    paths = _paths(workspace_path, input_path, image_path, '', mask_path)
    text = _core.evaluate_holdout(paths, os.fspath(curves_path), holdout_every, core_options(options), progress)
    return json.loads(text)


def project(curves: Curves, view: int | str, scene: Scene | None = None) -> list[list[NDArray[Any]]]:
    """The same as `Curves.project`."""
    return curves.project(view, scene)


def write(path: Path, curves: Curves, format: str | None = None, *, svg_image: str = '') -> None:
    """The same as `Curves.write`."""
    curves.write(path, format, svg_image=svg_image)
