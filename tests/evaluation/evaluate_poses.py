#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Disturbs the poses of scenes with known curves, and tells what is left.

usage: evaluate_poses.py SCENE... [--pixels 0.5,1,2] [--seed N]
                         [--program build/bin/colmap_curvix]

Prints a table: for each SCENE, a workspace with gt.txt, and each number of
pixels that its pictures were moved by (disturb_poses.py): the median distance
between the projections of the true curves with the poses before refinement,
and after it, and with the true ones, once the seven numbers that no photograph
tells (place, direction and unit of the world) are taken out; and Fv5 of the
curves without and with refinement. 0 pixels: the poses as they are.
Needs Debian's python3-numpy and python3-scipy. Scenes are only read.
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


def read_text_poses(path):
    """{image name: pose_of}."""
    poses = {}
    for line in data_lines(path)[::2]:
        fields = line.split(maxsplit=9)
        poses[fields[9]] = pose_of(map(float, fields[1:8]))
    return poses


def read_binary_poses(path):
    """{image name: pose_of}."""
    data = path.read_bytes()
    poses = {}
    place = 8
    for _ in range(*struct.unpack_from('<Q', data)):
        numbers = struct.unpack_from('<7d', data, place + 4)
        begin = place + 64
        end = data.index(0, begin)
        poses[data[begin:end].decode()] = pose_of(numbers)
        place = end + 9 + 24 * struct.unpack_from('<Q', data, end + 1)[0]
    return poses


def read_focal_lengths(model):
    fields = data_lines(model / 'cameras.txt')[0].split()
    assert fields[1] == 'PINHOLE', 'scenes have PINHOLE cameras'
    return np.array([float(value) for value in fields[4:6]])


def project(poses, focal_lengths, points):
    """Pixels from the principal point, (views, points, 2)."""
    rotations = np.array([rotation for rotation, _ in poses])
    translations = np.array([translation for _, translation in poses])
    x = np.einsum('vij,pj->vpi', rotations, points) + translations[:, None]
    return focal_lengths * x[..., :2] / x[..., 2:]


def moved(points, motion):
    """The points turned, shifted and scaled by seven numbers."""
    turned = Rotation.from_rotvec(motion[:3]).apply(points)
    return np.exp(motion[6]) * turned + motion[3:6]


def median_shift(poses, true_model, points):
    """Pixels, after the similarity that makes the shifts smallest."""
    focal_lengths = read_focal_lengths(true_model)
    true_poses = read_text_poses(true_model / 'images.txt')
    names = sorted(set(poses) & set(true_poses))
    truth = project([true_poses[n] for n in names], focal_lengths, points)
    ours = [poses[n] for n in names]

    def shifts(motion):
        return project(ours, focal_lengths, moved(points, motion)) - truth

    fit = least_squares(lambda motion: shifts(motion).ravel(), np.zeros(7),
                        loss='soft_l1', x_scale='jac')
    return np.median(np.linalg.norm(shifts(fit.x), axis=2))


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


def row(program, scene, pixels, seed):
    truth = scene / 'gt.txt'
    points = np.loadtxt(truth)[:, :3]
    points = points[::max(1, len(points) // NUM_SAMPLES)]
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / scene.name
        subprocess.run([sys.executable,
                        ROOT / 'tests/evaluation/disturb_poses.py',
                        scene, copy, str(pixels), '--seed', str(seed)],
                       check=True)
        true_model = scene / 'sparse/0'
        before = median_shift(read_text_poses(copy / 'sparse/0/images.txt'),
                              true_model, points)
        unrefined = fv5(program, run(program, copy, [
            '--refiner', 'none', '--refine_poses_with_curves', '0']), truth)
        results = run(program, copy, [])
        report = json.loads((results / 'report.json').read_text())
        accepted = report['pose_refinement_with_curves']['accepted']
        after = (median_shift(read_binary_poses(results / 'sparse/images.bin'),
                              true_model, points)
                 if accepted else before)
        return [scene.name, f'{pixels:g}', f'{before:.3f}', f'{after:.3f}',
                'yes' if accepted else 'no', f'{unrefined:.1f}',
                f'{fv5(program, results, truth):.1f}']


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('scenes', nargs='+', type=pathlib.Path)
    parser.add_argument('--pixels', default='0,0.5,1,2')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--program', type=pathlib.Path,
                        default=ROOT / 'build/bin/colmap_curvix')
    arguments = parser.parse_args()
    headings = ['scene', 'moved by px', 'before px', 'after px', 'accepted',
                'Fv5 unrefined', 'Fv5']
    for line in [headings, ['---'] * len(headings)]:
        print('| ' + ' | '.join(line) + ' |')
    for scene in arguments.scenes:
        for pixels in arguments.pixels.split(','):
            cells = row(arguments.program, scene, float(pixels), arguments.seed)
            print('| ' + ' | '.join(cells) + ' |', flush=True)


if __name__ == '__main__':
    main()
