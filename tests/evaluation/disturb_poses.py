#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a copy of a workspace whose poses are wrong.

usage: disturb_poses.py WORKSPACE OUTPUT PIXELS [--seed N]

WORKSPACE holds sparse/0 as text, and images/. OUTPUT gets a model with the
same cameras and disturbed poses, without points, and a link to the images.
Each camera is turned and shifted at random, each by what moves its picture by
half of PIXELS (standard deviation, in x and in y): the root mean square of
the shifts of the picture is PIXELS. The same seed gives the same poses.
Needs Python 3.9 and nothing else.
"""
import argparse
import math
import pathlib
import random


def data_lines(path):
    return [line for line in path.read_text().splitlines()
            if not line.startswith('#')]


def multiply(a, b):
    """The product of two quaternions (w, x, y, z)."""
    w1, x1, y1, z1 = a
    w2, x2, y2, z2 = b
    return (w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2,
            w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
            w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
            w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2)


def rotate(q, v):
    w, x, y, z = q
    return multiply(multiply(q, (0, *v)), (w, -x, -y, -z))[1:]


def quaternion(turn):
    """The rotation by |turn| about turn."""
    angle = math.hypot(*turn)
    if angle == 0:
        return (1, 0, 0, 0)
    s = math.sin(angle / 2) / angle
    return (math.cos(angle / 2), *(s * t for t in turn))


def disturb(fields, focal_px, pixels, generator):
    """One line of images.txt, as fields, with another pose."""
    pose = [float(field) for field in fields[1:8]]
    sigma = pixels / 2 / focal_px
    distance = math.hypot(*pose[4:])
    turn = quaternion([generator.gauss(0, sigma) for _ in range(3)])
    shift = [generator.gauss(0, sigma) * distance for _ in range(3)]
    translation = [a + b for a, b in zip(rotate(turn, pose[4:]), shift)]
    pose = (*multiply(turn, pose[:4]), *translation)
    return [fields[0], *(repr(value) for value in pose), *fields[8:]]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('workspace', type=pathlib.Path)
    parser.add_argument('output', type=pathlib.Path)
    parser.add_argument('pixels', type=float)
    parser.add_argument('--seed', type=int, default=1)
    args = parser.parse_args()
    source = args.workspace / 'sparse' / '0'
    target = args.output / 'sparse' / '0'
    target.mkdir(parents=True, exist_ok=True)
    cameras = (source / 'cameras.txt').read_text()
    (target / 'cameras.txt').write_text(cameras)
    (target / 'points3D.txt').write_text('')
    focal_px = {line.split()[0]: float(line.split()[4])
                for line in data_lines(source / 'cameras.txt') if line}
    generator = random.Random(args.seed)
    lines = []
    for line in data_lines(source / 'images.txt')[::2]:
        fields = line.split(maxsplit=9)
        lines += [' '.join(disturb(fields, focal_px[fields[8]], args.pixels,
                                   generator)), '']
    (target / 'images.txt').write_text('\n'.join(lines) + '\n')
    images = args.output / 'images'
    if not images.exists():
        images.symlink_to((args.workspace / 'images').resolve())


if __name__ == '__main__':
    main()
