#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the primitives of curves.json with true lines and circles.

  evaluate_fits.py <curves.json> <gt.txt> [<curves.json> <gt.txt> ...]

A true curve is a line or a circle if its samples lie on one to within 1e-4 of
its size. It counts as visible if four views or more see half of its samples (as
the truth says, else always), as reconstructed if half of its samples have a
fit within --distance, and as recognised if most of those are next to fits of
its kind. Radii are those of the fit next to most samples, and also compared
with their standard deviations; lengths are compared for lines that are
reconstructed to 95 %. --missed lists what was not recognised.
"""
import argparse
import collections
import json

import numpy as np
from scipy.spatial import cKDTree

TRUE_TO = 1e-4
ENOUGH_VIEWS = 4


def line_of(points):
    offsets = points - points.mean(0)
    direction = np.linalg.svd(offsets, full_matrices=False)[2][0]
    along = offsets @ direction
    return np.abs(np.linalg.norm(offsets - np.outer(along, direction), axis=1)).max(), np.ptp(along)


def circle_of(points):
    offsets = points - points.mean(0)
    frame = np.linalg.svd(offsets, full_matrices=False)[2]
    x, y, z = (offsets @ frame.T).T
    u, v, w = np.linalg.lstsq(np.c_[2 * x, 2 * y, np.ones(len(x))], x * x + y * y, rcond=None)[0]
    radius = np.sqrt(max(w + u * u + v * v, 0))
    return np.hypot(np.hypot(x - u, y - v) - radius, z).max(), radius


def true_curves(path):
    """Id, kind, size, samples and their numbers of views of each true line and circle."""
    rows = np.loadtxt(path)
    for curve_id in np.unique(rows[:, 6]):
        own = rows[rows[:, 6] == curve_id]
        points = own[:, :3]
        views = own[:, 7] if own.shape[1] > 7 else np.full(len(own), ENOUGH_VIEWS)
        if len(points) < 4:
            continue
        error, length = line_of(points)
        if error < TRUE_TO * length:
            yield int(curve_id), 'line', length, points, views
            continue
        error, radius = circle_of(points)
        if error < TRUE_TO * radius and radius < 100 * length:
            yield int(curve_id), 'circle', radius, points, views


def fits_of(path):
    """The fits, and the position and fit of each sample."""
    fits, positions, owner = [], [], []
    with open(path) as file:
        document = json.load(file)
    for curve in document['curves']:
        samples = np.array([sample['position'] for sample in curve['samples']])
        for fit in curve['fits']:
            chosen = (fit['first_sample'] + np.arange(fit['num_samples'])) % len(samples)
            positions.append(samples[chosen])
            owner += [len(fits)] * len(chosen)
            fits.append(fit)
    return fits, np.vstack(positions), np.array(owner)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('files', nargs='+')
    parser.add_argument('--distance', type=float, default=0.005)
    parser.add_argument('--missed', action='store_true')
    arguments = parser.parse_args()
    counts = collections.defaultdict(collections.Counter)
    radius_errors, length_errors, normalised = [], [], []
    for curves, truth in zip(arguments.files[::2], arguments.files[1::2]):
        fits, positions, owner = fits_of(curves)
        tree = cKDTree(positions)
        for curve_id, kind, size, points, views in true_curves(truth):
            distance, nearest = tree.query(points)
            found = distance < arguments.distance
            near = owner[nearest[found]]
            same = [fits[i]['kind'] in (['line'] if kind == 'line' else ['arc', 'circle']) for i in near]
            counts[kind]['true'] += 1
            counts[kind]['visible'] += (views >= ENOUGH_VIEWS).mean() >= 0.5
            counts[kind]['reconstructed'] += found.mean() >= 0.5
            if found.mean() < 0.5 or np.mean(same) <= 0.5:
                if arguments.missed:
                    kinds = ', '.join(sorted({fits[i]['kind'] for i in near})) or 'none'
                    print(f'{truth}: curve {curve_id}, {kind} of {size:.4g}, median {np.median(views):.0f} views, '
                          f'{100 * found.mean():.0f} % reconstructed, fits: {kinds}')
                continue
            counts[kind]['recognised'] += 1
            fit = fits[np.bincount(near).argmax()]
            if kind == 'circle' and 'radius' in fit:
                radius_errors.append(abs(fit['radius'] - size))
                normalised.append(radius_errors[-1] / fit['radius_sigma'])
            if kind == 'line' and fit['kind'] == 'line' and found.mean() > 0.95:
                length_errors.append(abs(fit['length'] - size))
    for kind, count in sorted(counts.items()):
        share = 100 * count['recognised'] / max(count['reconstructed'], 1)
        print(f"{kind}: {count['true']} true, {count['visible']} visible, {count['reconstructed']} reconstructed, "
              f"{count['recognised']} recognised ({share:.1f} % of the reconstructed)")
    for name, errors in (('radius', radius_errors), ('radius / radius_sigma', normalised), ('length', length_errors)):
        if errors:
            print(f'{name} error: median {np.median(errors):.6f}, 68 % below {np.percentile(errors, 68):.6f}, '
                  f'90 % below {np.percentile(errors, 90):.6f}')


if __name__ == '__main__':
    main()
