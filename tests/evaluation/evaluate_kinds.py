#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tells how often curves of painted scenes are said to be what they are.

usage: evaluate_kinds.py [--program build/bin/colmap_curvix]
                         [--scenes house,table,...] [--views 50,25,12]
                         [--pose_error_px 0.3] [--folder FOLDER] [-- OPTIONS]

Renders scenes with `synthesize` (800 x 800 pixels, noise of 2 grey levels,
poses disturbed), refines the poses with the curves, and prints a table: of the
length within 5 mm of true curves, how much is said to be of the right kind, in
all and by true kind; how much of the creases and boundaries is said to be one
of the two, as --CurveFilter.kinds crease,boundary keeps it; and how much of
the markings is. The last rows are sums over all scenes, by number of views.
--folder keeps the scenes and takes those that are there already. What follows
-- is given to the reconstruction.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

SCENES = {
    'brick_block': ['--solid', 'block', '--pattern', 'brick'],
    'wood_part': ['--solid', 'part', '--pattern', 'wood', '--shadows', '1'],
    'print_cylinder': ['--solid', 'cylinder', '--pattern', 'print'],
    'house': ['--solid', 'house', '--pattern', 'mixed', '--shadows', '1'],
    'table': ['--solid', 'table', '--pattern', 'mixed', '--shadows', '1'],
    'shiny_table': ['--solid', 'table', '--pattern', 'mixed',
                    '--reflections', '1'],
    'knobs': ['--solid', 'knobs', '--pattern', 'mixed', '--shadows', '1'],
    'room': ['--solid', 'room', '--pattern', 'mixed', '--shadows', '1']}
KINDS = ['crease', 'boundary', 'marking']
SHARP = ['crease', 'boundary']


def make_scene(program, folder, name, num_views, pose_error):
    scene = folder / f'{name}_{num_views}'
    if not (scene / 'gt.txt').exists():
        subprocess.run(
            [program, 'synthesize', '--workspace_path', scene,
             '--num_views', str(num_views), '--width', '800',
             '--height', '800', '--noise', '2', '--points_per_view', '60',
             '--pose_error_px', str(pose_error), *SCENES[name]],
            check=True, stdout=subprocess.DEVNULL)
    return scene


def said_lengths(program, scene, options):
    """{true kind: {kind said: mm}}."""
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / 'curvix'
        subprocess.run(
            [program, '--workspace_path', scene, '--output_path', output,
             '--refine_poses_with_curves', '1', *options],
            check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        kinds = json.loads(subprocess.check_output(
            [program, 'evaluate', '--json', '--curves_path',
             output / 'curves.ply', '--truth_path', scene / 'gt.txt']))['kinds']
    return {kind: kinds[kind]['said'] for kind in KINDS if kind in kinds}


def percent(part, whole):
    return f'{100 * part / whole:.1f}' if whole > 0 else '–'


def cells(said):
    """The columns of the table after the first two."""
    def length(true_kinds, said_kinds=None):
        return sum(mm for true in true_kinds for kind, mm
                   in said.get(true, {}).items()
                   if said_kinds is None or kind in said_kinds)
    right = [length([kind], [kind]) for kind in KINDS]
    near = [length([kind]) for kind in KINDS]
    return [percent(sum(right), sum(near)),
            *[percent(*pair) for pair in zip(right, near)],
            percent(length(SHARP, SHARP), length(SHARP)),
            percent(length(['marking'], SHARP), length(['marking']))]


def add(total, said):
    for true, lengths in said.items():
        for kind, mm in lengths.items():
            row = total.setdefault(true, {})
            row[kind] = row.get(kind, 0) + mm


def run(arguments, options, folder):
    print('| scene | views | right | crease | boundary | marking | '
          'creases and boundaries kept | markings let through |')
    print('|---' * 8 + '|')
    totals = {views: {} for views in arguments.views.split(',')}
    for name in arguments.scenes.split(','):
        for views, total in totals.items():
            scene = make_scene(arguments.program, folder, name, views,
                               arguments.pose_error_px)
            said = said_lengths(arguments.program, scene, options)
            add(total, said)
            print('|', ' | '.join([name, views, *cells(said)]), '|',
                  flush=True)
    for views, total in totals.items():
        print('|', ' | '.join(['**all**', views, *cells(total)]), '|')


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('--program', type=pathlib.Path,
                        default=ROOT / 'build/bin/colmap_curvix')
    parser.add_argument('--scenes', default=','.join(SCENES))
    parser.add_argument('--views', default='50,25,12')
    parser.add_argument('--pose_error_px', type=float, default=0.3)
    parser.add_argument('--folder', type=pathlib.Path)
    own = sys.argv[1:]
    options = []
    if '--' in own:
        options = own[own.index('--') + 1:]
        own = own[:own.index('--')]
    arguments = parser.parse_args(own)
    if arguments.folder:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        run(arguments, options, arguments.folder)
        return
    with tempfile.TemporaryDirectory() as folder:
        run(arguments, options, pathlib.Path(folder))


if __name__ == '__main__':
    main()
