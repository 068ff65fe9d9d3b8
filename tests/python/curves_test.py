# SPDX-License-Identifier: BSD-3-Clause
"""Curves are shown to NumPy without copies."""
import ast
import gc
import json
import pathlib

import numpy as np

import pycurvix
from pycurvix import _core
from workspace import WorkspaceTest, contents

VIEWS = ('offsets', 'closed', 'start_junction', 'end_junction', 'junctions', 'positions',
         'tangents', 'covariances', 'sigmas', 'evidence', 'kinds', 'kind_probabilities', 'support_offsets', 'support',
         'views', 'fits', 'fit_offsets', 'spline_points', 'spline_knots', 'nodes',
         'node_covariances')


def resident_bytes():
    return int(pathlib.Path('/proc/self/statm').read_text().split()[1]) * 4096


class Arrays(WorkspaceTest):
    solid = 'part'

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.curves = pycurvix.reconstruct(cls.workspace)
        cls.json = json.loads((cls.workspace / 'curvix' / '0' / 'curves.json').read_text())
        assert len(cls.curves) > 5

    def test_are_views(self):
        for name in VIEWS:
            view, again = getattr(self.curves, name), getattr(self.curves, name)
            self.assertFalse(view.flags.owndata, name)
            self.assertFalse(view.flags.writeable, name)
            self.assertIsNotNone(view.base, name)
            if view.size:
                self.assertTrue(np.shares_memory(view, again), name)
            with self.assertRaises(ValueError, msg=name):
                view.setflags(write=True)

    def test_outlive_their_curves(self):
        curves = self.curves.select(np.arange(len(self.curves)))
        positions, fits = curves.positions, curves.fits
        expected = positions.copy(), fits.copy()
        del curves
        gc.collect()
        np.full(1000000, 7.0)
        np.testing.assert_array_equal(positions, expected[0])
        np.testing.assert_equal(fits.tolist(), expected[1].tolist())

    def test_samples_are_those_of_the_file(self):
        samples = [sample for curve in self.json['curves'] for sample in curve['samples']]
        self.assertEqual(len(samples), len(self.curves.positions))
        np.testing.assert_array_equal(self.curves.positions, [sample['position'] for sample in samples])
        # Seven decimals and nine digits, as the schema says.
        np.testing.assert_allclose(self.curves.tangents, [sample['tangent'] for sample in samples], rtol=0, atol=1e-7)
        np.testing.assert_allclose(self.curves.sigmas, [sample['sigma'] for sample in samples], rtol=1e-8)
        triangle = self.curves.covariances[:, (0, 0, 0, 1, 1, 2), (0, 1, 2, 1, 2, 2)]
        np.testing.assert_allclose(triangle, [sample['covariance'] for sample in samples], rtol=1e-8)
        ids = np.array(self.curves.scene.image_ids)
        expected = [support[0] for sample in samples for support in sample['support']]
        np.testing.assert_array_equal(ids[self.curves.views], expected)
        counts = [len(sample['support']) for sample in samples]
        np.testing.assert_array_equal(np.diff(self.curves.support_offsets), counts)

    def test_curves_are_those_of_the_file(self):
        curves = self.json['curves']
        np.testing.assert_array_equal(self.curves.closed, [curve['closed'] for curve in curves])
        np.testing.assert_array_equal(np.diff(self.curves.offsets), [len(curve['samples']) for curve in curves])
        np.testing.assert_array_equal(self.curves.lengths(), [curve['length'] for curve in curves])
        for positions, curve in zip(self.curves, curves):
            np.testing.assert_array_equal(positions, [sample['position'] for sample in curve['samples']])
        np.testing.assert_array_equal(self.curves[-1], self.curves[len(curves) - 1])
        with self.assertRaisesRegex(IndexError, f'among {len(curves)} curves'):
            self.curves[len(curves)]
        for wrong in (slice(0, 2), '0', 0.5):
            with self.assertRaises(TypeError):
                self.curves[wrong]
        with self.assertRaisesRegex(TypeError, 'select'):
            self.curves[0:2]

    def test_fits_are_those_of_the_file(self):
        fits = [fit for curve in self.json['curves'] for fit in curve['fits']]
        rows = self.curves.fits
        self.assertEqual(len(fits), len(rows))
        np.testing.assert_array_equal(np.diff(self.curves.fit_offsets), [len(c['fits']) for c in self.json['curves']])
        for row, fit in zip(rows, fits):
            kind = 'arc' if fit['kind'] == 'circle' else fit['kind']
            self.assertEqual(pycurvix.FitKind(row['kind']).name.lower(), kind)
            for name in ('closed', 'first_sample', 'num_samples', 'length', 'start', 'end', 'sigma', 'rms_residual'):
                np.testing.assert_array_equal(row[name], fit[name])
            for name in ('radius', 'radius_sigma', 'center', 'major', 'minor', 'start_angle', 'end_angle'):
                if name in fit:
                    np.testing.assert_array_equal(row[name], fit[name])
            self.assertEqual(None if row['start_node'] < 0 else row['start_node'], fit['start_node'])
            if kind == 'spline':
                first, knot, n = row['first_point'], row['first_knot'], row['num_points']
                np.testing.assert_array_equal(self.curves.spline_points[first:first + n], fit['control_points'])
                np.testing.assert_array_equal(self.curves.spline_knots[knot:knot + n + 4], fit['knots'])
        np.testing.assert_array_equal(self.curves.nodes, [node['position'] for node in self.json['nodes']])

    def test_enumerations_are_those_of_the_library(self):
        self.assertEqual([kind.name.lower() for kind in pycurvix.CurveKind], _core.CURVE_KINDS)
        self.assertEqual([kind.name.lower() for kind in pycurvix.FitKind], _core.FIT_KINDS)
        self.assertEqual([kind.value for kind in pycurvix.CurveKind], list(range(len(_core.CURVE_KINDS))))

    def test_all_selected_are_all(self):
        self.curves.select(np.ones(len(self.curves), bool)).write(self.folder / 'all.json')
        self.assertEqual(contents(self.folder / 'all.json'), contents(self.workspace / 'curvix' / '0' / 'curves.json'))

    def test_selected_curves_are_the_same_curves(self):
        chosen = np.flatnonzero(self.curves.lengths() > np.median(self.curves.lengths()))[::-1]
        some = self.curves.select(chosen)
        self.assertEqual(len(some), len(chosen))
        for i, idx in enumerate(chosen):
            np.testing.assert_array_equal(some[i], self.curves[idx])
            for end in ('start_junction', 'end_junction'):
                junction = getattr(some, end)[i]
                if junction >= 0:
                    was = getattr(self.curves, end)[idx]
                    np.testing.assert_array_equal(some.junctions[junction], self.curves.junctions[was])
        ends = np.concatenate((some.start_junction, some.end_junction))
        self.assertTrue((np.bincount(ends[ends >= 0], minlength=len(some.junctions)) >= 2).all())
        nodes = np.concatenate((some.fits['start_node'], some.fits['end_node']))
        self.assertTrue((np.bincount(nodes[nodes >= 0], minlength=len(some.nodes)) >= 2).all())
        for row in some.fits:
            if row['start_node'] >= 0:
                np.testing.assert_array_equal(row['start'], some.nodes[row['start_node']])

    def test_none_can_be_selected_but_not_another(self):
        self.assertEqual(len(self.curves.select([])), 0)
        for wrong in ([len(self.curves)], [-1], [0.5], [True]):
            with self.assertRaises(pycurvix.ArgumentError):
                self.curves.select(wrong)

    def test_projections_are_those_of_the_cameras(self):
        scene = self.curves.scene
        self.assertEqual(set(scene.camera_models), {'PINHOLE'})
        for view in (0, 5):
            width, height = scene.sizes[view]
            num_seen = 0
            for positions, stretches in zip(self.curves, self.curves.project(view)):
                in_camera = positions @ scene.R[view].T + scene.t[view]
                pixels = in_camera @ scene.K[view].T
                pixels = pixels[:, :2] / pixels[:, 2:]
                is_seen = (in_camera[:, 2] > 0) & (pixels >= 0).all(1) & (pixels <= (width, height)).all(1)
                if not is_seen.all():
                    continue
                num_seen += 1
                self.assertEqual(len(stretches), 1)
                np.testing.assert_allclose(stretches[0][:len(pixels)], pixels, atol=1e-9)
            self.assertGreater(num_seen, 3)
        by_name = pycurvix.project(self.curves, scene.names[5])
        np.testing.assert_array_equal(by_name[0][0], self.curves.project(5, scene)[0][0])
        with self.assertRaises(pycurvix.ArgumentError):
            self.curves.project('no_such_image.png')

    def test_curves_of_a_file_have_positions_and_fits_but_no_views(self):
        curves = pycurvix.read(self.workspace / 'curvix' / '0' / 'curves.ply')
        np.testing.assert_allclose(curves.positions, self.curves.positions, rtol=0, atol=1e-6)
        self.assertIsNone(curves.scene)
        self.assertIsNone(curves.report)
        self.assertEqual(curves.support.shape, (0, 2))
        self.assertGreater(len(curves.fits), 0)
        with self.assertRaisesRegex(pycurvix.ArgumentError, 'scene'):
            curves.project(0)
        self.assertGreater(len(curves.project(0, self.curves.scene)[0]), 0)

    def test_a_text_file_keeps_the_views(self):
        path = self.workspace / 'curvix' / '0' / 'curves.txt'
        curves = pycurvix.read(path, self.curves.scene)
        np.testing.assert_array_equal(curves.views, self.curves.views)
        curves.write(self.folder / 'again.txt')
        self.assertEqual(contents(self.folder / 'again.txt'), contents(path))
        curves.write(self.folder / 'again.json')  # whose edges are not known
        samples = json.loads((self.folder / 'again.json').read_text())['curves'][0]['samples']
        edges = [support[1:] for sample in samples for support in sample['support']]
        self.assertGreater(len(edges), 10)
        self.assertEqual(edges, [[None, None, None]] * len(edges))
        with self.assertRaisesRegex(pycurvix.ArgumentError, '2D edges behind the curves are not known'):
            curves.write(self.folder / 'model', 'colmap')
        self.assertFalse((self.folder / 'model').exists())

    def test_repr_tells_what_there_is(self):
        self.assertRegex(repr(self.curves), r'<pycurvix.Curves: \d+ curves, \d+ closed, \d+ samples, total length')


