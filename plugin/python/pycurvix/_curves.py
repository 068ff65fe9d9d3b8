# SPDX-License-Identifier: BSD-3-Clause
"""Curves as arrays."""
from __future__ import annotations

import enum
import operator
import os

from . import _core
from ._lazy import TYPE_CHECKING, np
from ._scene import Scene, core_scene
from ._text import plural

if TYPE_CHECKING:
    from typing import Any, Iterator, Sequence

    from numpy.typing import ArrayLike, NDArray

    from ._scene import Path


class CurveKind(enum.IntEnum):
    """What shows as a curve in the images: the values of `Curves.kinds`."""

    UNKNOWN = 0
    CREASE = 1
    BOUNDARY = 2
    MARKING = 3
    OCCLUDING_CONTOUR = 4


class FitKind(enum.IntEnum):
    """What a curve is fitted by: the field ``kind`` of `Curves.fits`."""

    LINE = 0
    ARC = 1
    ELLIPSE = 2
    SPLINE = 3


def _column(name: str, doc: str) -> Any:
    return property(operator.attrgetter('_core.' + name), doc=doc)


class Curves:
    """Curves in space: polylines, and what they are fitted by.

    Made by `reconstruct`, `read` and `select`. All arrays are views of the
    memory in which the curves are, without copies, and read only. Samples of all
    curves follow each other: those of curve ``i`` are
    ``offsets[i]:offsets[i + 1]``. Lengths are in the unit of the world.
    """

    __slots__ = ('_core', '_scene')

    def __init__(self, *, _core: _core.Curves, _scene: Scene | None = None) -> None:
        self._core = _core
        self._scene = _scene

    def __len__(self) -> int:
        """How many curves there are."""
        return len(self._core)

    def __getitem__(self, curve_idx: int) -> NDArray[np.float64]:
        """The positions of one curve's samples, (n, 3)."""
        if isinstance(curve_idx, slice):
            raise TypeError('curves[i] is one curve; select() takes several')
        try:
            idx = range(len(self))[curve_idx]
        except IndexError:
            raise IndexError(f'there is no curve {curve_idx} among {plural(len(self), "curve")}') from None
        return self.positions[self.offsets[idx]:self.offsets[idx + 1]]

    def __iter__(self) -> Iterator[NDArray[np.float64]]:
        positions, offsets = self.positions, self.offsets
        return (positions[offsets[i]:offsets[i + 1]] for i in range(len(self)))

    offsets: NDArray[np.int64] = _column('offsets', 'Where the samples of each curve begin, and the end (C + 1,).')
    closed: NDArray[np.bool_] = _column('closed', 'Whether the first sample follows the last one (C,).')
    start_junction: NDArray[np.int32] = _column('start_junction', "Index into `junctions` of each curve's start, or -1 (C,).")
    end_junction: NDArray[np.int32] = _column('end_junction', "Index into `junctions` of each curve's end, or -1 (C,).")
    junctions: NDArray[np.float64] = _column('junctions', 'Positions in which ends of curves meet (J, 3).')
    positions: NDArray[np.float64] = _column('positions', 'Of all samples (N, 3).')
    tangents: NDArray[np.float64] = _column('tangents', 'Unit vectors along the curves (N, 3).')
    covariances: NDArray[np.float64] = _column('covariances', 'Of the positions, across the curve (N, 3, 3); 0: not estimated.')
    sigmas: NDArray[np.float64] = _column('sigmas', 'Standard deviations across the curve (N,); 0: not estimated.')
    evidence: NDArray[np.float64] = _column('evidence', 'How strongly the views support each sample (N,).')
    kinds: NDArray[np.uint8] = _column('kinds', 'The most probable `CurveKind` of each sample (N,).')
    kind_probabilities: NDArray[np.float32] = _column('kind_probabilities', 'The probabilities of `kinds` (N,); 0 of unknown ones.')
    support_offsets: NDArray[np.int64] = _column('support_offsets', 'Where the rows of each sample begin in `support`, and the end (N + 1,).')
    support: NDArray[np.int32] = _column('support', 'Index of a view that supports a sample, and of the 2D edge in it (S, 2).')

    @property
    def views(self) -> NDArray[np.int32]:
        """The first column of `support`: indices of views (S,)."""
        return self._core.support[:, 0]

    fits: NDArray[np.void] = _column(
        'fits',
        """Lines, arcs, ellipses and splines, curve after curve (F,).

        A structured array with the fields ``curve`` (index), ``kind``
        (`FitKind`), ``closed``, ``first_sample`` (from the start of the curve),
        ``num_samples``, ``length``, ``start``, ``end``, ``start_node``,
        ``end_node`` (into `nodes`, or -1), ``rms_residual``, ``max_residual``,
        ``inlier_share``, ``sigma`` and, of arcs (circles if closed), ``radius``
        and ``radius_sigma``; of arcs and ellipses ``center``, ``major``,
        ``minor``, ``start_angle``, ``end_angle``: ``center + cos(a) * major +
        sin(a) * minor``; of splines ``first_point``, ``num_points`` (into
        `spline_points`) and ``first_knot`` (into `spline_knots`). Fitted when
        first asked for, if not by a run.
        """)
    fit_offsets: NDArray[np.int64] = _column('fit_offsets', 'Where the rows of each curve begin in `fits`, and the end (C + 1,).')
    spline_points: NDArray[np.float64] = _column('spline_points', 'Control points of clamped cubic B-splines (P, 3).')
    spline_knots: NDArray[np.float64] = _column('spline_knots', 'Their knots, ``num_points + 4`` each, from 0 to 1.')
    nodes: NDArray[np.float64] = _column('nodes', 'Positions in which fits meet (M, 3).')
    node_covariances: NDArray[np.float64] = _column('node_covariances', 'Of the positions of `nodes` (M, 3, 3), world units squared.')

    @property
    def scene(self) -> Scene | None:
        """The views, with the poses and cameras that the curves were made with."""
        if self._scene is None:
            core = self._core.scene()
            self._scene = None if core is None else Scene(_core=core)
        return self._scene

    @property
    def report(self) -> dict[str, Any] | None:
        """What a run did, as in report.json; None if no run made the curves."""
        import json
        text = self._core.report()
        return json.loads(text) if text else None

    def lengths(self) -> NDArray[np.float64]:
        """The length of each polyline, closing segments included.

        Returns
        -------
        array, (C,)
        """
        return np.asarray(self._core.lengths(), float)

    def select(self, which: ArrayLike) -> Curves:
        """Some of the curves, as a copy.

        Parameters
        ----------
        which : array
            A bool for each curve, or indices of curves, in the order wanted.

        Returns
        -------
        Curves
            With their fits. Junctions and nodes in which two ends still meet
            stay; `report` goes.

        Raises
        ------
        ArgumentError
            There is no such curve.

        Examples
        --------
        >>> curves.select(curves.lengths() > 0.1).write('long.dxf')
        """
        chosen = np.atleast_1d(which)
        if chosen.dtype == bool:
            if len(chosen) != len(self):
                raise _core.ArgumentError(f'{plural(len(chosen), "bool")} cannot choose among {plural(len(self), "curve")}')
            chosen = np.flatnonzero(chosen)
        if chosen.size and not np.issubdtype(chosen.dtype, np.integer):
            raise _core.ArgumentError('curves are chosen by bools or by indices')
        indices = [int(i) for i in chosen.ravel()]
        if any(i < 0 for i in indices):
            raise _core.ArgumentError('there is no curve with a negative index')
        return Curves(_core=self._core.select(indices), _scene=self._scene)

    def project(self, view: int | str, scene: Scene | None = None) -> list[list[NDArray[np.float64]]]:
        """Where a view sees the curves. What surfaces hide is not left out.

        Parameters
        ----------
        view : int or str
            The index of the view, or the name of its image.
        scene : Scene, optional
            By default that of the curves.

        Returns
        -------
        list of lists of arrays, (n, 2)
            Of each curve the stretches of two or more samples that the view
            could see, in pixels of its image.

        Raises
        ------
        ArgumentError
            There is no such view, or no scene.
        """
        seen_by = scene or self.scene
        if seen_by is None:
            raise _core.ArgumentError('these curves have no views; give a scene')
        return self._core.project(core_scene(seen_by), seen_by.view_idx(view))

    def write(self, path: Path, format: str | None = None, *, svg_image: str = '') -> None:
        """Write a file that appears whole or not at all.

        Parameters
        ----------
        path : path
            Of the file, or of the folder for 'colmap'.
        format : str, optional
            One of those of ``--output_formats``: 'ply', 'obj', 'pcd', 'txt',
            'json', 'csv', 'dxf', 'step', 'vtp', 'glb', 'svg', 'colmap',
            'html'. By default what the ending of the path says.
        svg_image : str, optional
            The name of the image that an SVG shows; by default the first.

        Raises
        ------
        ArgumentError
            There is no such format, it needs views (for 'colmap' also edges) and
            the curves have none, or the path has another ending.
        NotFoundError, DataError
            The path cannot be written.
        """
        name = format or os.path.splitext(os.fspath(path))[1].lstrip('.').lower()
        known = [known for known, _ in _core.FORMATS]
        if name not in known:
            raise _core.ArgumentError(f"there is no format '{name}'; curves are written as {', '.join(known)}")
        _core.write(self._core, os.fspath(path), name, os.fsencode(svg_image))

    def __repr__(self) -> str:
        if len(self) == 0:
            return '<pycurvix.Curves: none>'
        return (f'<pycurvix.Curves: {plural(len(self), "curve")}, {int(self.closed.sum())} closed, '
                f'{plural(len(self.positions), "sample")}, '
                f'total length {self.lengths().sum():.4g}>')


def read(path: Path, scene: Scene | None = None) -> Curves:
    """Read curves, or lines of other programs.

    Parameters
    ----------
    path : path
        A .ply with edges, an .obj with lines, or a .txt of this program.
    scene : Scene, optional
        The views that a .txt names.

    Returns
    -------
    Curves
        Of a .txt with a scene, `support` names views; its edges are not known
        and number 0.

    Raises
    ------
    NotFoundError, DataError, UnsupportedError, ArgumentError
    """
    core = _core.read(os.fspath(path), None if scene is None else core_scene(scene))
    return Curves(_core=core, _scene=scene)
