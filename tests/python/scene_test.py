# SPDX-License-Identifier: BSD-3-Clause
"""Scenes from COLMAP's files, from its objects and from arrays."""
import os
import shutil
import struct
import sys
import types
import unittest
import zlib

import numpy as np

import pycurvix
from workspace import WorkspaceTest, contents


class Records:
    """Numbers of a binary file, one after the other."""

    def __init__(self, path):
        self.data = path.read_bytes()
        self.at = 0

    def take(self, form):
        values = struct.unpack_from('<' + form, self.data, self.at)
        self.at += struct.calcsize('<' + form)
        return values

    def text(self):
        end = self.data.index(b'\0', self.at)
        begin, self.at = self.at, end + 1
        return self.data[begin:end].decode()


def write_png(path, pixels):
    """Of height x width x channels; the machine's order of bytes or another."""
    height, width, channels = pixels.shape
    color_type = {1: 0, 3: 2, 4: 6}[channels]
    rows = pixels.astype(pixels.dtype.newbyteorder('>')).reshape(height, -1)
    data = b''.join(b'\0' + row.tobytes() for row in rows)
    with path.open('wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n')
        for kind, chunk in ((b'IHDR', struct.pack('>2I5B', width, height, 8 * pixels.itemsize, color_type, 0, 0, 0)),
                            (b'IDAT', zlib.compress(data)), (b'IEND', b'')):
            file.write(struct.pack('>I', len(chunk)) + kind + chunk + struct.pack('>I', zlib.crc32(kind + chunk)))


def fake_reconstruction(folder, is_method):
    """What pycolmap makes of a model: attributes of its version 3, or 4."""
    records = Records(folder / 'cameras.bin')
    cameras, images, points = {}, {}, {}
    for _ in range(*records.take('Q')):
        camera_id, model, width, height = records.take('IiQQ')
        assert model == 1
        cameras[camera_id] = types.SimpleNamespace(model=types.SimpleNamespace(name='PINHOLE'), width=width,
                                                   height=height, params=np.array(records.take('4d')))
    records = Records(folder / 'images.bin')
    for _ in range(*records.take('Q')):
        image_id, w, x, y, z, *translation, camera_id = records.take('I7dI')
        name = records.text()
        pose = types.SimpleNamespace(rotation=types.SimpleNamespace(quat=np.array((x, y, z, w))),
                                     translation=np.array(translation))
        observed = [records.take('ddQ') for _ in range(*records.take('Q'))]
        images[image_id] = types.SimpleNamespace(
            image_id=image_id, camera_id=camera_id, name=name, has_pose=True,
            cam_from_world=(lambda pose=pose: pose) if is_method else pose,
            points2D=[types.SimpleNamespace(xy=np.array((x, y))) for x, y, _ in observed])
    records = Records(folder / 'points3D.bin')
    for _ in range(*records.take('Q')):
        point_id, x, y, z = records.take('Q3d')
        records.take('3Bd')
        elements = [types.SimpleNamespace(**dict(zip(('image_id', 'point2D_idx'), records.take('II'))))
                    for _ in range(*records.take('Q'))]
        points[point_id] = types.SimpleNamespace(xyz=np.array((x, y, z)),
                                                 track=types.SimpleNamespace(elements=elements))
    return types.SimpleNamespace(cameras=cameras, images=images, points3D=points)


