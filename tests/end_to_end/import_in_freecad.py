#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Imports curves.json by the macro, and checks what FreeCAD has then.

  import_in_freecad.py <macro> <curves.json>

Prints the number of edges by feature, which is the kind of curve and the type, as
JSON; exits with 77 where FreeCAD is not installed.
"""
import importlib.machinery
import importlib.util
import json
import sys

sys.path.append('/usr/lib/freecad-python3/lib')  # where Debian keeps it
try:
    import FreeCAD
    import Part
    import Sketcher
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(77)

sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader('curvix', sys.argv[1])
macro = importlib.util.module_from_spec(importlib.util.spec_from_loader('curvix', loader))
loader.exec_module(macro)

assert macro.millimetres_per_unit({'alignment': {'unit': 'm'}}) == 1000
assert macro.millimetres_per_unit({}) is None


def check_edges(features, fits, scale):
    """Each edge against its fit, in the order of the curves."""
    for feature in features:
        kind, primitive = feature.Name.rsplit('_', 1)
        mine = [(curve, fit) for curve, fit in fits if curve.get('kind', 'unknown') == kind and fit['kind'] + 's' == primitive]
        assert len(mine) == len(feature.Shape.Edges)
        assert [curve['id'] for curve, _ in mine] == feature.CurveIds
        for edge, (_, fit) in zip(feature.Shape.Edges, mine):
            assert abs(edge.Length / scale - fit['length']) < 1e-5 * fit['length'], (edge.Length, fit)
            if 'radius' in fit:
                assert abs(edge.Curve.Radius / scale - fit['radius']) < 1e-9 * fit['radius']
            if not fit['closed']:
                start = edge.valueAt(edge.FirstParameter) / scale
                assert start.distanceToPoint(FreeCAD.Vector(*fit['start'])) < 1e-3 * fit['length'] + fit['sigma']


def check_sketch():
    """Of a rectangle with one round corner, a hole and a slot, and of curves beside their plane."""
    def line(start, end, nodes):
        return {'kind': 'line', 'closed': False, 'start': start, 'end': end, 'start_node': nodes[0], 'end_node': nodes[1]}

    def conic(kind, center, major, minor, angles, nodes=(None, None)):
        return {'kind': kind, 'closed': angles[1] - angles[0] > 6.28, 'center': center, 'major': major, 'minor': minor,
                'start_angle': angles[0], 'end_angle': angles[1], 'start_node': nodes[0], 'end_node': nodes[1]}

    turn = 1.5707963267948966
    fits = [
        line([0, 5, 0], [4, 5, 0], (0, 1)), line([4, 5, 0], [4, 5, 2], (1, 2)),
        conic('arc', [3, 5, 2], [1, 0, 0], [0, 0, 1], (0, turn), (2, 3)),
        line([3, 5, 3], [0, 5, 3], (3, 4)), line([0, 5, 3], [0, 5, 0], (4, 0)),
        conic('circle', [1, 5, 1], [0.5, 0, 0], [0, 0, 0.5], (0, 4 * turn)),
        conic('ellipse', [2, 5, 2], [0.5, 0, 0], [0, 0, 0.25], (0, 2 * turn)),
        {'kind': 'spline', 'closed': False, 'degree': 3, 'knots': [0, 0, 0, 0, 1, 1, 1, 1], 'start_node': None,
         'end_node': None, 'control_points': [[2, 5, 0.5], [2.3, 5, 0.8], [2.7, 5, 0.8], [3, 5, 0.5]]},
        line([0, 5, 0], [0, 8, 0], (0, None)), line([0, 6, 0], [4, 6, 0], (None, None)),
        conic('circle', [1, 5, 1], [0.5, 0, 0], [0, 0.5, 0], (0, 4 * turn))]
    with open(FreeCAD.ConfigGet('AppTempPath') + 'part.json', 'w') as file:
        json.dump({'format': 'curvix curves', 'version': 1, 'curves': [{'id': 0, 'fits': fits}]}, file)
    document = FreeCAD.newDocument('part')
    features = macro.import_file(file.name, document, 10)
    lines = next(feature.Shape.Edges for feature in features if feature.Name == 'unknown_lines')
    arc = next(feature.Shape.Edges for feature in features if feature.Name == 'unknown_arcs')[0]
    for chosen in ([arc], lines[:2], [lines[0].Vertexes[0], lines[1].Vertexes[0], lines[1].Vertexes[1]]):
        sketch = macro.make_sketch(document, macro.plane_through(chosen), 0.01)
        assert len(sketch.Geometry) == 8, sketch.Geometry
        assert len(sketch.Constraints) == 5, sketch.Constraints
        assert sketch.solve() == 0
        box = sketch.Shape.BoundBox
        assert abs(box.YMin - 50) < 1e-6 and abs(box.YMax - 50) < 1e-6, box
        assert abs(box.XLength - 40) < 1e-6 and abs(box.ZLength - 30) < 1e-6, box
        length = sum(edge.Length for feature in features for edge in feature.Shape.Edges)
        beside = 30 + 40 + 10 * turn * 2
        assert abs(sum(edge.Length for edge in sketch.Shape.Edges) - (length - beside)) < 1e-4 * length
    for chosen in ([lines[0]], []):
        try:
            macro.plane_through(chosen)
            raise AssertionError('a plane of nothing')
        except ValueError as error:
            assert 'select' in str(error)


def main():
    curves_path = sys.argv[2]
    with open(curves_path) as file:
        fits = [(curve, fit) for curve in json.load(file)['curves'] for fit in curve['fits']]
    for scale in (1, 25.4):
        features = macro.import_file(curves_path, FreeCAD.newDocument('curves'), scale)
        check_edges(features, fits, scale)
    check_sketch()
    try:
        macro.import_file(sys.argv[1], FreeCAD.newDocument('none'))
        raise AssertionError('read a file that is none')
    except ValueError as error:
        assert 'is broken' in str(error), error
    print(json.dumps({feature.Name: len(feature.Shape.Edges) for feature in features}))


main()
