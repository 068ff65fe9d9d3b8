# SPDX-License-Identifier: BSD-3-Clause
"""Posed views."""
from __future__ import annotations

import numbers
import os

from . import _core
from ._lazy import TYPE_CHECKING, np
from ._text import plural

if TYPE_CHECKING:
    from typing import Any, Sequence, Union

    from numpy.typing import ArrayLike, NDArray

    Path = Union[str, os.PathLike[str]]
    Image = Union[Path, ArrayLike]


_MOST_PIXELS = 65535  # along a side, as in JPEG


def _warn(sentence: str) -> None:
    import logging
    logging.getLogger('pycurvix').warning('%s', sentence)


def _array(name: str, values: ArrayLike, shape: Sequence[int | None]) -> NDArray[np.float64]:
    """Finite doubles of that shape; None: any length."""
    try:
        array = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise _core.ArgumentError(f'{name} is no array of numbers: {error}') from None
    wanted = ' x '.join('N' if length is None else str(length) for length in shape)
    fits = len(array.shape) == len(shape) and all(want in (None, got) for want, got in zip(shape, array.shape))
    if not fits:
        raise _core.ArgumentError(f'{name} has the shape {array.shape}; it must be {wanted}')
    if not np.isfinite(array).all():
        raise _core.ArgumentError(f'{name} is not finite')
    return array


def _pixels(name: str, values: ArrayLike) -> NDArray[Any]:
    """Rows x columns x channels without gaps; a copy only if there is no other way."""
    array = np.asarray(values)
    if array.dtype.kind != 'u' or array.dtype.itemsize > 2:
        raise _core.ArgumentError(f'{name} is an array of {array.dtype}; images are uint8 or uint16')
    pixels = array[:, :, np.newaxis] if array.ndim == 2 else array
    if pixels.ndim != 3 or pixels.shape[2] not in (1, 3, 4) or pixels.size == 0:
        raise _core.ArgumentError(f'{name} has the shape {array.shape}; images are height x width, with 3 channels '
                                  '(red, green, blue) or 4 (and alpha) if they are not grey')
    return np.ascontiguousarray(pixels, pixels.dtype.newbyteorder('='))


def _number_above_0(name: str, value: float) -> float:
    number = float(_array(name, np.ravel(value), (1,))[0])
    if not number > 0:
        raise _core.ArgumentError(f'{name} is {number:g}; it must be > 0')
    return number


def _names(names: Sequence[str]) -> list[str]:
    """Text that C++ can take."""
    texts = [str(name) for name in names]
    for i, text in enumerate(texts):
        try:
            text.encode()
        except UnicodeEncodeError:
            raise _core.ArgumentError(f'names[{i}] is {ascii(text)}, which is no text in UTF-8; give other names') from None
    return texts


def _names_of_files(paths: Sequence[str]) -> list[str]:
    """Relative paths without '..', as names of images are: those given, or from the common folder; '' stays."""
    if not any(os.path.isabs(path) or '..' in path.replace('\\', '/').split('/') for path in paths):
        return list(paths)
    whole = [os.path.abspath(path) if path else '' for path in paths]
    folder = os.path.commonpath([os.path.dirname(path) for path in whole if path])
    return [os.path.relpath(path, folder) if path else '' for path in whole]


def _is_path(image: Image) -> bool:
    return isinstance(image, (str, os.PathLike))


