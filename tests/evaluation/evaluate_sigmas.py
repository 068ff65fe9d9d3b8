#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the uncertainties in curves.json with the errors against true curves.

  evaluate_sigmas.py <curves.json> <gt.txt> [<curves.json> <gt.txt> ...]

The error of a sample is its offset from the line through the nearest true
sample along the true tangent; samples farther than --distance from the truth
and those beyond the ends of true curves are left out. Printed: the median
distance, in units of the scene; and the spread of errors in standard
deviations of each axis, by sigma and by the covariance: median over that of a
normal distribution, 1 if uncertainties are right.
"""
import argparse
import json

import numpy as np
from scipy.spatial import cKDTree

MEDIAN_OF_TWO_AXES = np.sqrt(2 * np.log(2))


def samples_of(path):
    with open(path) as file:
        curves = json.load(file)['curves']
    samples = [s for curve in curves for s in curve['samples'] if any(s['covariance'])]
    triangles = np.array([s['covariance'] for s in samples])
    return (np.array([s['position'] for s in samples]),
            np.array([s['sigma'] for s in samples]),
            triangles[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3))


def errors_of(positions, truth, max_distance):
    """Offsets across the true curves, and which of them count."""
    points, tangents = truth[:, :3], truth[:, 3:6]
    tree = cKDTree(points)
    distances, nearest = tree.query(positions)
    spacing = np.median(tree.query(points, k=2)[0][:, 1])
    offsets = positions - points[nearest]
    along = np.einsum('ij,ij->i', offsets, tangents[nearest])
    across = offsets - along[:, None] * tangents[nearest]
    return across, (distances < max_distance) & (np.abs(along) < spacing)


def spread(normalised):
    return np.median(normalised) / MEDIAN_OF_TWO_AXES


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('files', nargs='+', help='curves.json and gt.txt in turn')
    parser.add_argument('--distance', type=float, default=0.005)
    args = parser.parse_args()
    if len(args.files) % 2:
        parser.error('each curves.json needs its gt.txt')
    print('samples, median distance, spread by sigma, spread by covariance')
    for curves, truth in zip(args.files[::2], args.files[1::2]):
        positions, sigmas, covariances = samples_of(curves)
        errors, counts = errors_of(positions, np.loadtxt(truth), args.distance)
        errors, sigmas = errors[counts], sigmas[counts]
        # Of rank two, but for rounding: the direction along the curve is left out.
        variances, axes = np.linalg.eigh(covariances[counts])
        squares = (np.einsum('ij,ijk->ik', errors, axes)[:, 1:]**2 / variances[:, 1:]).sum(1)
        distances = np.linalg.norm(errors, axis=1)
        print(f'{truth}: {counts.sum()}, {np.median(distances):.6f}, '
              f'{spread(distances / sigmas):.2f}, {spread(np.sqrt(squares)):.2f}')


if __name__ == '__main__':
    main()
