#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a copy of a workspace whose poses are wrong.

usage: disturb_poses.py WORKSPACE OUTPUT PIXELS [--only N] [--simple_lens]
                        [--camera_per_image] [--seed N]

WORKSPACE holds sparse/0 as text, and images/. OUTPUT gets a model with
cameras of the same values and disturbed poses, without points, and a link to
the images. Each camera is turned and shifted at random, each by what moves its
picture by half of PIXELS (standard deviation, in x and in y): the root mean
square of the shifts of the picture is PIXELS. The same seed gives the same
poses.

--only N       N of the poses, evenly spaced
--simple_lens  a RADIAL camera becomes the SIMPLE_RADIAL one that is most like
               it, with the principal point in the middle, and poses are turned
               by the shift of the principal point
--camera_per_image
               each image has a camera of its own, with the same values

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


def turned(fields, turn):
    """One line of images.txt, as fields, with the camera turned."""
    pose = [float(field) for field in fields[1:8]]
    pose = (*multiply(turn, pose[:4]), *rotate(turn, pose[4:]))
    return [fields[0], *(repr(value) for value in pose), *fields[8:]]


def simplify_lens(camera):
    """Fields of a RADIAL camera as those of a SIMPLE_RADIAL one, and how that
    is turned for the shift of its principal point."""
    if camera[1] != 'RADIAL':
        raise SystemExit(f'--simple_lens needs RADIAL, not {camera[1]}, cameras')
    width, height = map(int, camera[2:4])
    focal, cx, cy, k1, k2 = map(float, camera[4:])
    # Least squares of f (r + k1 r^3 + k2 r^5) = a r + b r^3 over the picture,
    # whose area within r grows as r^2.
    largest = math.hypot(width, height) / 2 / focal
    radii = [largest * i / 100 for i in range(1, 101)]
    m3, m5, m7, m9 = (sum(r ** power for r in radii) for power in (3, 5, 7, 9))
    y1 = focal * (m3 + k1 * m5 + k2 * m7)
    y3 = focal * (m5 + k1 * m7 + k2 * m9)
    a = (y1 * m7 - y3 * m5) / (m3 * m7 - m5 * m5)
    b = (m3 * y3 - m5 * y1) / (m3 * m7 - m5 * m5)
    values = [a, width / 2, height / 2, b / a]
    shift = (cx - width / 2, cy - height / 2)
    turn = quaternion([-shift[1] / focal, shift[0] / focal, 0])
    return [camera[0], 'SIMPLE_RADIAL', *camera[2:4], *map(repr, values)], turn


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('workspace', type=pathlib.Path)
    parser.add_argument('output', type=pathlib.Path)
    parser.add_argument('pixels', type=float)
    parser.add_argument('--only', type=int)
    parser.add_argument('--simple_lens', action='store_true')
    parser.add_argument('--camera_per_image', action='store_true')
    parser.add_argument('--seed', type=int, default=1)
    args = parser.parse_args()
    source = args.workspace / 'sparse' / '0'
    target = args.output / 'sparse' / '0'
    target.mkdir(parents=True, exist_ok=True)
    cameras = [line.split() for line in data_lines(source / 'cameras.txt')
               if line]
    focal_px = {camera[0]: float(camera[4]) for camera in cameras}
    turns = {camera[0]: (1, 0, 0, 0) for camera in cameras}
    if args.simple_lens:
        for i, camera in enumerate(cameras):
            cameras[i], turns[camera[0]] = simplify_lens(camera)
    (target / 'points3D.txt').write_text('')
    generator = random.Random(args.seed)
    images = [line.split(maxsplit=9)
              for line in data_lines(source / 'images.txt')[::2]]
    num_wrong = min(args.only or len(images), len(images))
    wrong = {k * len(images) // num_wrong for k in range(num_wrong)}
    lines = []
    for i, fields in enumerate(images):
        fields = turned(fields, turns[fields[8]])
        if i in wrong:
            fields = disturb(fields, focal_px[fields[8]], args.pixels,
                             generator)
        if args.camera_per_image:
            fields[8] = fields[0]
        lines += [' '.join(fields), '']
    if args.camera_per_image:
        cameras = [[image[0], *camera[1:]] for image in images
                   for camera in cameras if camera[0] == image[8]]
    (target / 'cameras.txt').write_text(
        ''.join(' '.join(camera) + '\n' for camera in cameras))
    (target / 'images.txt').write_text('\n'.join(lines) + '\n')
    images = args.output / 'images'
    if not images.exists():
        images.symlink_to((args.workspace / 'images').resolve())


if __name__ == '__main__':
    main()