def _quaternions(rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    """x, y, z, w of rotation matrices."""
    off = np.abs(rotations @ rotations.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
    wrong = np.flatnonzero((off > 1e-4) | (np.linalg.det(rotations) < 0))
    if len(wrong):
        raise _core.ArgumentError(f'R[{wrong[0]}] is no rotation')
    # The eigenvector of the largest eigenvalue (Bar-Itzhack): for any rotation.
    m = rotations
    k = np.zeros((len(m), 4, 4))
    for i in range(3):
        for j in range(3):
            k[:, i, j] = m[:, i, j] + m[:, j, i]
    for i, j, l in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        k[:, i, i] = m[:, i, i] - m[:, j, j] - m[:, l, l]
        k[:, i, 3] = k[:, 3, i] = m[:, l, j] - m[:, j, l]
    k[:, 3, 3] = np.trace(m, axis1=1, axis2=2)
    return np.linalg.eigh(k)[1][:, :, 3]


class Scene:
    """Views with cameras and poses, and sparse points if there are any.

    Made by `from_colmap`, `from_pycolmap` or `from_arrays`; it cannot be
    changed afterwards. A view is named by its index or by the name of its image.
    """

    __slots__ = ('_core',)

    def __init__(self, *, _core: _core.Scene) -> None:
        self._core = _core

    @classmethod
    def from_colmap(cls, workspace_path: Path, image_path: Path = '') -> Scene:
        """Read the sparse model of a COLMAP workspace.

        Parameters
        ----------
        workspace_path : path
            A folder with ``sparse/`` and ``images/``, with ``dense/``, or that
            of the model.
        image_path : path, optional
            The folder of the images.

        Returns
        -------
        Scene
            The views whose images are there, sorted by name. Others, and cameras
            that were scaled to images of another size, are told by the logger
            ``pycurvix``.

        Raises
        ------
        NotFoundError, DataError, UnsupportedError, ArgumentError
        """
        scene, notes = _core.Scene.from_colmap(os.fspath(workspace_path), os.fspath(image_path))
        for note in notes:
            _warn(note)
        return cls(_core=scene)

    @classmethod
    def from_arrays(cls, K: ArrayLike, R: ArrayLike, t: ArrayLike, images: Sequence[Image] | None = None, *,
                    edges: Sequence[ArrayLike] | None = None, sizes: ArrayLike | None = None,
                    names: Sequence[str] | None = None,
                    edge_spacing_px: float = 0.5) -> Scene:
        """Views from arrays: pinhole cameras and either images or edges.

        Parameters
        ----------
        K : array, (3, 3) or (N, 3, 3)
            Calibration, without skew. Pixels, the centre of the top-left one at
            (0.5, 0.5). One for all is one camera, else each view has its own;
            runs may refine them.
        R : array, (N, 3, 3)
            Rotations: ``x_camera = R @ x_world + t``.
        t : array, (N, 3)
            Translations, in the unit of the world.
        images : sequence of N paths or arrays, optional
            Images without distortion: files, or arrays of uint8 or uint16, grey
            (H, W), red, green and blue (H, W, 3), or with alpha (H, W, 4), which
            is over black. Arrays are kept, not copied, if they are without gaps:
            leave them as they are while you use the scene.
        edges : sequence of N arrays, (M_i, 3) or (M_i, 4), optional
            Instead of images, the edges of each view: x, y, the angle of the
            tangent from +x to +y in radians, with the brighter side at
            ``(-sin, cos)``, and the gradient in grey levels per pixel (50
            without that column). About half a pixel apart along a contour.
        sizes : array, (2,) or (N, 2), optional
            Width and height in pixels. Needed with edges; else those of the
            images.
        names : sequence of N str, optional
            Names of the views. By default the paths of the images as given, or
            all from the folder that they share if one is absolute or holds
            '..'; of arrays and edges view_00000, view_00001 and so on.
        edge_spacing_px : float
            How far the edges of a contour are apart.

        Returns
        -------
        Scene
            Its views are in the given order.

        Raises
        ------
        ArgumentError, NotFoundError, DataError
        """
        rotations = _array('R', R, (None, 3, 3))
        num_views = len(rotations)
        translations = _array('t', t, (num_views, 3))
        if (images is None) == (edges is None):
            raise _core.ArgumentError('a scene from arrays has either images or edges')
        for name, values in (('images', images), ('edges', edges), ('names', names)):
            if values is not None and len(values) != num_views:
                are = 'is' if len(values) == 1 else 'are'
                raise _core.ArgumentError(f'there {are} {plural(len(values), name[:-1])} for {plural(num_views, "view")}')
        calibrations = _array('K', K, (3, 3) if np.ndim(K) == 2 else (num_views, 3, 3)).reshape(-1, 3, 3)
        given: Sequence[Image] = [''] * num_views if images is None else images
        paths = [os.fspath(image) if _is_path(image) else '' for image in given]
        pixels = [None if _is_path(image) else _pixels(f'images[{i}]', image) for i, image in enumerate(given)]
        if names is None:
            names = [name or f'view_{i:05d}' for i, name in enumerate(_names_of_files(paths))]
        names = _names(names)
        cameras = _pinholes(calibrations, sizes, needs_sizes=images is None)
        quaternions = _quaternions(rotations)
        views = [_core.ViewInput(names[i], paths[i], i + 1, min(i, len(cameras) - 1), quaternions[i],
                                 translations[i], pixels[i]) for i in range(num_views)]
        no_points = (np.empty((0, 3)), np.empty((0, 2), np.int64), np.empty((0, 2)))
        scene = _core.Scene.make(cameras, views, *no_points)
        if edges is not None:
            spacing_px = _number_above_0('edge_spacing_px', edge_spacing_px)
            scene = scene.with_edges([_edge_rows(i, rows) for i, rows in enumerate(edges)], spacing_px)
        return cls(_core=scene)

    @classmethod
    def from_pycolmap(cls, reconstruction: Any, image_path: Path) -> Scene:
        """Views, cameras and points of a ``pycolmap.Reconstruction``.

        Parameters
        ----------
        reconstruction : pycolmap.Reconstruction
            Of any version, or anything with the same attributes.
        image_path : path
            The folder of the images.

        Returns
        -------
        Scene
            The views that are registered and whose images are there, sorted by
            name. Others are told by the logger ``pycurvix``.

        Raises
        ------
        ArgumentError, UnsupportedError
        """
        folder = os.fspath(image_path)
        registered = sorted((image for image in reconstruction.images.values() if _is_registered(image)),
                            key=lambda image: image.name.encode())
        images = [image for image in registered if os.path.isfile(os.path.join(folder, image.name))]
        if len(images) < len(registered):
            num_missing = len(registered) - len(images)
            are = 'is' if num_missing == 1 else 'are'
            _warn(f'{num_missing} of {plural(len(registered), "image")} {are} not in {folder} and {are} skipped')
        ids = sorted(reconstruction.cameras)
        cameras = [_camera(reconstruction.cameras[i]) for i in ids]
        camera_idx = {camera_id: i for i, camera_id in enumerate(ids)}
        views = [_core.ViewInput(image.name, os.path.join(folder, image.name), image.image_id,
                                 camera_idx[image.camera_id], *_pose(image)) for image in images]
        return cls(_core=_core.Scene.make(cameras, views, *_observed_points(reconstruction, images)))

    def __len__(self) -> int:
        return len(self._core)

    @property
    def names(self) -> list[str]:
        """Names of the images, relative to their folder; the views' order."""
        return [os.fsdecode(name) for name in self._core.names()]

    @property
    def image_paths(self) -> list[str]:
        """Files of the images; '' where there are arrays or edges instead."""
        return [os.fspath(path) if str(path) != '.' else '' for path in self._core.image_paths()]

    @property
    def image_ids(self) -> list[int]:
        """COLMAP's ids of the images."""
        return self._core.image_ids()

    @property
    def K(self) -> NDArray[np.float64]:
        """Calibrations (N, 3, 3), lens distortion aside."""
        return np.reshape(self._core.calibrations(), (-1, 3, 3))

    @property
    def R(self) -> NDArray[np.float64]:
        """Rotations (N, 3, 3): ``x_camera = R @ x_world + t``."""
        return np.reshape(self._core.rotations(), (-1, 3, 3))

    @property
    def t(self) -> NDArray[np.float64]:
        """Translations (N, 3), in the unit of the world."""
        return np.reshape(self._core.translations(), (-1, 3))

    @property
    def sizes(self) -> NDArray[np.int64]:
        """Widths and heights of the images (N, 2), pixels."""
        return np.reshape(self._core.sizes(), (-1, 2))

    @property
    def camera_models(self) -> list[str]:
        """COLMAP's names of the camera models, of each view."""
        return self._core.camera_models()

    @property
    def camera_params(self) -> list[list[float]]:
        """Parameters of the cameras, in COLMAP's order, of each view."""
        return self._core.camera_params()

    @property
    def points(self) -> NDArray[np.float64]:
        """Sparse points (P, 3)."""
        return np.reshape(self._core.points(), (-1, 3))

    def view_idx(self, view: int | str) -> int:
        """The index of a view.

        Parameters
        ----------
        view : int or str
            Its index, from the end if it is negative, or its name.

        Returns
        -------
        int

        Raises
        ------
        ArgumentError
            There is no such view.
        """
        names = self.names
        if isinstance(view, str) and view in names:
            return names.index(view)
        is_index = isinstance(view, numbers.Integral) and not isinstance(view, bool)
        if is_index and -len(names) <= view < len(names):
            return int(view) % len(names)
        raise _core.ArgumentError(f'there is no view {view!r} among {len(names)}')

    def __repr__(self) -> str:
        what = ' with edges' if self._core.has_edges() else ''
        return (f'<pycurvix.Scene: {plural(len(self), "view")}{what}, {plural(self._core.num_cameras(), "camera")}, '
                f'{plural(len(self._core.points()), "point")}>')


def _pinholes(calibrations: NDArray[np.float64], sizes: ArrayLike | None, needs_sizes: bool) -> list[_core.CameraInput]:
    if sizes is None and needs_sizes:
        raise _core.ArgumentError('edges say nothing of the size of an image; give sizes')
    shape = (2,) if np.ndim(sizes) == 1 else (len(calibrations), 2)
    pixels = np.zeros((1, 2)) if sizes is None else _array('sizes', sizes, shape).reshape(-1, 2)
    if sizes is not None and not ((pixels >= 1) & (pixels <= _MOST_PIXELS) & (pixels == np.rint(pixels))).all():
        raise _core.ArgumentError(f'sizes are whole numbers of pixels from 1 to {_MOST_PIXELS}')
    cameras = []
    for i, calibration in enumerate(calibrations):
        (fx, skew, cx), (zero, fy, cy) = calibration[:2]
        if skew != 0 or zero != 0 or not np.array_equal(calibration[2], (0, 0, 1)):
            raise _core.ArgumentError(f'K[{i}] is not [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]')
        width, height = pixels[min(i, len(pixels) - 1)]
        cameras.append(_core.CameraInput('PINHOLE', int(width), int(height), [fx, fy, cx, cy]))
    return cameras


def _edge_rows(view_idx: int, rows: ArrayLike) -> NDArray[np.float64]:
    width = 4 if np.ndim(rows) == 2 and np.shape(rows)[1] == 4 else 3
    array = _array(f'edges[{view_idx}]', np.reshape(rows, (0, 3)) if np.size(rows) == 0 else rows, (None, width))
    return array if width == 4 else np.column_stack((array, np.full(len(array), 50.0)))


def _value(thing: Any) -> Any:
    """Methods in one version of pycolmap, properties in another."""
    return thing() if callable(thing) else thing


def _is_registered(image: Any) -> bool:
    for name in ('has_pose', 'registered'):
        if hasattr(image, name):
            return bool(_value(getattr(image, name)))
    return True


def _pose(image: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The quaternion x, y, z, w and the translation."""
    if hasattr(image, 'cam_from_world'):
        pose = _value(image.cam_from_world)
        return np.asarray(_value(pose.rotation.quat), float), np.asarray(_value(pose.translation), float)
    return np.roll(np.asarray(image.qvec, float), -1), np.asarray(image.tvec, float)


def _camera(camera: Any) -> _core.CameraInput:
    model = getattr(camera, 'model_name', None) or getattr(camera.model, 'name', None) or camera.model
    return _core.CameraInput(str(model), int(camera.width), int(camera.height), [float(p) for p in camera.params])


def _observed_points(reconstruction: Any, images: Sequence[Any]) -> tuple[Any, Any, Any]:
    """Positions, rows (point, view) and the pixels of these, as in the model."""
    views = {image.image_id: i for i, image in enumerate(images)}
    pixels_of = {image.image_id: [point.xy for point in image.points2D] for image in images}
    positions, observations, pixels = [], [], []
    for point_id in sorted(reconstruction.points3D):
        point = reconstruction.points3D[point_id]
        seen = {}
        for element in point.track.elements:
            if element.image_id in views:
                seen.setdefault(views[element.image_id], pixels_of[element.image_id][element.point2D_idx])
        if seen:
            observations += [(len(positions), view) for view in sorted(seen)]
            pixels += [seen[view] for view in sorted(seen)]
            positions.append(point.xyz)
    return (np.reshape(positions, (-1, 3)).astype(float), np.reshape(observations, (-1, 2)).astype(np.int64),
            np.reshape(pixels, (-1, 2)).astype(float))


def core_scene(scene: Scene) -> _core.Scene:
    """What functions take as a scene."""
    if not isinstance(scene, Scene):
        raise TypeError(f'a scene is a pycurvix.Scene, not {type(scene).__name__}')
    return scene._core
