#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""From a workspace to a plot, a list of long lines, and files for CAD.

  examples/06_curves_in_python.py proj 0.5 out

reads proj/images and proj/sparse, and writes lines.dxf, lines.csv and
curves.png, with the lines longer than 0.5 (in the unit of the model).
Needs pycurvix, and matplotlib for the picture.
"""
import pathlib
import sys

import numpy as np

import pycurvix

workspace, min_length, output = pathlib.Path(sys.argv[1]), float(sys.argv[2]), pathlib.Path(sys.argv[3])
output.mkdir(parents=True, exist_ok=True)

# 1. The curves: the run of the program, with one option and a line a stage.
seen = set()


def progress(stage, done, total):
    if stage not in seen:
        seen.add(stage)
        print(stage, file=sys.stderr)


curves = pycurvix.reconstruct(workspace, options={'CurveFilter.min_length_px': 20}, progress=progress)
print(curves)
if len(curves) == 0:
    sys.exit('No curves: ' + curves.report['result']['why_empty'])

# 2. Straight lines longer than that: rows of the structured array of all fits.
fits = curves.fits
lines = fits[(fits['kind'] == pycurvix.FitKind.LINE) & (fits['length'] > min_length)]
print(f"{len(lines)} lines are longer than {min_length}; the longest is {lines['length'].max(initial=0):.4g}")

# 3. Files: the curves that have such a line, for CAD, and a table of the lines.
curves.select(np.unique(lines['curve'])).write(output / 'lines.dxf')
np.savetxt(output / 'lines.csv', np.column_stack((lines['start'], lines['end'], lines['length'], lines['sigma'])),
           delimiter=',', header='x1,y1,z1,x2,y2,z2,length,sigma', comments='', fmt='%.6g')

# 4. A picture: all curves in grey, the long lines in colour, in space and as
# the first camera sees the curves.
try:
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot
except ImportError:
    sys.exit('Without matplotlib there is no picture')
figure = pyplot.figure(figsize=(12, 5.5), layout='constrained')
space = figure.add_subplot(1, 2, 1, projection='3d')
for positions, closed in zip(curves, curves.closed):
    shown = np.vstack((positions, positions[:1])) if closed else positions
    space.plot(*shown.T, color='0.7', linewidth=0.8)
for line in lines:
    space.plot(*np.stack((line['start'], line['end'])).T, linewidth=1.6)
space.set_box_aspect(np.ptp(curves.positions, axis=0))
space.set_title(f'{len(curves)} curves; in colour: {len(lines)} lines longer than {min_length}')

scene = curves.scene
image = figure.add_subplot(1, 2, 2)
image.imshow(pyplot.imread(scene.image_paths[0]), cmap='gray')
for stretches in curves.project(0):
    for pixels in stretches:
        image.plot(*(pixels - 0.5).T, linewidth=1)  # matplotlib: the first pixel is at 0
image.set_title(scene.names[0])
image.set_axis_off()
figure.savefig(output / 'curves.png', dpi=100)
print(f'Wrote lines.dxf, lines.csv and curves.png to {output}')