class FromColmap(WorkspaceTest):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = pycurvix.Scene.from_colmap(cls.workspace)

    def test_has_what_the_model_has(self):
        model = fake_reconstruction(self.workspace / 'sparse' / '0', True)
        self.assertEqual(len(self.scene), 12)
        self.assertEqual(self.scene.names, sorted(image.name for image in model.images.values()))
        image = next(image for image in model.images.values() if image.name == self.scene.names[3])
        np.testing.assert_array_equal(self.scene.t[3], image.cam_from_world().translation)
        x, y, z, w = image.cam_from_world().rotation.quat
        turned = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
        np.testing.assert_allclose(self.scene.R[3][:, 0], turned, atol=1e-12)
        np.testing.assert_array_equal(self.scene.sizes, [(160, 160)] * 12)
        self.assertEqual(len(self.scene.points), len(model.points3D))
        self.assertRegex(repr(self.scene), r'<pycurvix.Scene: 12 views, 1 camera, \d+ points>')
        self.assertEqual(self.scene.view_idx(-1), 11)
        self.assertEqual(self.scene.view_idx(self.scene.names[4]), 4)
        self.assertEqual(self.scene.view_idx(np.int32(3)), 3)
        for none in (12, -13, 0.7, True, 'none.png', None):
            with self.assertRaisesRegex(pycurvix.ArgumentError, 'there is no view'):
                self.scene.view_idx(none)

    def test_missing_images_are_told(self):
        fewer = self.folder / 'images'
        fewer.mkdir()
        for path in sorted((self.workspace / 'images').iterdir())[:8]:
            (fewer / path.name).symlink_to(path)
        with self.assertLogs('pycurvix', 'WARNING') as logs:
            scene = pycurvix.Scene.from_colmap(self.workspace, fewer)
        self.assertEqual(len(scene), 8)
        self.assertIn('4 of 12 images', logs.output[0])

    def test_names_need_not_be_utf8(self):
        other = self.folder / 'proj'
        shutil.copytree(self.workspace, other)
        model = other / 'sparse' / '0' / 'images.bin'
        model.write_bytes(model.read_bytes().replace(b'view_', b'vi\xe9w_'))
        for path in list((other / 'images').iterdir()):
            path.rename(path.with_name(os.fsdecode(path.name.encode().replace(b'view_', b'vi\xe9w_'))))
        scene = pycurvix.Scene.from_colmap(other)
        self.assertEqual(scene.names, sorted(os.listdir(other / 'images')))
        self.assertEqual(scene.view_idx(scene.names[4]), 4)
        (self.folder / 'line.obj').write_text('v -1 0 0\nv 1 0.5 0\nl 1 2\n', encoding='ascii')
        curves = pycurvix.read(self.folder / 'line.obj', scene)
        for name in ('first', 'fifth'):
            curves.write(self.folder / f'{name}.svg', svg_image='' if name == 'first' else scene.names[4])
        self.assertNotEqual(contents(self.folder / 'first.svg'), contents(self.folder / 'fifth.svg'))
        for name in ('n\xf6ne.png', os.fsdecode(b'n\xf6ne.png')):
            with self.assertRaisesRegex(pycurvix.ArgumentError, 'no image of the model'):
                curves.write(self.folder / 'none.svg', svg_image=name)

    def test_pycolmap_gives_the_same_scene_and_curves(self):
        self.scene_curves().write(self.folder / 'a.json')
        for is_method in (True, False):
            model = fake_reconstruction(self.workspace / 'sparse' / '0', is_method)
            scene = pycurvix.Scene.from_pycolmap(model, self.workspace / 'images')
            for name in ('names', 'image_paths', 'image_ids', 'camera_models', 'camera_params'):
                self.assertEqual(getattr(scene, name), getattr(self.scene, name))
            for name in ('K', 'R', 't', 'sizes', 'points'):
                np.testing.assert_array_equal(getattr(scene, name), getattr(self.scene, name), name)
            pycurvix.reconstruct(scene=scene).write(self.folder / 'b.json')
            self.assertEqual(contents(self.folder / 'b.json'), contents(self.folder / 'a.json'))

    def scene_curves(self):
        return pycurvix.reconstruct(scene=self.scene)

    def test_pycolmap_images_without_pose_or_file_are_left_out(self):
        model = fake_reconstruction(self.workspace / 'sparse' / '0', True)
        ids = sorted(model.images)
        model.images[ids[0]].has_pose = False
        model.images[ids[1]].name = 'gone.png'
        with self.assertLogs('pycurvix', 'WARNING'):
            scene = pycurvix.Scene.from_pycolmap(model, self.workspace / 'images')
        self.assertEqual(len(scene), 10)

    def test_arrays_and_images_give_the_same_curves(self):
        scene = pycurvix.Scene.from_arrays(self.scene.K[0], self.scene.R, self.scene.t, self.scene.image_paths)
        np.testing.assert_allclose(scene.R, self.scene.R, atol=1e-14)
        np.testing.assert_array_equal(scene.sizes, self.scene.sizes)
        options = {'refine_poses_with_curves': False}
        curves = pycurvix.reconstruct(scene=scene, options=options)
        truth = self.workspace / 'gt.txt'
        expected = pycurvix.evaluate(pycurvix.reconstruct(scene=self.scene, options=options), truth)
        self.assertAlmostEqual(pycurvix.evaluate(curves, truth)['F5'], expected['F5'], delta=1)
        self.assertEqual(curves.scene.names, self.scene.names)
        curves.write(self.folder / 'model', 'colmap')
        self.assertTrue((self.folder / 'model' / 'points3D.bin').exists())


