#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a copy of a workspace that is harder than the original.

usage: degrade_scene.py WORKSPACE OUTPUT [--views N] [--noise SIGMA] [--half]
                        [--seed N]

--views N      N of the images, evenly spaced in the order of their names
--noise SIGMA  adds Gaussian noise of SIGMA grey levels to every colour
--half         images of half the width and height, means of 2 x 2 pixels

WORKSPACE holds sparse/0 as text with PINHOLE cameras, and images/; OUTPUT gets
both, and gt.txt if there is one. Transparent images become black where nothing
is. The same seed gives the same noise. Needs Debian's python3-numpy and
python3-pil.
"""
import argparse
import pathlib
import shutil

import numpy as np
from PIL import Image


def degraded(path, noise, half, generator):
    """The pixels of an image, 8 bits."""
    with Image.open(path) as image:
        if 'A' in image.getbands():
            black = Image.new('RGBA', image.size, (0, 0, 0, 255))
            image = Image.alpha_composite(black, image.convert('RGBA'))
        pixels = np.asarray(image.convert('RGB'), float)
    if half:
        height, width = (size // 2 for size in pixels.shape[:2])
        pixels = pixels[:2 * height, :2 * width].reshape(
            height, 2, width, 2, 3).mean((1, 3))
    pixels = pixels + noise * generator.standard_normal(pixels.shape)
    return np.clip(np.rint(pixels), 0, 255).astype(np.uint8)


def halved(line):
    """One line of cameras.txt: id, model, width, height, parameters."""
    fields = line.split()
    if fields[1] != 'PINHOLE':
        raise SystemExit(f'{fields[1]} cameras cannot be halved')
    sizes = [str(int(size) // 2) for size in fields[2:4]]
    return ' '.join(fields[:2] + sizes
                    + [repr(float(value) / 2) for value in fields[4:]])


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('workspace', type=pathlib.Path)
    parser.add_argument('output', type=pathlib.Path)
    parser.add_argument('--views', type=int)
    parser.add_argument('--noise', type=float, default=0)
    parser.add_argument('--half', action='store_true')
    parser.add_argument('--seed', type=int, default=1)
    arguments = parser.parse_args()
    generator = np.random.default_rng(arguments.seed)
    (arguments.output / 'images').mkdir(parents=True)
    model = arguments.output / 'sparse/0'
    shutil.copytree(arguments.workspace / 'sparse/0', model)
    if arguments.half:
        lines = (model / 'cameras.txt').read_text().splitlines()
        (model / 'cameras.txt').write_text('\n'.join(
            line if line.startswith('#') or not line else halved(line)
            for line in lines) + '\n')
    if (arguments.workspace / 'gt.txt').exists():
        shutil.copy(arguments.workspace / 'gt.txt', arguments.output)
    paths = sorted((arguments.workspace / 'images').iterdir())
    num_views = arguments.views or len(paths)
    for k in range(num_views):
        path = paths[k * len(paths) // num_views]
        target = arguments.output / 'images' / path.name
        if arguments.noise == 0 and not arguments.half:
            shutil.copy(path, target)
            continue
        pixels = degraded(path, arguments.noise, arguments.half, generator)
        Image.fromarray(pixels).save(target)


if __name__ == '__main__':
    main()
