#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads curves.json and lists what each curve is.

  examples/04_read_curves.py proj/curvix/0/curves.json
"""
import json
import sys

import numpy as np

with open(sys.argv[1]) as file:
    document = json.load(file)
for curve in document['curves']:
    positions = np.array([sample['position'] for sample in curve['samples']])
    images = {support[0] for sample in curve['samples'] for support in sample['support']}
    residuals = [support[3] for sample in curve['samples'] for support in sample['support'] if support[3] is not None]
    size = np.linalg.norm(np.ptp(positions, axis=0))
    error = np.sqrt(np.mean(np.square(residuals))) if residuals else 0
    print(f"curve {curve['id']}: {len(positions)} samples across {size:.4g}, {len(images)} images, residual {error:.2f} px")
    for fit in curve['fits']:
        radius = f", radius {fit['radius']:.4g}" if 'radius' in fit else ''
        print(f"  {fit['kind']}, length {fit['length']:.4g}{radius}, off by {fit['rms_residual']:.2g}")
print(f"{len(document['curves'])} curves, {len(document['nodes'])} junctions")
