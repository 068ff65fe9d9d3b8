# SPDX-License-Identifier: BSD-3-Clause
"""What the add-on for Blender reads of COLMAP's models, without Blender."""
import importlib.util
import pathlib
import sys
import tempfile
import types
import unittest

ADD_ON = pathlib.Path(__file__).parents[2] / 'plugin' / 'blender' / 'curvix_blender.py'


def load_add_on():
    """The add-on, with names in place of Blender's modules, which it needs only to be loaded."""
    def module(name, **names):
        sys.modules[name] = types.ModuleType(name)
        vars(sys.modules[name]).update(names)

    def prop(**_):
        return None

    module('bpy', types=types.SimpleNamespace(Operator=type('Operator', (), {})))
    module('bpy.props', BoolProperty=prop, FloatProperty=prop, StringProperty=prop)
    module('bpy_extras')
    module('bpy_extras.io_utils', ImportHelper=type('ImportHelper', (), {}))
    module('mathutils', Matrix=None)
    spec = importlib.util.spec_from_file_location('curvix_blender', ADD_ON)
    add_on = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(add_on)
    return add_on


class TextModels(unittest.TestCase):
    add_on = load_add_on()

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)

    def names(self, images, cameras=b'# list\n1 PINHOLE 8 6 7 7 4 3\n'):
        (self.folder / 'cameras.txt').write_bytes(cameras)
        (self.folder / 'images.txt').write_bytes(images)
        cameras, images = self.add_on.read_model(self.folder)
        self.assertEqual(cameras, {1: ('PINHOLE', 8, 6, (7, 7, 4, 3))})
        return [image[3] for image in images]

    def test_blank_lines_and_images_without_points(self):
        first, second = b'1 1 0 0 0 0 0 5 1 a.png\n', b'2 1 0 0 0 1 0 5 1 b c.png\n'
        for images in (first + b'\n' + second + b'\n', b'# two\n\n' + first + b'1 2 -1\n' + second,
                       first + b'\n\n' + second, (first + b'1 2 3\n' + second + b'4 5 6\n').replace(b'\n', b'\r\n')):
            self.assertEqual(self.names(images), ['a.png', 'b c.png'])

    def test_byte_order_marks_and_trailing_blanks(self):
        mark = b'\xef\xbb\xbf'
        images = mark + b'# list\n1 1 0 0 0 0 0 5 1 a.png  \n\n'
        self.assertEqual(self.names(images, mark + b'# list\n1 PINHOLE 8 6 7 7 4 3\n'), ['a.png'])

    def test_names_that_are_no_paths_here(self):
        name, latin = self.names(b'1 1 0 0 0 0 0 5 1 left\\a.png\n\n2 1 0 0 0 1 0 5 1 \xe9.png\n\n')
        (self.folder / 'left').mkdir()
        (self.folder / 'left' / 'a.png').touch()
        self.assertEqual(self.add_on.path_of(self.folder, name), self.folder / 'left' / 'a.png')
        self.assertIsNone(self.add_on.path_of(self.folder, 'b.png'))
        self.assertIsNone(self.add_on.path_of(pathlib.Path(), name))
        self.assertEqual(self.add_on.shown(latin), '?.png')

    def test_folders_without_a_model(self):
        self.assertFalse(self.add_on.holds_model(None))
        self.assertFalse(self.add_on.holds_model(self.folder))
        self.names(b'')
        self.assertTrue(self.add_on.holds_model(self.folder))


if __name__ == '__main__':
    unittest.main()
