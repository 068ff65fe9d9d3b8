#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs colmap_curvix on scenes with known curves and prints the tables of
docs/evaluation.md.

usage: run_evaluation.py [--program build/bin/colmap_curvix] [--data FOLDER]
                         [--tables A,B,C,D] [--scenes WORD,...] [--write FILE]

A  the default and --preset paper, scene by scene
B  one departure from the paper at a time taken back
C  scenes without known curves: time, and the curves of a part of the
   photographs compared with those held out; the same of Line3D++ where
   FOLDER/peers/line3dpp/<scene>.obj is
D  the default on harder copies of scenes with known curves

A scene is a folder below FOLDER ($CURVIX_DATA, else ../shared/data beside the
source tree) that holds sparse/ and images/, and gt.txt where the curves are
known. --scenes keeps those whose path contains a WORD. --write puts the tables
into FILE, between '<!-- table A -->' and '<!-- end of table A -->' and so on.
Needs Python 3.9; table D also what degrade_scene.py needs. Data is only read.
"""
import argparse
import datetime
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNIT_MM = '1000'  # one world unit of the scenes with known curves

SCORES = [  # key of `evaluate --json`, heading, decimals
    ('Fv5', 'Fv5', 1), ('P5', 'P5', 1), ('whole', 'recall', 0)]
LIFTS = ['precision_lift', 'strong_lift', 'lines_lift']

UNDO = [  # what is taken back (docs/paper_map.md, departures), flags
    ('nothing', []),
    ('every view, tracked support, log-likelihood',
     ['--Hypotheses.view_selection', 'unused_edges']),
    ('log-likelihood of an edge', ['--Validation.min_log_likelihood_ratio', '0']),
    ('no alignment', ['--Alignment.num_iterations', '1000']),
    ('thinning', ['--Connectivity.sample_spacing_px', '0']),
    ('duplicates dropped', ['--Connectivity.max_duplicate_distance_px', '0']),
    ('joins', ['--Connectivity.max_gap_px', '0']),
    ('corner splits', ['--Connectivity.max_corner_deg', '180']),
    ('selection of curves', ['--CurveRefinement.max_dilution', '0']),
    ('smoothing', ['--CurveRefinement.smoothing_px', '0']),
    ('gaps in bends', ['--CurveRefinement.max_gap_px', '0']),
    ('junctions', ['--CurveRefinement.junction_reach_px', '0']),
    ('touching curves', ['--CurveRefinement.separate_touching', '0']),
    ('corners of fitted curves',
     ['--CurveRefinement.max_corner_deg', '180']),
    ('response curve', ['--CurveRefinement.undo_response_curve', '0']),
    ('parallel edges separated', ['--EdgeDetection.separate_edges', '0']),
    ('all refinement', ['--CurveRefinement.enabled', '0']),
    ('exclusive support',
     ['--Validation.min_num_exclusive_views', '0'])]

HARDER = [  # what is worse, script and its arguments
    ('nothing', None, []),
    ('25 views', 'degrade_scene.py', ['--views', '25']),
    ('12 views', 'degrade_scene.py', ['--views', '12']),
    ('noise of 4 grey levels', 'degrade_scene.py', ['--noise', '4']),
    ('half resolution', 'degrade_scene.py', ['--half']),
    ('poses off by 0.5 px', 'disturb_poses.py', ['0.5'])]


def find_scenes(data, words):
    """[(name, folder)]: workspaces below `data`, in order."""
    scenes = []
    for sparse in sorted(data.rglob('sparse')):
        name = str(sparse.parent.relative_to(data))
        if (sparse.parent / 'images').is_dir() and (
                not words or any(word in name for word in words)):
            scenes.append((name, sparse.parent))
    return scenes


def run_program(program, scene, output, flags):
    """Exit code and CPU seconds."""
    with open(output.parent / 'log.txt', 'w') as log:
        process = subprocess.Popen(
            [program, '--workspace_path', scene, '--output_path', output, '--clean', *flags],
            stdout=log, stderr=log)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime


def evaluate(program, scene, flags):
    """The scores of one run; {} where the program fails."""
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / 'curvix'
        code, cpu = run_program(program, scene, output, flags)
        print(f'  {scene.name} {" ".join(flags)}: exit code {code}, '
              f'{cpu:.0f} s', file=sys.stderr, flush=True)
        scores = {'cpu': cpu}
        if code != 0:
            return scores
        scores['report'] = json.loads((output / 'report.json').read_text())
        if (scene / 'gt.txt').exists():
            scores.update(json.loads(subprocess.check_output(
                [program, 'evaluate', '--json', '--unit_mm', UNIT_MM,
                 '--curves_path', output / 'curves.ply',
                 '--truth_path', scene / 'gt.txt'])))
        return scores


def cell(value, decimals):
    return '–' if value is None else f'{value:.{decimals}f}'


def score_cells(scores):
    return [cell(scores.get(key), decimals) for key, _, decimals in SCORES]


def score_headings():
    return [heading for _, heading, _ in SCORES]


def table(headings, rows):
    lines = ['| ' + ' | '.join(line) + ' |' for line in [headings, *rows]]
    lines.insert(1, '|' + '---|' * len(headings))
    return '\n'.join(lines)


def mean(all_scores):
    """Means of each score over those runs that have it."""
    result = {}
    for key in ['cpu'] + [score[0] for score in SCORES]:
        values = [s[key] for s in all_scores if s.get(key) is not None]
        result[key] = sum(values) / len(values) if values else None
    return result


def table_a(program, scenes):
    presets = [[], ['--preset', 'paper']]
    results = [[evaluate(program, scene, flags) for flags in presets]
               for _, scene in scenes]
    names = [scene.name for _, scene in scenes] + ['**mean**']
    results.append([mean(column) for column in zip(*results)])
    rows = [[name, *score_cells(default),
             cell(default['cpu'], 0), cell(paper.get('Fv5'), 1),
             cell(paper['cpu'], 0)]
            for name, (default, paper) in zip(names, results)]
    return table(['scene', *score_headings(), 'CPU s', 'paper: Fv5', 'CPU s'],
                 rows)


def comparison(headings, cases, scenes, run):
    """One row for each case: means over the scenes.

    A case is what its row begins with, and arguments of `run`, which takes a
    scene before them and returns its scores.
    """
    rows = [[*begin, *score_cells(mean([run(scene, *arguments)
                                        for _, scene in scenes]))]
            for begin, arguments in cases]
    return table([*headings, *score_headings()], rows)


def table_b(program, scenes):
    return comparison(
        ['taken back'],
        [((what,), (flags,)) for what, flags in UNDO],
        scenes, lambda scene, flags: evaluate(program, scene, flags))


def holdout_every(num_views):
    """Every fourth photograph is held out, of many every sixth or eighth."""
    return '4' if num_views < 16 else '6' if num_views < 32 else '8'


def evaluate_holdout(program, scene, num_views, flags):
    """Lifts of curves in photographs held out, in percent."""
    run = subprocess.run(
        [program, 'evaluate', '--json', '--workspace_path', scene,
         '--holdout_every', holdout_every(num_views), *flags],
        capture_output=True, text=True)
    scores = json.loads(run.stdout) if run.returncode == 0 else {}
    return [cell(scores.get(key), 0) for key in LIFTS]


def table_c(program, scenes, peers):
    rows = []
    for _, scene in scenes:
        scores = evaluate(program, scene, [])
        if 'report' not in scores:
            rows.append([scene.name] + ['–'] * 7)
            continue
        num_views = scores['report']['input']['num_views']
        lines = peers / 'line3dpp' / f'{scene.name}.obj'
        peer = (evaluate_holdout(program, scene, num_views,
                                 ['--curves_path', lines])
                if lines.exists() else ['–'])
        rows.append([scene.name, str(num_views),
                     str(scores['report']['result']['num_curves']),
                     cell(scores['cpu'], 0),
                     *evaluate_holdout(program, scene, num_views, []),
                     ' / '.join(peer)])
    return table(['scene', 'images', 'curves', 'CPU s', 'precision', 'strong',
                  'lines', 'Line3D++'], rows)


def evaluate_harder(program, scene, script, flags):
    """The scores of the default on a harder copy of a scene."""
    if script is None:
        return evaluate(program, scene, [])
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / scene.name
        subprocess.run([sys.executable, ROOT / 'tests/evaluation' / script,
                        scene, copy, *flags], check=True)
        if not (copy / 'gt.txt').exists():
            shutil.copy(scene / 'gt.txt', copy)
        return evaluate(program, copy, [])


def table_d(program, scenes):
    return comparison(
        ['harder by'],
        [((what,), (script, flags)) for what, script, flags in HARDER],
        scenes, lambda *arguments: evaluate_harder(program, *arguments))


def write(path, letter, text):
    begin, end = f'<!-- table {letter} -->', f'<!-- end of table {letter} -->'
    old = path.read_text()
    head, rest = old.split(begin, 1)
    path.write_text(head + begin + '\n' + text + '\n' + end
                    + rest.split(end, 1)[1])


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('--program', type=pathlib.Path,
                        default=ROOT / 'build/bin/colmap_curvix')
    parser.add_argument('--data', type=pathlib.Path, default=os.environ.get(
        'CURVIX_DATA', ROOT.parent / 'shared/data'))
    parser.add_argument('--tables', default='A,B,C,D')
    parser.add_argument('--scenes', default='')
    parser.add_argument('--write', type=pathlib.Path)
    arguments = parser.parse_args()
    scenes = find_scenes(pathlib.Path(arguments.data),
                         [w for w in arguments.scenes.split(',') if w])
    if not scenes:
        raise SystemExit(f'There are no scenes in {arguments.data}')
    known = [s for s in scenes if (s[1] / 'gt.txt').exists()]
    others = [s for s in scenes if s not in known]
    makers = {'A': (table_a, known), 'B': (table_b, known),
              'C': (lambda *a: table_c(*a, arguments.data / 'peers'), others),
              'D': (table_d, known)}
    for letter in arguments.tables.split(','):
        make, its_scenes = makers[letter]
        text = (make(arguments.program, its_scenes)
                + f'\n\nMeasured on {datetime.date.today()}.')
        print(text, flush=True)
        if arguments.write:
            write(arguments.write, letter, text)


if __name__ == '__main__':
    main()
