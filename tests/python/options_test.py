# SPDX-License-Identifier: BSD-3-Clause
"""The options are those of the program."""
import re
import unittest

import numpy as np

import pycurvix
from workspace import SOURCE, run_program


class Options(unittest.TestCase):

    def test_all_that_are_documented_are_there(self):
        items = re.findall(r'^- `--([\w.]+)`(?: \((.*?)\))?: (.*)$',
                           (SOURCE / 'docs' / 'options.md').read_text(encoding='utf8'), re.M)
        self.assertGreater(len(items), 60)
        listed = run_program('reconstruct', '--help_all')
        options = pycurvix.Options()
        for name, default, meaning in items:
            about = options.about(name)
            self.assertEqual(about.name, name)
            of_option = re.search(rf'^  --{re.escape(name)} .*?(?=^  --|^\S|\Z)', listed, re.M | re.S)[0]
            self.assertIn(' '.join(about.range.split()), ' '.join(of_option.split()))
            self.assertIn(about.help, meaning)
            value = options[name]
            self.assertEqual(about.default, value)
            text = default.split(';')[0].removesuffix(about.unit).strip() if about.unit else default.split(';')[0]
            if isinstance(value, bool):
                self.assertEqual(text, '1' if value else '0')
            elif isinstance(value, (int, float)):
                self.assertEqual(float(text), value)
            elif text and not text.startswith('paper'):
                self.assertEqual(text, value)

    def test_names_are_those_of_the_help_but_paths_and_logging(self):
        listed = re.findall(r'^  --([\w.]+)', run_program('reconstruct', '--help_all'), re.M)
        others = {'workspace_path', 'input_path', 'image_path', 'output_path', 'mask_path', 'part', 'project_path',
                  'log_to_stderr', 'log_level'}
        self.assertEqual(set(pycurvix.Options()), set(listed) - others)
        self.assertEqual(len(pycurvix.Options()), len(listed) - len(others))

    def test_values_have_types(self):
        options = pycurvix.Options()
        self.assertIs(options['EdgeDetection.separate_edges'], True)
        self.assertIsInstance(options['CurveFilter.min_num_views'], int)
        self.assertIsInstance(options['EdgeDetection.sigma_px'], float)
        self.assertEqual(options['Hypotheses.view_selection'], 'every_view')
        for name, value, expected in (('EdgeDetection.separate_edges', False, False),
                                      ('EdgeDetection.separate_edges', np.bool_(True), True),
                                      ('CurveFilter.min_num_views', np.int32(7), 7),
                                      ('EdgeDetection.sigma_px', np.float32(1.5), 1.5),
                                      ('EdgeDetection.sigma_px', 2, 2.0),
                                      ('EdgeDetection.sigma_px', '1.25', 1.25),
                                      ('Hypotheses.view_selection', 'unused_edges', 'unused_edges'),
                                      ('CurveFilter.kinds', ['boundary', 'crease'], 'crease,boundary'),
                                      ('output_formats', ['ply', 'dxf'], 'ply,dxf')):
            options[name] = value
            self.assertEqual(options[name], expected, name)

    def test_every_value_can_be_set_to_itself(self):
        options = pycurvix.Options(preset='paper')
        for again in pycurvix.Options(options), pycurvix.Options(dict(options.items())):
            self.assertEqual(again, options)
            self.assertNotEqual(again, pycurvix.Options())

    def test_a_preset_keeps_what_is_given(self):
        given = {'Consolidation.max_turn_deg': 3, 'CurveFilter.kinds': 'crease'}
        paper = pycurvix.Options({**given, 'preset': 'paper'})
        self.assertEqual(paper['Consolidation.max_turn_deg'], 3)
        self.assertEqual(paper['Hypotheses.view_selection'],
                         pycurvix.Options(preset='paper')['Hypotheses.view_selection'])
        options = pycurvix.Options(given)
        for copy in options, pycurvix.Options(options):
            copy['preset'] = 'paper'
            self.assertEqual(copy, paper)
        options['preset'] = 'default'
        self.assertEqual(options, pycurvix.Options(given))

    def test_repr_shows_what_differs_and_can_be_read_back(self):
        self.assertEqual(repr(pycurvix.Options()), 'Options()')
        options = pycurvix.Options({'CurveFilter.min_num_views': 6}, preset='paper')
        self.assertEqual(repr(options), "Options({'preset': 'paper', 'CurveFilter.min_num_views': 6})")
        self.assertEqual(eval(repr(options), {'Options': pycurvix.Options}), options)  # pylint: disable=eval-used

    def test_errors_name_option_value_and_range(self):
        with self.assertRaisesRegex(pycurvix.ArgumentError, "did you mean 'CurveFilter.min_num_views'"):
            pycurvix.Options({'min_num_view': 3})
        with self.assertRaisesRegex(ValueError, 'EdgeDetection.sigma_px is 0.0; it must be >= 0.3 and <= 10'):
            pycurvix.Options({'EdgeDetection.sigma_px': 0.0})
        with self.assertRaisesRegex(ValueError, 'ply, obj'):
            pycurvix.Options(output_formats='stl')
        with self.assertRaises(ValueError):
            pycurvix.Options()['no_such_option']
        with self.assertRaisesRegex(ValueError, 'None'):
            pycurvix.Options(num_threads=None)

    def test_nothing_is_set_if_one_cannot_be(self):
        options = pycurvix.Options()
        with self.assertRaises(ValueError):
            options.update({'EdgeDetection.sigma_px': 2, 'num_threads': -7.5})
        self.assertEqual(options, pycurvix.Options())
