# SPDX-License-Identifier: BSD-3-Clause
"""A small workspace and the program, for the tests of pycurvix."""
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ['CURVIX_PROGRAM']
SOURCE = pathlib.Path(__file__).resolve().parents[2]
FORMATS = {'ply': 'curves.ply', 'obj': 'curves.obj', 'pcd': 'curves.pcd', 'txt': 'curves.txt', 'json': 'curves.json',
           'dxf': 'curves.dxf', 'vtp': 'curves.vtp', 'glb': 'curves.glb', 'svg': 'curves.svg', 'colmap': 'curves_model',
           'html': 'viewer.html', 'step': 'curves.step', 'csv': 'dimensions.csv'}


def run_program(*arguments):
    """The program's words; fails if it does."""
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def contents(path):
    """Bytes of a file, or of all files of a folder."""
    if path.is_dir():
        return {file.name: file.read_bytes() for file in sorted(path.iterdir())}
    return path.read_bytes()


class WorkspaceTest(unittest.TestCase):
    """Cases that share a workspace in self.workspace; each has self.folder."""

    solid = 'block'

    @classmethod
    def setUpClass(cls):
        shared = tempfile.TemporaryDirectory()
        cls.addClassCleanup(shared.cleanup)
        cls.shared = pathlib.Path(shared.name)
        cls.workspace = cls.shared / 'proj'
        run_program('synthesize', '--solid', cls.solid, '--num_views', 12, '--width', 160, '--height', 160,
                    '--workspace_path', cls.workspace)

    def setUp(self):
        own = tempfile.TemporaryDirectory()
        self.addCleanup(own.cleanup)
        self.folder = pathlib.Path(own.name)
