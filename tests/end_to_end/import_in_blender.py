# SPDX-License-Identifier: BSD-3-Clause
"""Imports curves.json by the add-on, and checks what Blender has then.

  blender --background --factory-startup --python-exit-code 1 --python import_in_blender.py -- \\
      <add-on> <curves.json> <text model> <images>

Prints, as JSON after "SEEN ", the number of primitives by kind of curve and type,
of cameras and of photographs, and the median distance, in pixels, of samples seen
by the cameras from the edges that support them.
"""
import collections
import importlib.util
import json
import pathlib
import sys
import tempfile

import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

addon_path, curves_path, text_model, images = sys.argv[sys.argv.index('--') + 1:]
spec = importlib.util.spec_from_file_location('curvix_blender', addon_path)
addon = importlib.util.module_from_spec(spec)
sys.dont_write_bytecode = True
spec.loader.exec_module(addon)
addon.register()


def emptied():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def things(kind):
    return [thing for thing in bpy.data.objects if thing.type == kind]


def count_splines():
    """By name of the object, which is the kind of curve and the type."""
    return {thing.name: len(thing.data.splines) for thing in things('CURVE')}


def pose_of(camera):
    data = camera.data
    return [list(row) for row in camera.matrix_world], data.lens, data.shift_x, data.shift_y


def pixels_off(document, offset=(0, 0, 0)):
    scene, off = bpy.context.scene, []
    bpy.context.view_layer.update()
    names = {image['image_id']: image for image in document['images']}
    for curve in document['curves']:
        for sample in curve['samples'][::10]:
            for image_id, x, y, residual in sample['support']:
                image = names[image_id]
                position = [x - by for x, by in zip(sample['position'], offset)]  # not in Blender's seven digits
                seen = world_to_camera_view(scene, bpy.data.objects[image['name']], Vector(position))
                at = Vector((seen.x * image['width'], (1 - seen.y) * image['height']))
                off.append((at - Vector((x, y))).length)
    return sorted(off)[len(off) // 2]


with open(curves_path) as file:
    document = json.load(file)
fits = [fit for curve in document['curves'] for fit in curve['fits']]

emptied()
assert bpy.ops.import_curve.curvix(filepath=curves_path) == {'FINISHED'}
cameras = things('CAMERA')
seen = {'splines': count_splines(), 'cameras': len(cameras),
        'photographs': sum(len(thing.data.background_images) for thing in cameras), 'pixels_off': pixels_off(document)}
poses = {thing.name: pose_of(thing) for thing in cameras}

emptied()
assert bpy.ops.import_curve.curvix(filepath=curves_path, model_path=text_model, image_path=images) == {'FINISHED'}
assert {thing.name: pose_of(thing) for thing in things('CAMERA')} == poses

# In millimetres, turned and far away, as `align` writes it; the model is as before.
aligned = {**document, 'alignment': {'world_from_model': {
    'scale': 1000, 'rotation': [0.5 ** 0.5, 0.5 ** 0.5, 0, 0], 'translation': [5e5, 4.8e6, 200]}}, 'curves': [
        {**curve, 'fits': [], 'samples': [
            {**sample, 'position': [5e5 + 1000 * x, 4.8e6 - 1000 * z, 200 + 1000 * y]}
            for sample in curve['samples'] for x, y, z in [sample['position']]]} for curve in document['curves']]}
aligned_path = pathlib.Path(tempfile.mkdtemp()) / 'curves.json'
aligned_path.write_text(json.dumps(aligned))
emptied()
assert bpy.ops.import_curve.curvix(filepath=str(aligned_path), model_path=text_model, image_path=images) == {'FINISHED'}
off = pixels_off(aligned, bpy.data.collections['curves']['offset'])
assert off < seen['pixels_off'] + 0.1, off
for thing in things('CAMERA'):
    assert thing.data.clip_end > 2000, thing.data.clip_end

emptied()
assert bpy.ops.import_curve.curvix(filepath=curves_path, cameras=False, separate=True) == {'FINISHED'}
assert not things('CAMERA')
assert len(things('CURVE')) == len(fits)
by_name = {f'curve {curve["id"]} {fit["kind"]} {index}': fit
           for curve in document['curves'] for index, fit in enumerate(curve['fits'])}
for thing in things('CURVE'):
    fit, spline = by_name[thing.name], thing.data.splines[0]
    assert abs(spline.calc_length() - fit['length']) < 2e-3 * fit['length'], (thing.name, spline.calc_length(), fit)
    first = spline.points[0].co.xyz if fit['kind'] == 'line' else spline.bezier_points[0].co
    if not fit['closed']:
        assert (first - Vector(fit['start'])).length < 1e-3 * fit['length'] + fit['sigma'], thing.name

try:
    bpy.ops.import_curve.curvix(filepath=addon_path)
    raise AssertionError('read a file that is none')
except RuntimeError as error:
    assert 'is broken' in str(error), error
print('SEEN ' + json.dumps(seen))
