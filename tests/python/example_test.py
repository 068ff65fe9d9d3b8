# SPDX-License-Identifier: BSD-3-Clause
"""The example does what it says."""
import importlib.util
import re
import subprocess
import sys

import numpy as np

from workspace import SOURCE, WorkspaceTest


class Example(WorkspaceTest):
    solid = 'part'

    def run_example(self, min_length):
        return subprocess.run([sys.executable, SOURCE / 'examples' / '06_curves_in_python.py', self.workspace, min_length,
                               self.folder], capture_output=True, text=True, check=False)

    def test_writes_lines_and_a_picture(self):
        done = self.run_example('0.25')
        has_matplotlib = importlib.util.find_spec('matplotlib') is not None
        self.assertEqual(done.returncode, 0 if has_matplotlib else 1, done.stderr)
        num_lines = int(re.search(r'(\d+) lines are longer', done.stdout)[1])
        self.assertGreater(num_lines, 5)
        rows = np.loadtxt(self.folder / 'lines.csv', delimiter=',', skiprows=1)
        self.assertEqual(rows.shape, (num_lines, 8))
        self.assertTrue((rows[:, 6] > 0.25).all())
        np.testing.assert_allclose(np.linalg.norm(rows[:, 3:6] - rows[:, :3], axis=1), rows[:, 6], atol=1e-4)
        self.assertGreaterEqual((self.folder / 'lines.dxf').read_text().count('AcDbLine'), num_lines)
        if not has_matplotlib:
            self.skipTest('python3-matplotlib is not installed: no picture')
        self.assertEqual((self.folder / 'curves.png').read_bytes()[1:4], b'PNG')
        self.assertIn('curves.png', done.stdout)


del WorkspaceTest  # has no cases of its own
