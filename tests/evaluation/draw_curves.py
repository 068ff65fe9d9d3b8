#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the curves of a run over a photograph of its workspace.

usage: draw_curves.py WORKSPACE OUTPUT.png [--image NAME] [--model sparse/0]
                      [--curves curvix/0] [--panels photo,edges,curves,overlay]
                      [--crop X0,Y0,X1,Y1] [--height 420]

Panels, side by side:
  photo    the photograph
  edges    the 3D edges before they are grouped (edges.ply), by direction
  curves   the curves (curves.txt), each in its own colour
  overlay  the curves over the photograph; faint where the photograph has no
           edge that supports them, which is where something hides them

NAME defaults to the image that supports most samples. Needs Debian's
python3-numpy and python3-matplotlib. Cameras: SIMPLE_PINHOLE, PINHOLE and
SIMPLE_RADIAL, in a binary model.
"""
import argparse
import pathlib
import struct

import matplotlib
import numpy as np

matplotlib.use('Agg')
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection

PARAMS = {0: 3, 1: 4, 2: 4}  # numbers of parameters by COLMAP's model id


def read_cameras(path):
    """camera_id -> (fx, fy, cx, cy, k)"""
    cameras = {}
    with open(path, 'rb') as file:
        for _ in range(struct.unpack('<Q', file.read(8))[0]):
            camera_id, model, _, _ = struct.unpack('<iiQQ', file.read(24))
            if model not in PARAMS:
                raise SystemExit(f'{path}: camera model {model} is not drawn')
            p = struct.unpack(f'<{PARAMS[model]}d', file.read(8 * PARAMS[model]))
            focal = p[:2] if model == 1 else (p[0], p[0])
            center = p[2:4] if model == 1 else p[1:3]
            cameras[camera_id] = (*focal, *center, p[3] if model == 2 else 0)
    return cameras


def read_images(path):
    """name -> (image_id, camera_id, rotation, translation), cam_from_world"""
    images = {}
    with open(path, 'rb') as file:
        for _ in range(struct.unpack('<Q', file.read(8))[0]):
            image_id, *pose, camera_id = struct.unpack('<I7dI', file.read(64))
            name = b''.join(iter(lambda: file.read(1), b'\0')).decode()
            file.seek(24 * struct.unpack('<Q', file.read(8))[0], 1)
            images[name] = (image_id, camera_id, rotation(pose[:4]), pose[4:])
    return images


def rotation(quaternion):
    w, x, y, z = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def read_curves(path):
    """A list of (closed, positions, sets of supporting image ids)"""
    lines = (l.split() for l in open(path) if not l.startswith('#'))
    curves = []
    for _, closed, count in lines:
        rows = [next(lines) for _ in range(int(count))]
        curves.append((closed == '1',
                       np.array([row[:3] for row in rows], float),
                       [set(map(int, row[8:])) for row in rows]))
    return curves


def read_edges(path):
    with open(path, 'rb') as file:
        header = b''.join(iter(file.readline, b'end_header\n')).decode()
        count = int(header.split('element vertex ')[1].split()[0])
        return np.fromfile(file, [('xyz', '<f4', 3), ('tangent', '<f4', 3),
                                  ('rgb', 'u1', 3), ('support', '<f4')], count)


class View:
    """A photograph and its camera; x, y from the image's top-left corner."""

    def __init__(self, image_path, camera, image_id, turn, shift):
        self.pixels = plt.imread(image_path)
        self.camera, self.image_id = camera, image_id
        self.turn, self.shift = turn, np.array(shift)

    def project(self, points):
        x, y, z = self.turn @ np.asarray(points, float).T + self.shift[:, None]
        z = np.where(z > 0, z, np.nan)
        fx, fy, cx, cy, k = self.camera
        u, v = x / z, y / z
        r = 1 + k * (u * u + v * v)
        return np.stack([fx * u * r + cx, fy * v * r + cy], -1)

    def show_photo(self, axes):
        height, width = self.pixels.shape[:2]
        axes.imshow(self.pixels, extent=(0, width, height, 0),
                    cmap='gray' if self.pixels.ndim == 2 else None)


