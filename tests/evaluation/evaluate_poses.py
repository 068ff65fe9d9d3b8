#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Disturbs the poses of scenes with known curves, and tells what is left.

usage: evaluate_poses.py SCENE... [--pixels 0.5,1,2] [--only N] [--lens]
                         [--camera_per_image] [--views N] [--seed N]
                         [--program build/bin/colmap_curvix]

Prints a table: for each SCENE, a workspace with gt.txt, and each number of
pixels that its pictures were moved by (disturb_poses.py): the median distance
between the projections of the true curves with the poses and cameras before
refinement, and after it, and with the true ones, once the seven numbers that
no photograph tells (place, direction and unit of the world) are taken out; and
Fv5 of the curves with the true cameras, without and with refinement. 0 pixels:
the poses as they are.

--only N   only N poses are disturbed
--lens     images of a RADIAL camera, given as a SIMPLE_RADIAL one
--camera_per_image
           each image has a camera of its own
--views N  N of the images

Needs Debian's python3-numpy and python3-scipy, and for --lens python3-pil.
Scenes are only read.
"""
import argparse
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

ROOT = pathlib.Path(__file__).resolve().parents[2]
NUM_SAMPLES = 300


def data_lines(path):
    return [line for line in path.read_text().splitlines()
            if not line.startswith('#')]


def pose_of(numbers):
    """(rotation matrix, translation) of w, x, y, z and the translation."""
    w, x, y, z, *translation = numbers
    return (Rotation.from_quat([x, y, z, w]).as_matrix(),
            np.array(translation))


def read_text_images(path):
    """{image name: (pose_of, camera id)}."""
    images = {}
    for line in data_lines(path)[::2]:
        fields = line.split(maxsplit=9)
        images[fields[9]] = (pose_of(map(float, fields[1:8])), int(fields[8]))
    return images


def read_binary_images(path):
    """{image name: (pose_of, camera id)}."""
    data = path.read_bytes()
    images = {}
    place = 8
    for _ in range(*struct.unpack_from('<Q', data)):
        *numbers, camera_id = struct.unpack_from('<7di', data, place + 4)
        begin = place + 64
        end = data.index(0, begin)
        images[data[begin:end].decode()] = (pose_of(numbers), camera_id)
        place = end + 9 + 24 * struct.unpack_from('<Q', data, end + 1)[0]
    return images


def read_images(model):
    """{image name: (pose_of, camera id)} of a model as text or binary."""
    path = model / 'images.txt'
    return (read_text_images(path) if path.exists()
            else read_binary_images(model / 'images.bin'))


MODELS = {'SIMPLE_PINHOLE': 3, 'PINHOLE': 4, 'SIMPLE_RADIAL': 4, 'RADIAL': 5,
          'OPENCV': 8}  # numbers of parameters, in COLMAP's order


def lens_of(model, values):
    """fx, fy, cx, cy, k1, k2, p1, p2 of the values of a COLMAP camera."""
    values = list(values)
    if model not in ('PINHOLE', 'OPENCV'):
        values.insert(0, values[0])
    return values + [0] * (8 - len(values))


def read_lenses(model):
    """{camera id: lens_of} of a model as text or binary."""
    lenses = {}
    if (model / 'cameras.txt').exists():
        for line in data_lines(model / 'cameras.txt'):
            fields = line.split()
            lenses[int(fields[0])] = lens_of(fields[1], map(float, fields[4:]))
        return lenses
    data = (model / 'cameras.bin').read_bytes()
    place = 8
    for _ in range(*struct.unpack_from('<Q', data)):
        camera_id, model_id = struct.unpack_from('<ii', data, place)
        name, count = list(MODELS.items())[model_id]
        lenses[camera_id] = lens_of(
            name, struct.unpack_from(f'<{count}d', data, place + 24))
        place += 24 + 8 * count
    return lenses


class Model:
    """Poses and lenses of the images of a COLMAP model."""

    def __init__(self, folder):
        self.images = read_images(folder)
        self.lenses = read_lenses(folder)

    def project(self, names, points):
        """Pixels, (images, points, 2), and depths, (images, points)."""
        images = [self.images[name] for name in names]
        rotations = np.array([rotation for (rotation, _), _ in images])
        translations = np.array([translation for (_, translation), _ in images])
        x = np.einsum('vij,pj->vpi', rotations, points) + translations[:, None]
        fx, fy, cx, cy, k1, k2, p1, p2 = np.array(
            [self.lenses[camera_id] for _, camera_id in images]).T[..., None]
        u, v = x[..., 0] / x[..., 2], x[..., 1] / x[..., 2]
        r2 = u ** 2 + v ** 2
        radial = 1 + k1 * r2 + k2 * r2 ** 2
        return np.stack([
            fx * (u * radial + 2 * p1 * u * v + p2 * (r2 + 2 * u ** 2)) + cx,
            fy * (v * radial + 2 * p2 * u * v + p1 * (r2 + 2 * v ** 2)) + cy],
            2), x[..., 2]

    def principal_points(self, names):
        """(images, 1, 2)."""
        return np.array([self.lenses[self.images[name][1]][2:4]
                         for name in names])[:, None]


def moved(points, motion):
    """The points turned, shifted and scaled by seven numbers."""
    turned = Rotation.from_rotvec(motion[:3]).apply(points)
    return np.exp(motion[6]) * turned + motion[3:6]


def median_shift(model, true_model, points):
    """Pixels, after the similarity that makes the shifts smallest. Of points
    in the images, whose size is twice the principal point."""
    ours, true = Model(model), Model(true_model)
    names = sorted(set(ours.images) & set(true.images))
    truth, depths = true.project(names, points)
    centres = true.principal_points(names)
    within = (depths > 0) & (np.abs(truth - centres) < centres).all(axis=2)

    def shifts(motion):
        pixels, _ = ours.project(names, moved(points, motion))
        return (pixels - truth)[within]

    fit = least_squares(lambda motion: shifts(motion).ravel(), np.zeros(7),
                        loss='soft_l1', x_scale='jac')
    return np.median(np.linalg.norm(shifts(fit.x), axis=1))


def run(program, workspace, flags):
    """The folder of the results."""
    subprocess.run([program, '--workspace_path', workspace, '--clean', *flags],
                   check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return workspace / 'curvix/0'


def fv5(program, results, truth):
    scores = json.loads(subprocess.check_output(
        [program, 'evaluate', '--json', '--unit_mm', '1000',
         '--curves_path', results / 'curves.ply', '--truth_path', truth]))
    return scores['Fv5']


def changed(script, scene, copy, *flags):
    """The copy that a script of this folder makes of a scene."""
    subprocess.run([sys.executable, ROOT / 'tests/evaluation' / script, scene,
                    copy, *map(str, flags)], check=True)
    return copy


def row(scene, pixels, arguments):
    program = arguments.program
    unrefined = ['--refiner', 'none', '--refine_poses_with_curves', '0']
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        true_scene = scene
        if arguments.lens or arguments.views:
            true_scene = changed('degrade_scene.py', scene, folder / 'true',
                                 *['--lens'] * arguments.lens,
                                 '--views', arguments.views or 0)
        copy = changed('disturb_poses.py', true_scene, folder / 'copy', pixels,
                       *['--simple_lens'] * arguments.lens,
                       *['--camera_per_image'] * arguments.camera_per_image,
                       '--only', arguments.only or 0,
                       '--seed', arguments.seed)
        truth = true_scene / 'gt.txt'
        points = np.loadtxt(truth)[:, :3]
        points = points[::max(1, len(points) // NUM_SAMPLES)]
        true_model = true_scene / 'sparse/0'
        before = median_shift(copy / 'sparse/0', true_model, points)
        # The true scene may be one that is only read.
        true_copy = changed('disturb_poses.py', true_scene, folder / 'as_is', 0)
        scores = [fv5(program, run(program, true_copy, unrefined), truth),
                  fv5(program, run(program, copy, unrefined), truth)]
        results = run(program, copy, [])
        scores.append(fv5(program, results, truth))
        report = json.loads((results / 'report.json').read_text())
        accepted = report['pose_refinement_with_curves']['accepted']
        after = (median_shift(results / 'sparse', true_model, points)
                 if accepted else before)
        return [scene.name, f'{pixels:g}', f'{before:.3f}', f'{after:.3f}',
                'yes' if accepted else 'no',
                *(f'{score:.1f}' for score in scores)]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('scenes', nargs='+', type=pathlib.Path)
    parser.add_argument('--pixels', default='0,0.5,1,2')
    parser.add_argument('--only', type=int)
    parser.add_argument('--lens', action='store_true')
    parser.add_argument('--camera_per_image', action='store_true')
    parser.add_argument('--views', type=int)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--program', type=pathlib.Path,
                        default=ROOT / 'build/bin/colmap_curvix')
    arguments = parser.parse_args()
    headings = ['scene', 'moved by px', 'before px', 'after px', 'accepted',
                'Fv5 true', 'Fv5 unrefined', 'Fv5']
    for line in [headings, ['---'] * len(headings)]:
        print('| ' + ' | '.join(line) + ' |')
    for scene in arguments.scenes:
        for pixels in arguments.pixels.split(','):
            cells = row(scene, float(pixels), arguments)
            print('| ' + ' | '.join(cells) + ' |', flush=True)


if __name__ == '__main__':
    main()