class FromImagesInMemory(WorkspaceTest):
    """Arrays give the same bytes as files of the same images."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        try:
            from PIL import Image
        except ImportError:
            raise unittest.SkipTest('python3-pil was not found')
        cls.scene = pycurvix.Scene.from_colmap(cls.workspace)
        cls.grey = [np.array(Image.open(path).convert('L')) for path in cls.scene.image_paths]

    def make(self, images):
        names = [f'{i:02}.png' for i in range(len(images))]
        return pycurvix.Scene.from_arrays(self.scene.K[0], self.scene.R, self.scene.t, images, names=names)

    def check(self, images, formats=('ply',)):
        """Images of height x width or height x width x channels."""
        folder = self.folder / 'files'
        folder.mkdir()
        for i, image in enumerate(images):
            write_png(folder / f'{i:02}.png', np.atleast_3d(image))
        scene = self.make(images)
        self.assertEqual(scene.image_paths, [''] * len(images))
        expected = pycurvix.reconstruct(scene=self.make([folder / name for name in scene.names]))
        curves = pycurvix.reconstruct(scene=scene)
        self.assertGreater(len(curves), 0)
        for form in formats:
            expected.write(self.folder / f'expected.{form}')
            curves.write(self.folder / f'got.{form}')
            self.assertEqual(contents(self.folder / f'got.{form}'), contents(self.folder / f'expected.{form}'), form)
        return scene

    def test_grey(self):
        before = [image.copy() for image in self.grey]
        scene = self.check(self.grey, ('ply', 'json', 'html', 'svg'))
        np.testing.assert_array_equal(scene.sizes, [(160, 160)] * len(scene))
        np.testing.assert_array_equal(self.grey, before)

    def test_an_array_of_colours_with_alpha(self):
        alpha = np.full_like(self.grey[0], 200)
        self.check(np.array([np.stack((grey, 255 - grey // 2, grey // 3, alpha), axis=2) for grey in self.grey]))

    def test_16_bits_in_another_order_of_bytes_and_of_columns(self):
        deep = [np.stack((257 * grey.astype('>u2'), 130 * grey.astype('>u2'), grey.astype('>u2')), axis=2)
                for grey in self.grey]
        self.check([image[:, :, ::-1] for image in deep])

    def test_arrays_and_files_may_be_mixed(self):
        scene = self.make([self.scene.image_paths[0], *self.grey[1:]])
        self.assertEqual(scene.image_paths[:2], [self.scene.image_paths[0], ''])

    def test_names_are_paths_from_the_common_folder(self):
        pixels = self.grey[0]

        def names(*images):
            view = [np.eye(3)] * len(images), np.zeros((len(images), 3))
            return pycurvix.Scene.from_arrays(self.scene.K[0], *view, images).names

        for name in ('a/1.png', 'b/c/2.png', '3..png'):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            write_png(self.folder / name, pixels[:, :, np.newaxis])
        folder = str(self.folder)
        self.assertEqual(names(folder + '/a/1.png', self.folder / 'b/c/2.png'), ['a/1.png', 'b/c/2.png'])
        self.assertEqual(names(folder + '/b/../a/1.png'), ['1.png'])
        self.assertEqual(names(pixels, folder + '/3..png', folder + '/a/1.png'), ['view_00000', '3..png', 'a/1.png'])
        was = os.getcwd()
        self.addCleanup(os.chdir, was)
        os.chdir(self.folder / 'a')
        self.assertEqual(names('1.png', pixels), ['1.png', 'view_00001'])
        self.assertEqual(names('1.png', '../b/c/2.png'), ['a/1.png', 'b/c/2.png'])
        self.assertEqual(names('1.png', folder + '/3..png'), ['a/1.png', '3..png'])
        os.chdir(self.folder)
        self.assertEqual(names('a/1.png', '3..png'), ['a/1.png', '3..png'])

    def test_arrays_are_kept_not_copied(self):
        images = [grey.copy() for grey in self.grey]
        scene = self.make(images)
        counts = [sys.getrefcount(image) for image in images]
        del scene
        self.assertEqual([sys.getrefcount(image) + 1 for image in images], counts)

    def test_what_is_no_image_is_refused(self):
        grey = self.grey
        for what, image in (('float64', grey[0] / 255), ('int64', grey[0].astype(int)), ('shape', grey[0][0]),
                            ('shape', np.stack((grey[0], grey[0]), axis=2)), ('shape', grey[0][:0]),
                            ('80 x 160 pixels, its camera 160 x 160', grey[1][:, :80])):
            with self.assertRaisesRegex(pycurvix.ArgumentError, what):
                self.make([*grey[:-1], image])


def helix_scene(**more):
    """Twelve cameras around a helix, and its edges."""
    K = np.array([[700, 0, 300], [0, 700, 300], [0, 0, 1.0]])
    turn = np.arange(12) * np.pi / 6
    centers = np.stack((4 * np.cos(turn), 4 * np.sin(turn), np.full(12, 2.0)), axis=1)
    forward = -centers / np.linalg.norm(centers, axis=1, keepdims=True)
    right = np.cross(forward, (0, 0, 1))
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    R = np.stack((right, np.cross(forward, right), forward), axis=1)
    t = -np.einsum('nij,nj->ni', R, centers)
    angle = np.linspace(0, 3 * np.pi, 4000)
    helix = np.stack((np.cos(angle), np.sin(angle), 0.1 * angle), axis=1)
    edges = []
    for i in range(12):
        seen = (helix @ R[i].T + t[i]) @ K.T
        seen = seen[:, :2] / seen[:, 2:]
        along = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(seen, axis=0), axis=1))))
        at = np.arange(0, along[-1], 0.5)
        x, y = (np.interp(at, along, seen[:, k]) for k in (0, 1))
        edges.append(np.stack((x, y, np.arctan2(np.gradient(y), np.gradient(x))), axis=1))
    return pycurvix.Scene.from_arrays(**{'K': K, 'R': R, 't': t, 'edges': edges, 'sizes': (600, 600), **more})


class FromArrays(WorkspaceTest):

    def test_edges_of_a_helix_give_the_helix(self):
        scene = helix_scene()
        self.assertIn('with edges', repr(scene))
        curves = pycurvix.reconstruct(scene=scene)
        self.assertAlmostEqual(curves.lengths().sum(), 3 * np.pi * np.hypot(1, 0.1), delta=0.1)
        np.testing.assert_allclose(np.linalg.norm(curves.positions[:, :2], axis=1), 1, atol=0.02)
        curves.write(self.folder / 'helix.json')
        curves.write(self.folder / 'helix.dxf')

    def test_rotations_of_all_kinds_are_kept(self):
        random = np.random.default_rng(1)
        turns = np.linalg.qr(random.normal(size=(9, 3, 3)))[0]
        turns *= np.linalg.det(turns)[:, None, None]
        half = np.array([np.eye(3), np.diag((1, -1, -1)), np.diag((-1, 1, -1.0))])
        R = np.concatenate((turns, half))
        np.testing.assert_allclose(helix_scene(R=R).R, R, atol=1e-14)

    def test_what_does_not_fit_is_refused(self):
        K = np.array([[700, 0, 300], [0, 700, 300], [0, 0, 1.0]])
        skew = K.copy()
        skew[0, 1] = 1
        flat = [np.zeros((5, 2))] * 12
        for what, more in (('K', {'K': skew}), ('no rotation', {'R': -np.array([np.eye(3)] * 12)}),
                           ('shape', {'t': np.zeros((11, 3))}), ('finite', {'t': np.full((12, 3), np.nan)}),
                           ('either', {'images': ['a.png'] * 12}), ('either', {'edges': None}),
                           ('sizes', {'sizes': None}), ('shape', {'edges': flat}), ('11 edges', {'edges': flat[:11]}),
                           ('named', {'names': ['a'] * 12}), ('names', {'names': ['\ud800'] * 12}),
                           *(('sizes', {'sizes': (size, 600)}) for size in (0, -600, 0.5, 3e9)),
                           *(('edge_spacing_px', {'edge_spacing_px': px}) for px in (0, -1, np.nan, np.inf, 'x'))):
            with self.assertRaisesRegex(pycurvix.ArgumentError, what):
                helix_scene(**more)
        with self.assertRaises(pycurvix.NotFoundError):
            helix_scene(edges=None, images=[f'/no/such/{i}.png' for i in range(12)], sizes=None)

    def test_views_without_edges_are_views(self):
        scene = helix_scene(edges=[np.empty((0, 3))] * 12)
        curves = pycurvix.reconstruct(scene=scene)
        self.assertEqual(len(curves), 0)
        self.assertTrue(curves.report['result']['why_empty'])


del WorkspaceTest  # has no cases of its own