def segments(view, curve):
    """Segments in the image and whether the view supports them."""
    closed, positions, ids = curve
    pixels = view.project(positions)
    seen = np.array([view.image_id in s for s in ids])
    following = np.roll(np.arange(len(pixels)), -1)
    pairs = np.stack([pixels, pixels[following]], 1)
    both = seen & seen[following]
    return (pairs, both) if closed else (pairs[:-1], both[:-1])


def color(index):
    return plt.get_cmap('hsv')((0.02 + 0.618034 * index) % 1.0)


def draw_curves(axes, view, curves, faint):
    for index, curve in enumerate(curves):
        pairs, seen = segments(view, curve)
        axes.add_collection(LineCollection(
            pairs[~seen], colors=[color(index)], linewidths=0.9, alpha=faint))
        axes.add_collection(LineCollection(
            pairs[seen], colors=[color(index)], linewidths=1.6,
            capstyle='round'))


def draw_edges(axes, view, edges):
    step = 1e-3 * np.linalg.norm(edges['xyz'].mean(0) + view.turn.T @ view.shift)
    ends = [view.project(edges['xyz'] + sign * step * edges['tangent'])
            for sign in (-1, 1)]
    axes.add_collection(LineCollection(
        np.stack(ends, 1), colors=0.85 * edges['rgb'] / 255, linewidths=0.7))


def most_supporting(curves, images):
    counts = {}
    for _, _, samples in curves:
        for ids in samples:
            for image_id in ids:
                counts[image_id] = counts.get(image_id, 0) + 1
    return max(sorted(images), key=lambda n: counts.get(images[n][0], 0))


def draw(arguments):
    workspace = pathlib.Path(arguments.workspace)
    model, run = workspace / arguments.model, workspace / arguments.curves
    images = read_images(model / 'images.bin')
    curves = read_curves(run / 'curves.txt')
    name = arguments.image or most_supporting(curves, images)
    image_id, camera_id, turn, shift = images[name]
    camera = read_cameras(model / 'cameras.bin')[camera_id]
    view = View(workspace / 'images' / name, camera, image_id, turn, shift)

    height, width = view.pixels.shape[:2]
    x0, y0, x1, y1 = arguments.crop or (0, 0, width, height)
    panels = arguments.panels.split(',')
    inches = arguments.height / 100
    figure, all_axes = plt.subplots(
        1, len(panels), squeeze=False, dpi=100,
        figsize=(len(panels) * inches * (x1 - x0) / (y1 - y0), inches))
    for panel, axes in zip(panels, all_axes[0]):
        if panel in ('photo', 'overlay'):
            view.show_photo(axes)
        if panel == 'edges':
            draw_edges(axes, view, read_edges(run / 'edges.ply'))
        if panel in ('curves', 'overlay'):
            draw_curves(axes, view, curves, 0.55 if panel == 'curves' else 0.3)
        axes.set(xlim=(x0, x1), ylim=(y1, y0), aspect='equal')
        axes.axis('off')
    figure.subplots_adjust(0, 0, 1, 1, 0.01, 0)
    figure.savefig(arguments.output)
    print(f'{arguments.output}: {len(curves)} curves over {name}')


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('workspace')
    parser.add_argument('output')
    parser.add_argument('--image')
    parser.add_argument('--model', default='sparse/0')
    parser.add_argument('--curves', default='curvix/0')
    parser.add_argument('--panels', default='photo,edges,curves,overlay')
    parser.add_argument('--crop',
                        type=lambda text: tuple(map(float, text.split(','))))
    parser.add_argument('--height', type=int, default=420, help='pixels')
    draw(parser.parse_args())


if __name__ == '__main__':
    main()
