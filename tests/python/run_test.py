# SPDX-License-Identifier: BSD-3-Clause
"""pycurvix does what the program does."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np

import pycurvix
from workspace import FORMATS, PROGRAM, WorkspaceTest, contents, run_program


class Reconstruct(WorkspaceTest):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.by_program = cls.shared / 'by_program'
        run_program('--workspace_path', cls.workspace, '--output_path', cls.by_program, '--output_formats',
                    ','.join(FORMATS))
        cls.by_python = cls.shared / 'by_python'
        cls.stages = []
        cls.curves = pycurvix.reconstruct(workspace_path=cls.workspace, output_path=cls.by_python,
                                          options={'output_formats': list(FORMATS)},
                                          progress=lambda *step: cls.stages.append(step))

    def test_writes_the_same_bytes(self):
        for name in [*FORMATS.values(), 'edges.ply']:
            self.assertEqual(contents(self.by_python / name), contents(self.by_program / name), name)

    def test_imports_for_a_run_what_it_needs(self):
        lines = ('import sys', 'before = set(sys.modules)', 'import pycurvix',
                 f'curves = pycurvix.reconstruct({str(self.workspace)!r}, output_path={str(self.folder)!r})',
                 'assert not {"logging", "numpy", "typing"} & (set(sys.modules) - before)',
                 'print(curves.positions.shape[1], curves.fits.dtype["length"])')
        said = subprocess.run([sys.executable, '-c', '\n'.join(lines)], check=True, capture_output=True, text=True)
        self.assertEqual(said.stdout, '3 float64\n')
        # Without logging, as with it where nobody has set it up.
        with_logging = subprocess.run([sys.executable, '-c', '\n'.join(('import logging', *lines))], check=True,
                                      capture_output=True, text=True)
        self.assertIn('Bundle adjustment is left out', said.stderr)
        self.assertEqual(with_logging.stderr, said.stderr)

    def test_tells_the_logger(self):
        with self.assertLogs('pycurvix', 'WARNING') as logs:
            pycurvix.reconstruct(self.workspace, output_path=self.folder)
        self.assertTrue(logs.records[0].getMessage().startswith('Bundle adjustment is left out'))

    def test_curves_write_the_same_bytes_in_every_format(self):
        for name, file in FORMATS.items():
            self.curves.write(self.folder / file, name)
            self.assertEqual(contents(self.folder / file), contents(self.by_program / file), name)

    def test_the_ending_tells_the_format(self):
        pycurvix.write(self.folder / 'a.DXF'.lower(), self.curves)
        self.assertEqual(contents(self.folder / 'a.dxf'), contents(self.by_program / 'curves.dxf'))

    def test_the_report_is_that_of_the_program(self):
        expected = json.loads((self.by_program / 'report.json').read_text())
        self.assertEqual(self.curves.report['result'], expected['result'])
        self.assertEqual(self.curves.report['options'], expected['options'])
        self.assertEqual(self.curves.report['stages'], expected['stages'])
        self.assertEqual(self.curves.report['result']['num_curves'], len(self.curves))

    def test_progress_names_the_stages_in_order(self):
        names = list(dict.fromkeys(stage for stage, _, _ in self.stages))
        ran = [stage['name'] for stage in self.curves.report['stages'] if stage['name'] in names]
        self.assertIn('detect_edges', names)
        self.assertIn('sketch_edges', names)
        self.assertEqual([name for name in names if name in ran], ran)
        for _, done, total in self.stages:
            self.assertLessEqual(done, total)
        self.assertIn(('detect_edges', 12, 12), self.stages)

    def test_options_reach_the_run(self):
        arguments = {'CurveFilter.min_num_views': 6, 'num_threads': 1, 'output_formats': 'ply'}
        run_program('--workspace_path', self.workspace, '--output_path', self.folder / 'a',
                    *(text for name, value in arguments.items() for text in (f'--{name}', value)))
        curves = pycurvix.reconstruct(self.workspace, output_path=self.folder / 'b',
                                      options=pycurvix.Options(arguments))
        self.assertEqual(curves.report['options']['CurveFilter']['min_num_views'], 6)
        self.assertEqual(contents(self.folder / 'b' / 'curves.ply'), contents(self.folder / 'a' / 'curves.ply'))
        self.assertFalse((self.folder / 'b' / 'curves.obj').exists())

    def test_curves_are_in_the_frame_of_align(self):
        output = self.folder / 'out'
        before = pycurvix.reconstruct(self.workspace, output_path=output)
        run_program('align', '--workspace_path', self.workspace, '--output_path', output,
                    '--distance', '0,0,0', '1,0,0', 60)
        aligned = pycurvix.reconstruct(self.workspace, output_path=output)
        np.testing.assert_allclose(aligned.positions, 60 * before.positions, rtol=1e-9)
        aligned.write(self.folder / 'a.ply')
        self.assertEqual(contents(self.folder / 'a.ply'), contents(output / 'curves.ply'))

    def test_no_curves_say_why(self):
        curves = pycurvix.reconstruct(self.workspace, output_path=self.folder / 'none',
                                      options={'CurveFilter.min_num_views': 1000})
        self.assertEqual(len(curves), 0)
        self.assertEqual(curves.positions.shape, (0, 3))
        self.assertEqual(len(curves.fits), 0)
        self.assertIn('CurveFilter', curves.report['result']['why_empty'])
        self.assertIn('none', repr(curves))

    def test_a_scene_gives_what_its_workspace_gives(self):
        run_program('--workspace_path', self.workspace, '--output_path', self.folder / 'out', '--refiner', 'none',
                    '--output_formats', 'ply,json')
        scene = pycurvix.Scene.from_colmap(self.workspace)
        curves = pycurvix.reconstruct(scene=scene)
        for name in ('curves.ply', 'curves.json'):
            curves.write(self.folder / name)
            self.assertEqual(contents(self.folder / name), contents(self.folder / 'out' / name), name)
        expected = json.loads((self.folder / 'out' / 'report.json').read_text())
        self.assertEqual(curves.report['stages'],
                         [stage for stage in expected['stages'] if stage['name'] not in ('read_model', 'write_files')])
        self.assertEqual(curves.report['result']['edge_sigma_px'], expected['result']['edge_sigma_px'])

    def test_evaluate_gives_what_the_program_prints(self):
        truth = self.workspace / 'gt.txt'
        expected = json.loads(run_program('evaluate', '--curves_path', self.by_program / 'curves.ply', '--truth_path',
                                          truth, '--json', 1))
        self.assertEqual(pycurvix.evaluate(self.by_program / 'curves.ply', truth), expected)
        self.assertGreater(pycurvix.evaluate(self.curves, truth)['F5'], 50)

    def test_evaluate_holdout_gives_what_the_program_prints(self):
        expected = json.loads(run_program('evaluate', '--workspace_path', self.workspace, '--holdout_every', 4,
                                          '--json', 1))
        self.assertEqual(pycurvix.evaluate_holdout(self.workspace, 4), expected)
        with self.assertRaisesRegex(pycurvix.ArgumentError, 'holdout_every is 8.5'):
            pycurvix.evaluate_holdout(self.workspace, 8.5)


class Stopping(WorkspaceTest):
    solid = 'part'

    def reconstruct(self, **arguments):
        return pycurvix.reconstruct(self.workspace, output_path=self.folder / 'out', **arguments)

    def assert_nothing_was_written(self):
        self.assertFalse((self.folder / 'out' / 'curves.ply').exists())
        self.assertFalse((self.folder / 'out' / 'report.json').exists())

    def test_false_stops_the_run(self):
        with self.assertRaisesRegex(pycurvix.CancelledError, 'Interrupted'):
            self.reconstruct(progress=lambda stage, done, total: np.bool_(stage != 'sketch_edges'))
        self.assert_nothing_was_written()

    def test_none_and_true_do_not(self):
        curves = self.reconstruct(progress=lambda stage, done, total: None if done % 2 else True)
        self.assertGreater(len(curves), 0)

    def test_what_the_function_raises_stops_the_run_and_comes_out(self):
        def progress(stage, done, total):
            if stage == 'sketch_edges':
                raise KeyError('mine')
        with self.assertRaisesRegex(KeyError, 'mine'):
            self.reconstruct(progress=progress)
        self.assert_nothing_was_written()

    def test_a_signal_stops_the_run(self):
        # Sent when the first stage has ended, by a thread that runs meanwhile.
        def interrupt():
            while not (self.folder / 'out' / 'stages').exists():
                time.sleep(0.001)
            os.kill(os.getpid(), signal.SIGINT)
        thread = threading.Thread(target=interrupt)
        thread.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                self.reconstruct()
                time.sleep(1)  # nothing is raised later
        finally:
            thread.join()
        self.assert_nothing_was_written()

    def test_other_threads_run(self):
        ticks, ended = [], threading.Event()

        def tick():
            while not ended.wait(0.001):
                ticks.append(time.monotonic())
        thread = threading.Thread(target=tick)
        thread.start()
        calls = []
        self.reconstruct(progress=lambda *step: calls.append(time.monotonic()))
        ended.set()
        thread.join()
        # In the longest time without a call, the lock was free.
        longest = int(np.argmax(np.diff(calls)))
        during = [t for t in ticks if calls[longest] < t < calls[longest + 1]]
        self.assertGreater(len(during), 3)


class Failures(WorkspaceTest):

    def assert_as_the_program(self, error, *arguments):
        said = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False).stderr
        self.assertIn('ERROR: ' + str(error).rstrip('.'), said)

    def test_a_workspace_that_is_not_there(self):
        missing = self.folder / 'nowhere'
        with self.assertRaises(pycurvix.NotFoundError) as caught:
            pycurvix.reconstruct(missing)
        self.assertIsInstance(caught.exception, FileNotFoundError)
        self.assertIsInstance(caught.exception, pycurvix.Error)
        self.assert_as_the_program(caught.exception, '--workspace_path', missing)

    def test_a_broken_model(self):
        broken = self.folder / 'proj'
        (broken / 'sparse' / '0').mkdir(parents=True)
        (broken / 'images').symlink_to(self.workspace / 'images')
        for file in (self.workspace / 'sparse' / '0').iterdir():
            data = file.read_bytes()
            (broken / 'sparse' / '0' / file.name).write_bytes(data[:len(data) // 2])
        with self.assertRaises(pycurvix.DataError) as caught:
            pycurvix.reconstruct(broken)
        self.assertIsInstance(caught.exception, OSError)
        self.assert_as_the_program(caught.exception, '--workspace_path', broken)

    def test_results_among_the_inputs(self):
        with self.assertRaises(pycurvix.ArgumentError) as caught:
            pycurvix.reconstruct(self.workspace, output_path=self.workspace / 'images')
        self.assertIsInstance(caught.exception, ValueError)
        self.assertIn('among the inputs', str(caught.exception))

    def test_a_name_that_is_no_utf8(self):
        with self.assertRaisesRegex(pycurvix.NotFoundError, r'\\xff'):
            pycurvix.read(os.fsdecode(b'/nowhere/\xff.ply'))

    def test_files_of_curves(self):
        with self.assertRaises(pycurvix.NotFoundError):
            pycurvix.read(self.folder / 'none.ply')
        with self.assertRaises(pycurvix.ArgumentError):
            pycurvix.read(next((self.workspace / 'images').iterdir()))
        (self.folder / 'short.ply').write_text('ply\nformat ascii 1.0\n')
        with self.assertRaises(pycurvix.DataError):
            pycurvix.read(self.folder / 'short.ply')
        (self.folder / 'a.obj').write_text('v 0 0 0\nv 1 0 0\nl 1 2\n')
        curves = pycurvix.read(self.folder / 'a.obj')
        for name in ('a.json', 'a.html', 'a.svg'):
            with self.assertRaisesRegex(pycurvix.ArgumentError, 'views'):
                curves.write(self.folder / name)
        with self.assertRaisesRegex(pycurvix.ArgumentError, 'ply, obj'):
            curves.write(self.folder / 'a.stl')
        with self.assertRaisesRegex(pycurvix.ArgumentError, 'ends in .ply'):
            curves.write(self.folder / 'again.obj', 'ply')
        (self.folder / 'folder.ply' / 'inside').mkdir(parents=True)
        for path in (self.folder / 'no' / 'such' / 'folder' / 'a.ply', self.folder / 'folder.ply'):
            with self.assertRaises(OSError) as caught:
                curves.write(path)
            self.assertIsInstance(caught.exception, pycurvix.Error)
        with self.assertRaises(OSError):
            pycurvix.reconstruct(self.workspace, output_path=self.folder / 'a.obj' / 'out')

    def test_arguments(self):
        with self.assertRaisesRegex(pycurvix.ArgumentError, 'either'):
            pycurvix.reconstruct()
        with self.assertRaises(TypeError):
            pycurvix.reconstruct(self.workspace, no_such_argument=1)
        with self.assertRaisesRegex(pycurvix.ArgumentError, 'must be'):
            pycurvix.reconstruct(self.workspace, options={'CurveFilter.min_num_views': -1})
        with self.assertRaisesRegex(TypeError, 'Scene, not int'):
            pycurvix.reconstruct(scene=42)
        scene = pycurvix.Scene.from_colmap(self.workspace)
        with self.assertRaisesRegex(pycurvix.ArgumentError, 'paths'):
            pycurvix.reconstruct(scene=scene, output_path=self.folder)


del WorkspaceTest  # has no cases of its own
