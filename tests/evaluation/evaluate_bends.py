#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds curves that are bent only in depth, where images hardly determine them.

  evaluate_bends.py <curves.json> [<curves.json> ...]

Curves are cut into segments of 30 px. A segment is bent if the root mean square
distance of its samples from their line is above 1/30 of its length, and
straight if it is below 1/60. Printed: of the segments that are straight in
nine of ten supporting images, the share that is bent in space, %.
"""
import argparse
import json

import numpy as np

SEGMENT_PX = 30
MIN_SHARE_OF_SAMPLES = 0.7  # of an image that supports a segment
MIN_IMAGES = 2
SHARE_OF_IMAGES = 0.9


def bend(points):
    """The distance of points from their line, as a share of their length."""
    points = np.array(points)
    _, singular, axes = np.linalg.svd(points - points.mean(0), full_matrices=False)
    along = points @ axes[0]
    return singular[1] / np.sqrt(len(points)) / max(np.ptp(along), 1e-300)


def observations_of(sample):
    return {o[0]: np.array(o[1:3]) for o in sample['support']}


def segments_of(samples):
    """Runs of samples that are SEGMENT_PX long, in the median over images."""
    observations = [observations_of(sample) for sample in samples]
    begin, length = 0, 0
    for i in range(1, len(samples)):
        before, here = observations[i - 1:i + 1]
        steps = [np.linalg.norm(here[k] - before[k]) for k in here if k in before]
        length += np.median(steps) if steps else 0
        if length >= SEGMENT_PX:
            yield samples[begin:i + 1], observations[begin:i + 1]
            begin, length = i, 0


def is_straight_in_images(observations):
    images = {image for o in observations for image in o}
    tracks = [[o[image] for o in observations if image in o] for image in images]
    tracks = [t for t in tracks if len(t) >= max(3, MIN_SHARE_OF_SAMPLES * len(observations))]
    if len(tracks) < MIN_IMAGES:
        return False
    return np.quantile([bend(track) for track in tracks], SHARE_OF_IMAGES) < 0.5 / SEGMENT_PX


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('files', nargs='+', help='curves.json')
    for name in parser.parse_args().files:
        with open(name) as file:
            curves = json.load(file)['curves']
        num_straight = num_bent = 0
        for curve in curves:
            for samples, observations in segments_of(curve['samples']):
                if is_straight_in_images(observations):
                    num_straight += 1
                    num_bent += bend([s['position'] for s in samples]) > 1 / SEGMENT_PX
        print(f'{name}: {100 * num_bent / max(num_straight, 1):.1f} % of {num_straight} segments')


if __name__ == '__main__':
    main()
