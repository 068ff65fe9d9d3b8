#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens the files of a run with programs of Debian 12, and says what each saw.

  open_files.py <workspace>/curvix/0 [...] >table.md

For runs with --output_formats ply,obj,pcd,txt,json,dxf,step,vtp,glb,svg,colmap,html.
Prints a table with a column per run; `curves; segments; samples`, where curves
are parts that hang together, if segments are all that a program shows.
Programs that are missing are left out. Packages: assimp-utils blender chromium
cloudcompare colmap f3d freecad-python3 gdal-bin meshlab pcl-tools
python3-ezdxf python3-numpy python3-open3d python3-scipy python3-vtk9 xvfb
"""
import argparse
import collections
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


class Missing(Exception):
    """The program is not installed."""


def run(*command):
    """What a program says."""
    program = command[2] if command[0] == 'xvfb-run' else command[0]
    for needed in (command[0], program):
        if shutil.which(needed) is None:
            raise Missing(needed)
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300,
                          encoding='utf8', errors='replace', check=False).stdout


def seen(segments, num_points):
    segments = np.asarray(segments).reshape(-1, 2)
    graph = coo_matrix((np.ones(len(segments)), segments.T), (num_points, num_points))
    parts = connected_components(graph, directed=False)[1]
    return f'{len(np.unique(parts[segments[:, 0]]))}; {len(segments)}; {num_points}'


def kinds(names):
    count = collections.Counter(names)
    return ', '.join(f'{count[kind]} {kind}' for kind in sorted(count))


def written(run_folder):
    curves = json.loads((run_folder / 'curves.json').read_text())['curves']
    samples = sum(len(curve['samples']) for curve in curves)
    segments = samples - sum(not curve['closed'] for curve in curves)
    return f'{len(curves)}; {segments}; {samples}'


def written_fits(run_folder):
    curves = json.loads((run_folder / 'curves.json').read_text())['curves']
    return kinds(fit['kind'] for curve in curves for fit in curve['fits'])


def open3d_lines(path):
    import open3d
    lines = open3d.io.read_line_set(str(path))
    return seen(lines.lines, len(lines.points))


def open3d_points(path):
    import open3d
    return f'{len(open3d.io.read_point_cloud(str(path)).points)} points'


def obj_seen(text):
    return seen([[int(i) - 1 for i in line.split()[1:3]] for line in text.splitlines() if line.startswith('l ')],
                sum(line.startswith('v ') for line in text.splitlines()))


def meshlab(path):
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / 'copy.obj'
        run('xvfb-run', '-a', 'meshlabserver', '-i', str(path), '-o', str(copy))
        return obj_seen(copy.read_text())


# The importer of glTF is older than the NumPy beside it.
BLENDER = '''
import bpy, numpy, sys
numpy.bool = bool
bpy.ops.wm.read_factory_settings(use_empty=True)
path = sys.argv[-1]
{'ply': bpy.ops.import_mesh.ply, 'obj': bpy.ops.wm.obj_import, 'svg': bpy.ops.import_curve.svg,
 'glb': bpy.ops.import_scene.gltf}[path[-3:]](filepath=path)
segments, first = [], 0
for mesh in (thing.data for thing in bpy.data.objects if thing.type == 'MESH'):
    segments += [[first + i for i in edge.vertices] for edge in mesh.edges]
    first += len(mesh.vertices)
print('SEEN', [sum(thing.type == 'CURVE' for thing in bpy.data.objects), segments, first])
'''


def blender(path):
    said = run('blender', '--background', '--factory-startup', '--python-expr', BLENDER, '--', str(path))
    curves, segments, points = json.loads(re.search(r'SEEN (.*)', said)[1])
    return f'{curves} curves' if curves else seen(segments, points)


def cloudcompare(path):
    said = run('xvfb-run', '-a', 'CloudCompare', '-SILENT', '-O', str(path))
    sizes = [int(size) for size in re.findall(r'Found one cloud with (\d+) points', said)]
    return f'{len(sizes)} polylines' if path.suffix == '.dxf' else f'{sum(sizes)} points'


def vtk_lines(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return f'{reader.GetOutput().GetNumberOfLines()} lines; {reader.GetOutput().GetNumberOfPoints()} points'


def vtk_vtp(path):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    return vtk_lines(vtkXMLPolyDataReader(), path)


def vtk_obj(path):
    from vtkmodules.vtkIOGeometry import vtkOBJReader
    return vtk_lines(vtkOBJReader(), path)


def f3d(path):
    said = run('f3d', '--no-render', '--verbose', str(path))
    lines = sum(int(count) for count in re.findall(r'Number of lines: (\d+)', said))
    points = sum(int(count) for count in re.findall(r'Number of points: (\d+)', said))
    return f'{lines} lines; {points} points'


def assimp(path):
    said = run('assimp', 'info', str(path))
    meshes, faces = (re.search(name + r': +(\d+)', said) for name in ('Meshes', 'Faces'))
    return f'{meshes[1]} meshes; {faces[1]} segments'


def pcl(path):
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / 'copy.pcd'
        run('pcl_convert_pcd_ascii_binary', str(path), str(copy), '0')
        header, rows = copy.read_text().split('DATA ascii\n')
        column = re.search(r'FIELDS (.*)', header)[1].split().index('curve_id')
        ids = [row.split()[column] for row in rows.splitlines()]
        return f'{len(set(ids))} ids; {len(ids)} points'


def ezdxf_audit(path):
    import ezdxf
    document = ezdxf.readfile(path)
    audit = document.audit()
    faults = len(audit.errors) + len(audit.fixes)
    return kinds(entity.dxftype().lower() for entity in document.modelspace()) + f'; {faults} faults'


FREECAD = '''
import FreeCAD, Import
document = FreeCAD.newDocument("seen")
if {path!r}.endswith("dxf"):
    Import.readDXF({path!r}, "seen")
else:
    Import.insert({path!r}, "seen", merge=True)
for thing in document.Objects:
    for edge in thing.Shape.Edges:
        print("\\nEDGE", type(edge.Curve).__name__, edge.Closed)
'''


def freecad(path):
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / 'read.py'
        script.write_text(FREECAD.format(path=str(path)))
        edges = re.findall(r'EDGE (\w+) (\w+)', run('freecadcmd', str(script)))
    return kinds('arc' if edge == ('Circle', 'False') else edge[0].lower() for edge in edges)


def ogr(path):
    said = run('ogrinfo', '-al', '-so', str(path))
    return re.search(r'Feature Count: (\d+)', said)[1] + ' entities'


def chromium(path):
    with tempfile.TemporaryDirectory() as folder:
        said = run('chromium', '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
                   '--enable-unsafe-swiftshader', '--virtual-time-budget=5000', '--user-data-dir=' + folder,
                   '--dump-dom', path.resolve().as_uri())
    shown = re.search(r'id="shown">(\d+)<', said)
    return (shown[1] if shown else str(said.count('class="curve"'))) + ' curves'


def colmap(path):
    return re.search(r'Points: (\d+)', run('colmap', 'model_analyzer', '--path', str(path)))[1] + ' points'


ROWS = (
    ('Open3D', 'curves.ply', open3d_lines), ('Open3D', 'curves.pcd', open3d_points), ('Open3D', 'edges.ply', open3d_points),
    ('MeshLab', 'curves.ply', meshlab), ('MeshLab', 'curves.obj', meshlab),
    ('Blender', 'curves.ply', blender), ('Blender', 'curves.obj', blender), ('Blender', 'curves.glb', blender),
    ('Blender', 'curves.svg', blender),
    ('CloudCompare', 'curves.obj', cloudcompare), ('CloudCompare', 'curves.dxf', cloudcompare),
    ('CloudCompare', 'edges.ply', cloudcompare),
    ('VTK', 'curves.vtp', vtk_vtp), ('VTK', 'curves.obj', vtk_obj),
    ('F3D', 'curves.vtp', f3d),
    ('assimp', 'curves.glb', assimp), ('assimp', 'curves.obj', assimp),
    ('PCL', 'curves.pcd', pcl),
    ('FreeCAD', 'curves.dxf', freecad), ('FreeCAD', 'curves.step', freecad), ('ezdxf', 'curves.dxf', ezdxf_audit), ('GDAL', 'curves.dxf', ogr),
    ('Chromium', 'viewer.html', chromium), ('Chromium', 'curves.svg', chromium),
    ('COLMAP', 'curves_model', colmap),
)


def cells(name, read, paths):
    try:
        return [read(path) for path in paths]
    except (ImportError, Missing) as error:
        print(f'{name}: left out, {error}', file=sys.stderr)
    except Exception as error:  # a program that fails is what this is to find
        return [f'fails: {type(error).__name__}: {error}']
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('runs', nargs='+', type=pathlib.Path)
    runs = parser.parse_args().runs
    print('| program, file | ' + ' | '.join(folder.resolve().parents[1].name for folder in runs) + ' |')
    print('|---' * (len(runs) + 1) + '|')
    for name, read in (('**written**: curves; segments; samples', written), ('**written**: fits', written_fits)):
        print(f'| {name} | ' + ' | '.join(read(folder) for folder in runs) + ' |')
    for program, file, read in ROWS:
        row = cells(program, read, [folder / file for folder in runs])
        if row is not None:
            print(f'| {program}, `{file}` | ' + ' | '.join(row) + ' |', flush=True)


if __name__ == '__main__':
    main()
