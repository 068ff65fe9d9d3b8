#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens one file of a run with a reader that knows nothing of this project.

  read_file.py json <file> <schema>
  read_file.py dxf|step <file> <curves.json>
  read_file.py vtp|glb|svg <file>

Prints the number of curves that the reader saw; exits with 77 where the reader
is not installed, with 1 where it finds a fault.
"""
import math
import os
import sys

SKIP = 77


def read_json(path, schema):
    import json
    import jsonschema
    with open(path) as file, open(schema) as schema_file:
        document = json.load(file)
        jsonschema.validate(document, json.load(schema_file))
    for node, value in enumerate(document['nodes']):
        for end in value['ends']:
            fit = document['curves'][end['curve']]['fits'][end['fit']]
            assert fit[end['at'] + '_node'] == node
            assert fit[end['at']] == value['position']
    sizes = {image['image_id']: image for image in document['images']}
    residuals = []
    for curve in document['curves']:
        for sample in curve['samples']:
            for image_id, x, y, residual in sample['support']:
                assert 0 <= x <= sizes[image_id]['width']
                assert 0 <= y <= sizes[image_id]['height']
                residuals.append(abs(residual))
    residuals.sort()
    assert residuals[len(residuals) * 9 // 10] < 0.5  # ends carried on to corners are farther off
    return len(document['curves'])


def ends_of(entity):
    """The first and last point of a DXF entity."""
    if entity.dxftype() == 'LINE':
        return entity.dxf.start, entity.dxf.end
    if entity.dxftype() == 'SPLINE':
        return entity.control_points[0], entity.control_points[-1]
    if entity.dxftype() == 'CIRCLE':
        return ()
    return entity.start_point, entity.end_point


def read_dxf(path, curves):
    import json
    import ezdxf
    document = ezdxf.readfile(path)
    auditor = document.audit()
    for fault in auditor.errors + auditor.fixes:
        print(fault.message, file=sys.stderr)
    assert not auditor.errors and not auditor.fixes
    assert document.dxfversion == 'AC1015'
    entities = list(document.modelspace())
    layers = {'unknown': 'UNKNOWN', 'crease': 'CREASES', 'boundary': 'BOUNDARIES', 'marking': 'MARKINGS',
              'occluding_contour': 'OCCLUDING_CONTOURS'}
    with open(curves) as file:
        fits = [fit for curve in json.load(file)['curves'] for fit in curve['fits']]
    for entity, fit in zip(entities, fits):
        assert entity.dxftype() == fit['kind'].upper()
        assert entity.dxf.layer == layers[fit['curve_kind']]
        for point, name in zip(ends_of(entity), ('start', 'end')):
            if not fit['closed']:
                assert max(abs(a - b) for a, b in zip(point, fit[name])) < 1e-3 * fit['length'] + fit['sigma'], (fit, point)
    return len(entities)


def freecad():
    """FreeCAD's modules, from where Debian keeps them."""
    sys.path.append('/usr/lib/freecad-python3/lib')
    import FreeCAD
    import Import
    return FreeCAD, Import


def ends_of_fit(fit):
    """Its first and last point; of arcs, which end beside their nodes by a small part of sigma, by their angles."""
    if 'center' not in fit:
        return fit['start'], fit['end']
    return [[c + math.cos(angle) * a + math.sin(angle) * b for c, a, b in zip(fit['center'], fit['major'], fit['minor'])]
            for angle in (fit['start_angle'], fit['end_angle'])]


def kind_of(edge):
    kind = type(edge.Curve).__name__.lower()
    return {'circle': 'circle' if edge.Closed else 'arc', 'bsplinecurve': 'spline'}.get(kind, kind)


def read_step(path, curves):
    import json
    FreeCAD, Import = freecad()
    document = FreeCAD.newDocument('seen')
    Import.insert(path, document.Name, merge=True)
    edges = [edge for thing in document.Objects for edge in thing.Shape.Edges]
    with open(curves) as file:
        fits = [fit for curve in json.load(file)['curves'] for fit in curve['fits']]
    for kind in ('line', 'arc', 'circle', 'ellipse', 'spline'):
        # In the order of the curves.
        seen = [edge for edge in edges if kind_of(edge) == kind]
        written = [fit for fit in fits if fit['kind'] == kind]
        assert len(seen) == len(written), (kind, len(seen), len(written))
        for edge, fit in zip(seen, written):
            assert abs(edge.Length - fit['length']) < 1e-5 * fit['length'], (edge.Length, fit)
            if 'radius' in fit:
                assert abs(edge.Curve.Radius - fit['radius']) < 1e-9 * fit['radius'], (edge.Curve.Radius, fit)
            if fit['closed']:
                continue
            # The vertices of an edge lie in any order.
            ends = [tuple(vertex.Point) for vertex in edge.Vertexes]
            for point in ends_of_fit(fit):
                off = min(max(abs(a - b) for a, b in zip(end, point)) for end in ends)
                assert off < 1e-6 * fit['length'], (ends, fit)
    assert len(edges) == len(fits)
    return len(edges)


def read_vtp(path):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    lines = reader.GetOutput()
    names = [lines.GetPointData().GetArrayName(i) for i in range(lines.GetPointData().GetNumberOfArrays())]
    assert names == ['tangent', 'sigma', 'support', 'confidence'], names
    assert lines.GetCellData().GetArray('curve_id').GetNumberOfTuples() == lines.GetNumberOfLines()
    return lines.GetNumberOfLines()


def read_glb(path):
    from vtkmodules.vtkIOGeometry import vtkGLTFReader
    from vtkmodules.vtkCommonDataModel import vtkDataObjectTreeIterator
    reader = vtkGLTFReader()
    reader.SetFileName(path)
    reader.Update()
    blocks = vtkDataObjectTreeIterator()
    blocks.SetDataSet(reader.GetOutput())
    blocks.InitTraversal()
    count, seen = 0, []
    while not blocks.IsDoneWithTraversal():
        curve = blocks.GetCurrentDataObject()
        count += curve.GetNumberOfPoints() > 0
        seen += [curve.GetPoint(i) for i in range(curve.GetNumberOfPoints())]
        blocks.GoToNextItem()
    with open(os.path.join(os.path.dirname(path), 'curves.obj')) as obj:
        rows = [line.split() for line in obj if line.startswith('v ')]
    # z up becomes y up.
    turned = [(float(x), float(z), -float(y)) for _, x, y, z, *_ in rows]
    for axis in range(3):
        for end in (min, max):
            a, b = (end(p[axis] for p in points) for points in (seen, turned))
            assert abs(a - b) < 1e-4, (axis, a, b)
    return count


def read_svg(path):
    import xml.etree.ElementTree as ElementTree
    groups = ElementTree.parse(path).getroot().findall('{http://www.w3.org/2000/svg}g')
    assert all(group.get('class') == 'curve' for group in groups)
    assert all(path.get('class') in ('hidden', 'shown') for group in groups for path in group)
    return len(groups)


def main():
    readers = {'json': read_json, 'dxf': read_dxf, 'step': read_step, 'vtp': read_vtp, 'glb': read_glb,
               'svg': read_svg}
    try:
        print(readers[sys.argv[1]](*sys.argv[2:]))
    except ImportError as error:
        print(error, file=sys.stderr)
        return SKIP
    return 0


if __name__ == '__main__':
    sys.exit(main())