class Memory(WorkspaceTest):

    def test_a_million_samples_are_not_copied(self):
        num_curves, num_samples = 1000, 1000
        path = self.folder / 'big.obj'
        with open(path, 'w', encoding='ascii') as file:
            for i in range(num_curves):
                file.writelines(f'v {k * 1e-3} {i} 0\n' for k in range(num_samples))
            for i in range(num_curves):
                first = 1 + i * num_samples
                file.write('l ' + ' '.join(map(str, range(first, first + num_samples))) + '\n')
        curves = pycurvix.read(path)
        self.assertEqual(curves.positions.shape, (num_curves * num_samples, 3))
        names = [name for name in VIEWS if name not in ('fits', 'fit_offsets', 'spline_points', 'spline_knots', 'nodes',
                                                            'node_covariances')]
        before = resident_bytes()
        views = [getattr(curves, name) for name in names]
        grown = resident_bytes() - before
        shown = sum(view.nbytes for view in views)
        print(f'\n{shown / 1e6:.0f} MB of arrays, {grown / 1e3:.0f} kB more memory')
        self.assertGreater(shown, 140e6)
        self.assertLess(grown, 1e6)


class Stubs(WorkspaceTest):

    def test_name_what_the_compiled_part_has(self):
        stub = pathlib.Path(pycurvix.__file__).with_name('_core.pyi').read_text(encoding='utf8')
        named = {}
        for node in ast.parse(stub).body:
            if isinstance(node, ast.ClassDef):
                named[node.name] = {getattr(item, 'name', None) or item.target.id for item in node.body
                                    if isinstance(item, (ast.FunctionDef, ast.AnnAssign))}
            elif isinstance(node, ast.FunctionDef):
                named[node.name] = None
            elif isinstance(node, ast.AnnAssign):
                named[node.target.id] = None
        actual = {name for name in vars(_core) if not name.startswith('__')} | {'__version__'}
        self.assertEqual(set(named), actual)
        for name, members in named.items():
            if members is None or issubclass(getattr(_core, name), Exception):
                continue
            public = {member for member in vars(getattr(_core, name)) if not member.startswith('_')}
            self.assertEqual({member for member in members if not member.startswith('_')}, public, name)

    def test_everything_public_is_documented(self):
        for name in pycurvix.__all__:
            thing = getattr(pycurvix, name)
            if name == '__version__':
                continue
            self.assertTrue(thing.__doc__, name)
            if isinstance(thing, type) and thing.__module__.startswith('pycurvix._') and not issubclass(thing, int):
                for member, value in vars(thing).items():
                    if not member.startswith('_') and (callable(value) or isinstance(value, (property, classmethod))):
                        self.assertTrue(getattr(value, '__doc__', None), f'{name}.{member}')


del WorkspaceTest  # has no cases of its own
