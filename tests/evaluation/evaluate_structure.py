#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the structure of curves.json with the truth, and fits with and without --CurveFitting.regularize.

  evaluate_structure.py <curves.json> <regularized curves.json> <gt.txt> [...]

A fit stands for the true line or circle that most of its samples are next to, within --distance. Of all pairs of lines
that stand for true ones, it counts those that are truly parallel or perpendicular, to --angle, those found, and those
found that are not true. Angles between true lines are either below a thousandth of a degree, or far above --angle.
Errors are of radii, and of the lengths of lines that are reconstructed to 95 % and within 5 % as long as the true ones:
others end elsewhere.
"""
import argparse
import itertools
import json

import numpy as np
from evaluate_fits import fits_of, true_curves
from scipy.spatial import cKDTree


def structure_of(path):
    """For each kind, the pairs of fits, each (curve, fit), that are said to be parallel or perpendicular."""
    with open(path) as file:
        document = json.load(file)
    groups = [[tuple(fit) for fit in group['fits']] for group in document['structure']['groups']]
    kinds = [group['kind'] for group in document['structure']['groups']]
    parallel, perpendicular = set(), set()
    for fits, kind in zip(groups, kinds):
        if kind == 'parallel':
            parallel |= {frozenset(pair) for pair in itertools.combinations(fits, 2)}
    for pair in document['structure']['perpendicular']:
        first, second = pair['groups']
        perpendicular |= {frozenset(fits) for fits in itertools.product(groups[first], groups[second])}
    keys = [(curve['id'], k) for curve in document['curves'] for k in range(len(curve['fits']))]
    return {'parallel': parallel, 'perpendicular': perpendicular}, keys, {kind: kinds.count(kind) for kind in kinds}


def truths_of(path, fits, positions, owner, distance):
    """(true curve, share of it that is reconstructed) of each fit; None: it stands for none."""
    truth = list(true_curves(path))
    tree = cKDTree(np.vstack([curve[3] for curve in truth]))
    true_owner = np.repeat(np.arange(len(truth)), [len(curve[3]) for curve in truth])
    found = [cKDTree(positions).query(curve[3])[0] < distance for curve in truth]
    result = []
    for i in range(len(fits)):
        distances, nearest = tree.query(positions[owner == i])
        near = true_owner[nearest[distances < distance]]
        most = np.bincount(near).argmax() if 2 * len(near) > len(distances) else None
        result.append(None if most is None else (truth[most], found[most].mean()))
    return result


def true_relation(first, second, angle):
    a, b = [curve[3][-1] - curve[3][0] for curve in (first, second)]
    degrees = np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), abs(a @ b)))
    return 'parallel' if degrees < angle else 'perpendicular' if degrees > 90 - angle else None


def count_pairs(path, fits, truths, angle):
    found, keys, groups = structure_of(path)
    lines = [i for i, fit in enumerate(fits) if fit['kind'] == 'line' and truths[i] and truths[i][0][1] == 'line']
    counts = {kind: np.zeros(3, int) for kind in found}  # true, of these found, found but not true
    for i, j in itertools.combinations(lines, 2):
        truth = true_relation(truths[i][0], truths[j][0], angle)
        for kind, pairs in found.items():
            is_found = frozenset((keys[i], keys[j])) in pairs
            counts[kind] += [truth == kind, truth == kind and is_found, truth != kind and is_found]
    return counts, groups


def errors_of(fits, moved, truths):
    """Errors before and after, and the standard deviation before, of lengths and radii."""
    errors = {'length': [], 'radius': []}
    for before, after, truth in zip(fits, moved, truths):
        if not truth:
            continue
        (_, kind, size, _, _), share = truth
        if kind == 'line' and before['kind'] == 'line' and share > 0.95 and abs(before['length'] - size) < 0.05 * size:
            errors['length'].append((before['length'] - size, after['length'] - size))
        if kind == 'circle' and 'radius' in before:
            errors['radius'].append((before['radius'] - size, after['radius'] - size, before['radius_sigma']))
    return errors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('files', nargs='+')
    parser.add_argument('--distance', type=float, default=0.005)
    parser.add_argument('--angle', type=float, default=0.05, help='degrees')
    arguments = parser.parse_args()
    total = {'parallel': np.zeros(3, int), 'perpendicular': np.zeros(3, int)}
    all_errors = {'length': [], 'radius': []}
    for plain, regularized, truth in zip(*[iter(arguments.files)] * 3):
        fits, positions, owner = fits_of(plain)
        moved = fits_of(regularized)[0]
        truths = truths_of(truth, fits, positions, owner, arguments.distance)
        counts, groups = count_pairs(plain, fits, truths, arguments.angle)
        errors = errors_of(fits, moved, truths)
        print(truth, dict(sorted(groups.items())))
        for kind in total:
            total[kind] += counts[kind]
            print('  {}: {} true, {} found, {} false'.format(kind, *counts[kind]))
        for name, values in errors.items():
            all_errors[name] += values
            report(f'  {name}', values)
    for kind, (true, found, false) in total.items():
        print(f'{kind}: {100 * found / max(true, 1):.1f} % of {true} true pairs found, '
              f'{100 * false / max(found + false, 1):.2f} % of those found are false')
    for name, values in all_errors.items():
        report(name, values)


def report(name, values):
    if not values:
        return
    errors = np.abs([value[:2] for value in values])
    line = ', '.join(f'{what} {np.percentile(errors[:, 0], p):.6f} -> {np.percentile(errors[:, 1], p):.6f}'
                     for what, p in (('median', 50), ('90 %', 90)))
    changed = errors[:, 0] != errors[:, 1]
    nearer = (errors[:, 1] < errors[:, 0])[changed]
    print(f'{name} of {len(values)}: {line}, root mean square {np.sqrt((errors[:, 0] ** 2).mean()):.6f} -> '
          f'{np.sqrt((errors[:, 1] ** 2).mean()):.6f}; {nearer.sum()} of {changed.sum()} moved are nearer')
    if len(values[0]) > 2:
        normalised = np.abs([value[0] / value[2] for value in values])
        print(f'{name} / {name.strip()}_sigma: median {np.median(normalised):.2f}, 68 % below '
              f'{np.percentile(normalised, 68):.2f}, 95 % below {np.percentile(normalised, 95):.2f}')


if __name__ == '__main__':
    main()
