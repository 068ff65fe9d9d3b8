#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens one file of a run with a reader that knows nothing of this project.

  read_file.py json <file> <schema>
  read_file.py dxf <file> <curves.json>
  read_file.py vtp|glb|svg <file>

Prints the number of curves that the reader saw; exits with 77 where the reader
is not installed, with 1 where it finds a fault.
"""
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
    allowed = {'LINE': 'LINES', 'ARC': 'ARCS', 'CIRCLE': 'CIRCLES', 'ELLIPSE': 'ELLIPSES', 'SPLINE': 'SPLINES'}
    assert all(allowed[e.dxftype()] == e.dxf.layer for e in entities)
    with open(curves) as file:
        fits = [fit for curve in json.load(file)['curves'] for fit in curve['fits']]
    for entity, fit in zip(entities, fits):
        assert entity.dxftype() == fit['kind'].upper()
        for point, name in zip(ends_of(entity), ('start', 'end')):
            if not fit['closed']:
                assert max(abs(a - b) for a, b in zip(point, fit[name])) < 1e-3 * fit['length'] + fit['sigma'], (fit, point)
    return len(entities)


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
    count = 0
    while not blocks.IsDoneWithTraversal():
        count += blocks.GetCurrentDataObject().GetNumberOfPoints() > 0
        blocks.GoToNextItem()
    return count


def read_svg(path):
    import xml.etree.ElementTree as ElementTree
    paths = ElementTree.parse(path).getroot().findall('{http://www.w3.org/2000/svg}path')
    assert all(path.get('class') == 'curve' for path in paths)
    return len(paths)


def main():
    readers = {'json': read_json, 'dxf': read_dxf, 'vtp': read_vtp, 'glb': read_glb, 'svg': read_svg}
    try:
        print(readers[sys.argv[1]](*sys.argv[2:]))
    except ImportError as error:
        print(error, file=sys.stderr)
        return SKIP
    return 0


if __name__ == '__main__':
    sys.exit(main())
