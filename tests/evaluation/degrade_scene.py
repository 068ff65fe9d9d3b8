#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a copy of a workspace that is harder than the original.

usage: degrade_scene.py WORKSPACE OUTPUT [--views N] [--noise SIGMA]
                        [--lens | --half] [--seed N]

--views N      N of the images, evenly spaced in the order of their names, and
               their poses
--lens         images of a RADIAL camera with k1 = -0.05 and k2 = 0.01, whose
               principal point is 4 px off
--noise SIGMA  adds Gaussian noise of SIGMA grey levels to every colour
--half         images of half the width and height, means of 2 x 2 pixels

WORKSPACE holds sparse/0 as text with PINHOLE cameras, and images/; OUTPUT gets
both, and gt.txt if there is one. Transparent images become black where nothing
is. The same seed gives the same noise. Needs Debian's python3-numpy,
python3-pil and, for --lens, python3-scipy.
"""
import argparse
import pathlib
import shutil

import numpy as np
from PIL import Image


LENS = (-0.05, 0.01)  # k1, k2
PRINCIPAL_POINT_SHIFT = (4, -4)


def camera_lines(model):
    """Lines of cameras.txt as fields: id, model, width, height, parameters."""
    lines = (model / 'cameras.txt').read_text().splitlines()
    return [line.split() for line in lines
            if line.strip() and not line.startswith('#')]


def with_lens(pixels, camera):
    """The picture of a PINHOLE camera as its RADIAL one sees it."""
    from scipy.ndimage import map_coordinates

    fx, fy, cx, cy = map(float, camera[4:8])
    height, width = pixels.shape[:2]
    v, u = np.mgrid[:height, :width] + 0.5
    distorted = np.array([(u - cx - PRINCIPAL_POINT_SHIFT[0]) / fx,
                          (v - cy - PRINCIPAL_POINT_SHIFT[1]) / fx])
    straight = distorted
    for _ in range(20):
        r2 = (straight ** 2).sum(0)
        straight = distorted / (1 + LENS[0] * r2 + LENS[1] * r2 ** 2)
    at = [straight[1] * fy + cy - 0.5, straight[0] * fx + cx - 0.5]
    return np.dstack([map_coordinates(channel, at, mode='nearest')
                      for channel in np.moveaxis(pixels, 2, 0)])


def lens_camera(camera):
    """Fields of a PINHOLE camera as fields of the RADIAL one."""
    fx, fy, cx, cy = map(float, camera[4:8])
    values = [fx, cx + PRINCIPAL_POINT_SHIFT[0], cy + PRINCIPAL_POINT_SHIFT[1],
              *LENS]
    return [camera[0], 'RADIAL', *camera[2:4], *map(repr, values)]


def degraded(path, camera, noise, half, generator):
    """The pixels of an image, 8 bits. With a lens if a camera is given."""
    with Image.open(path) as image:
        if 'A' in image.getbands():
            black = Image.new('RGBA', image.size, (0, 0, 0, 255))
            image = Image.alpha_composite(black, image.convert('RGBA'))
        pixels = np.asarray(image.convert('RGB'), float)
    if camera:
        pixels = with_lens(pixels, camera)
    if half:
        height, width = (size // 2 for size in pixels.shape[:2])
        pixels = pixels[:2 * height, :2 * width].reshape(
            height, 2, width, 2, 3).mean((1, 3))
    pixels = pixels + noise * generator.standard_normal(pixels.shape)
    return np.clip(np.rint(pixels), 0, 255).astype(np.uint8)


def halved(camera):
    """Fields of a camera for images of half the width and height."""
    sizes = [str(int(size) // 2) for size in camera[2:4]]
    return camera[:2] + sizes + [repr(float(value) / 2) for value in camera[4:]]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('workspace', type=pathlib.Path)
    parser.add_argument('output', type=pathlib.Path)
    parser.add_argument('--views', type=int)
    parser.add_argument('--noise', type=float, default=0)
    either = parser.add_mutually_exclusive_group()
    either.add_argument('--lens', action='store_true')
    either.add_argument('--half', action='store_true')
    parser.add_argument('--seed', type=int, default=1)
    arguments = parser.parse_args()
    generator = np.random.default_rng(arguments.seed)
    (arguments.output / 'images').mkdir(parents=True)
    model = arguments.output / 'sparse/0'
    shutil.copytree(arguments.workspace / 'sparse/0', model)
    cameras = camera_lines(model)
    if any(camera[1] != 'PINHOLE' for camera in cameras):
        raise SystemExit('all cameras must be PINHOLE')
    lens = cameras[0] if arguments.lens else None
    if arguments.half:
        cameras = [halved(camera) for camera in cameras]
    if arguments.lens:
        cameras = [lens_camera(camera) for camera in cameras]
    (model / 'cameras.txt').write_text(
        ''.join(' '.join(camera) + '\n' for camera in cameras))
    if (arguments.workspace / 'gt.txt').exists():
        shutil.copy(arguments.workspace / 'gt.txt', arguments.output)
    paths = sorted((arguments.workspace / 'images').iterdir())
    num_views = arguments.views or len(paths)
    paths = [paths[k * len(paths) // num_views] for k in range(num_views)]
    names = {path.name for path in paths}
    poses = [line for line in (model / 'images.txt').read_text().splitlines()
             if not line.startswith('#')][::2]
    (model / 'images.txt').write_text(
        ''.join(line + '\n\n' for line in poses
                if line.split(maxsplit=9)[9] in names))
    for path in paths:
        target = arguments.output / 'images' / path.name
        if arguments.noise == 0 and not arguments.half and not lens:
            shutil.copy(path, target)
            continue
        pixels = degraded(path, lens, arguments.noise, arguments.half,
                          generator)
        Image.fromarray(pixels).save(target)


if __name__ == '__main__':
    main()
