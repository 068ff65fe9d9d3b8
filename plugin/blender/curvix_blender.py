# SPDX-License-Identifier: BSD-3-Clause
"""A Blender add-on: File > Import > Curves from photographs (curves.json).

Imports the curves of colmap_curvix, and the cameras of their COLMAP model with
the photographs behind them. For Blender 3.4 and later. docs/blender_and_freecad.md.
"""
import json
import math
import pathlib
import struct

import bpy
import numpy as np
from bpy.props import BoolProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper
from mathutils import Matrix

bl_info = {
    'name': 'Curves from photographs',
    'author': 'The colmap_curvix authors',
    'version': (0, 1, 0),
    'blender': (3, 4, 0),
    'location': 'File > Import > Curves from photographs (curves.json)',
    'description': 'Lines, arcs and splines of colmap_curvix, and the cameras of their COLMAP model',
    'category': 'Import-Export',
}

# The colours of viewer.html.
COLORS = {'line': 0x2563eb, 'arc': 0x059669, 'circle': 0xdc2626, 'ellipse': 0xc026d3, 'spline': 0xea8a00}


# Curves, as pieces of cubic Bezier curves: arrays of n x 4 x 3 points, where
# the last point of a piece is the first of the next.

def line_pieces(fit):
    start, end = np.array(fit['start']), np.array(fit['end'])
    return np.array([[start, start + (end - start) / 3, end - (end - start) / 3, end]])


def conic_pieces(fit):
    """At most an eighth of a turn each: within 5e-6 of the radius."""
    center, major, minor = (np.array(fit[name]) for name in ('center', 'major', 'minor'))
    sweep = fit['end_angle'] - fit['start_angle']
    count = max(1, math.ceil(sweep / (math.pi / 4) - 1e-9))
    angles = fit['start_angle'] + sweep / count * np.arange(count + 1)[:, None]
    points = center + np.cos(angles) * major + np.sin(angles) * minor
    handles = 4 / 3 * math.tan(sweep / count / 4) * (np.cos(angles) * minor - np.sin(angles) * major)
    return np.stack([points[:-1], points[:-1] + handles[:-1], points[1:] - handles[1:], points[1:]], axis=1)


def spline_pieces(fit):
    """Exact: the values of the polar form of each span at its ends."""
    knots, points = fit['knots'], np.array(fit['control_points'])

    def polar(span, *args):
        values = list(points[span - 3:span + 1])
        for level, arg in enumerate(args, 1):
            for j in range(3, level - 1, -1):
                i = span - 3 + j
                share = (arg - knots[i]) / (knots[i + 4 - level] - knots[i])
                values[j] = (1 - share) * values[j - 1] + share * values[j]
        return values[3]

    pieces = []
    for span in range(3, len(points)):
        a, b = knots[span], knots[span + 1]
        if a < b:
            pieces.append([polar(span, a, a, a), polar(span, a, a, b), polar(span, a, b, b), polar(span, b, b, b)])
    return np.array(pieces)


PIECES = {'line': line_pieces, 'arc': conic_pieces, 'circle': conic_pieces, 'ellipse': conic_pieces,
          'spline': spline_pieces}


def add_spline(data, fit, offset):
    pieces = PIECES[fit['kind']](fit) - offset
    if fit['kind'] == 'line':
        spline = data.splines.new('POLY')
        spline.points.add(1)
        spline.points.foreach_set('co', np.c_[pieces[0, [0, 3]], [1, 1]].ravel())
        return
    points = np.concatenate([pieces[:, 0], pieces[-1:, 3]])
    left = np.concatenate([2 * points[:1] - pieces[:1, 1], pieces[:, 2]])
    right = np.concatenate([pieces[:, 1], 2 * points[-1:] - pieces[-1:, 2]])
    if fit['closed']:  # the last point is the first
        left[0] = left[-1]
        points, left, right = points[:-1], left[:-1], right[:-1]
    spline = data.splines.new('BEZIER')
    spline.use_cyclic_u = fit['closed']
    spline.bezier_points.add(len(points) - 1)
    for point in spline.bezier_points:
        point.handle_left_type = point.handle_right_type = 'FREE'
    spline.bezier_points.foreach_set('co', points.ravel())
    spline.bezier_points.foreach_set('handle_left', left.ravel())
    spline.bezier_points.foreach_set('handle_right', right.ravel())


def material_of(kind):
    name = 'curvix ' + kind
    material = bpy.data.materials.get(name)
    if material is None:
        material = bpy.data.materials.new(name)
        color = [((COLORS[kind] >> shift & 255) / 255) ** 2.2 for shift in (16, 8, 0)]
        material.diffuse_color = (*color, 1)
        material.use_nodes = True  # renders in its colour, in any light
        nodes = material.node_tree.nodes
        nodes.clear()
        emission, output = nodes.new('ShaderNodeEmission'), nodes.new('ShaderNodeOutputMaterial')
        emission.inputs['Color'].default_value = (*color, 1)
        material.node_tree.links.new(emission.outputs[0], output.inputs['Surface'])
    return material


def read_curves(path):
    with open(path, encoding='utf8') as file:
        try:
            document = json.load(file)
        except ValueError as error:
            raise ValueError(f'{path} is broken: {error}; write it again.') from None
    if not isinstance(document, dict) or document.get('format') != 'curvix curves':
        raise ValueError(f'{path} is not a curves.json of colmap_curvix; choose that file of a run.')
    if document.get('version') != 1:
        raise ValueError(f'{path} has version {document.get("version")}; this add-on reads 1: take its newer one.')
    return document


def extent_of(curves):
    """The centre of the curves, and how far they reach across, but for a few far ones."""
    points = np.array([sample['position'] for curve in curves for sample in curve['samples']] or [[0, 0, 0]])
    low, high = np.percentile(points, (5, 95), axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low)) or 1.0


def add_curves(curves, parent, offset, width, separate):
    """Objects in a collection per kind of curve: one per type, or per fit."""
    objects, collections = {}, {}
    for curve in curves:
        kind = curve.get('kind', 'unknown')
        if kind not in collections:
            collections[kind] = bpy.data.collections.new(kind)
            parent.children.link(collections[kind])
        for index, fit in enumerate(curve['fits']):
            name = f'curve {curve["id"]} {fit["kind"]} {index}' if separate else f'{kind} {fit["kind"]}s'
            if name not in objects:
                data = bpy.data.curves.new(name, 'CURVE')
                data.dimensions = '3D'
                data.bevel_depth = width / 2
                data.materials.append(material_of(fit['kind']))
                objects[name] = (bpy.data.objects.new(name, data), [])
                collections[kind].objects.link(objects[name][0])
            thing, ids = objects[name]
            add_spline(thing.data, fit, offset)
            ids.append(curve['id'])
            if separate:
                for key in ('length', 'radius', 'sigma'):
                    if key in fit:
                        thing[key] = fit[key]
    for thing, ids in objects.values():
        thing['curve_ids'] = ids  # one per spline


# COLMAP's cameras and images, as text or binary.

# In the order of COLMAP's ids: the name, the number of parameters, and whether
# the second one is another focal length.
CAMERA_MODELS = (
    ('SIMPLE_PINHOLE', 3, 0), ('PINHOLE', 4, 1), ('SIMPLE_RADIAL', 4, 0), ('RADIAL', 5, 0), ('OPENCV', 8, 1),
    ('OPENCV_FISHEYE', 8, 1), ('FULL_OPENCV', 12, 1), ('FOV', 5, 1), ('SIMPLE_RADIAL_FISHEYE', 4, 0),
    ('RADIAL_FISHEYE', 5, 0), ('THIN_PRISM_FISHEYE', 12, 1), ('RAD_TAN_THIN_PRISM_FISHEYE', 16, 1),
    ('SIMPLE_DIVISION', 4, 0), ('DIVISION', 5, 1), ('SIMPLE_FISHEYE', 3, 0), ('FISHEYE', 4, 1), ('EUCM', 6, 1))
TWO_FOCALS = {name: two for name, _, two in CAMERA_MODELS}


def read_binary_model(folder):
    cameras, images = {}, []
    with open(folder / 'cameras.bin', 'rb') as file:
        for _ in range(struct.unpack('<Q', file.read(8))[0]):
            camera_id, model, width, height = struct.unpack('<IiQQ', file.read(24))
            name, count, _ = CAMERA_MODELS[model]
            cameras[camera_id] = (name, width, height, struct.unpack(f'<{count}d', file.read(8 * count)))
    with open(folder / 'images.bin', 'rb') as file:
        for _ in range(struct.unpack('<Q', file.read(8))[0]):
            values = struct.unpack('<I7dI', file.read(64))
            name = b''.join(iter(lambda: file.read(1), b'\0')).decode('utf8', 'surrogateescape')
            file.seek(24 * struct.unpack('<Q', file.read(8))[0], 1)
            images.append((values[1:5], values[5:8], values[8], name))
    return cameras, images


def read_text_model(folder):
    cameras, images = {}, []
    for line in (folder / 'cameras.txt').read_text('utf-8-sig').splitlines():
        if line.strip() and not line.startswith('#'):
            camera_id, name, width, height, *params = line.split()
            cameras[int(camera_id)] = (name, int(width), int(height), tuple(map(float, params)))
    lines = iter((folder / 'images.txt').read_text('utf-8-sig', 'surrogateescape').split('\n'))
    for line in lines:
        if line.strip() and not line.startswith('#'):
            words = line.split(maxsplit=9)
            numbers = tuple(map(float, words[1:8]))
            images.append((numbers[:4], numbers[4:], int(words[8]), words[9].rstrip()))
            next(lines, None)  # the 2D points of the image, perhaps none
    return cameras, images


def holds_model(folder):
    return folder is not None and any((folder / name).is_file() for name in ('images.bin', 'images.txt'))


def read_model(folder):
    """Cameras by id: model, width, height, parameters; images: q, t, camera id, name."""
    try:
        is_binary = (folder / 'images.bin').is_file()
        cameras, images = read_binary_model(folder) if is_binary else read_text_model(folder)
        for image in images:
            TWO_FOCALS[cameras[image[2]][0]]  # known
        return cameras, images
    except (struct.error, IndexError, KeyError, OSError, ValueError) as error:
        raise ValueError(f'The COLMAP model in {folder} cannot be read: {error}.') from None


def path_of(image_path, name):
    """The photograph of an image; None if it is not there. Backslashes are folders where no file is called so."""
    if image_path.name:
        for path in (image_path / name, image_path / name.replace('\\', '/')):
            if path.is_file():
                return path
    return None


def shown(name):
    """A name that Blender takes: bytes that are not UTF-8 are replaced."""
    return name.encode('utf8', 'replace').decode()


def rotation_of(q):
    """In double precision, unlike Blender's own."""
    w, x, y, z = np.array(q) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def distortion_of(model_name, params, two):
    """As Blender's Brown model: k1, k2, p1, p2. None: a lens that it does not have."""
    given = params[3 + two:]
    if model_name in ('SIMPLE_PINHOLE', 'PINHOLE'):
        return 0, 0, 0, 0
    if model_name in ('SIMPLE_RADIAL', 'RADIAL', 'OPENCV'):
        return (*given, 0, 0, 0)[:4]
    return None


def add_photograph(data, path, camera, frame):
    """Behind the camera `data`, undistorted. Returns whether its lens is one that Blender has."""
    model_name, width, height, params = camera
    two = TWO_FOCALS[model_name]
    distortion = distortion_of(model_name, params, two)
    background = data.background_images.new()
    if distortion and any(distortion):
        clip = bpy.data.movieclips.load(str(path))
        clip.frame_start = bpy.context.scene.frame_current
        lens = clip.tracking.camera
        lens.sensor_width, lens.pixel_aspect = 36, 1
        lens.units, lens.focal_length_pixels = 'PIXELS', params[0]
        center = 'principal' if hasattr(lens, 'principal') else 'principal_point_pixels'  # until Blender 3.4, from 3.5
        setattr(lens, center, (params[1 + two], height - params[2 + two]))
        lens.distortion_model = 'BROWN'
        lens.brown_k1, lens.brown_k2, p1, p2 = distortion
        lens.brown_p1, lens.brown_p2 = p2, -p1  # in its order, with y up
        background.source, background.clip = 'MOVIE_CLIP', clip
        background.clip_user.use_render_undistorted = True
    else:
        background.image = bpy.data.images.load(str(path), check_existing=True)
    # As wide as the frame, whatever its height.
    background.frame_method = 'CROP' if height * frame[0] > width * frame[1] else 'FIT'
    background.alpha = 1
    data.show_background_images = True
    return distortion is not None


def add_cameras(model, image_path, parent, alignment, offset, center, size):
    """Returns how many cameras there are, how many photographs of them, and how many of these are distorted."""
    cameras, images = model
    images = sorted(images, key=lambda image: image[3])
    collection = bpy.data.collections.new('cameras')
    parent.children.link(collection)
    scale, turn, shift = 1.0, np.eye(3), np.zeros(3)
    if alignment:  # the model is not in the frame of the curves
        scale, shift = alignment['scale'], np.array(alignment['translation'])
        turn = rotation_of(alignment['rotation'])
    scene = bpy.context.scene
    if images:
        first = next((image for image in images if path_of(image_path, image[3])), images[0])
        scene.render.resolution_x, scene.render.resolution_y = cameras[first[2]][1:3]
    frame = scene.render.resolution_x, scene.render.resolution_y
    num_photographs = num_distorted = 0
    for image in images:
        q, t, camera_id, name = image
        model_name, width, height, params = cameras[camera_id]
        two = TWO_FOCALS[model_name]
        data = bpy.data.cameras.new(shown(name))
        data.sensor_fit, data.sensor_width = 'HORIZONTAL', 36
        data.lens = params[0] / width * 36
        data.shift_x = 0.5 - params[1 + two] / width
        data.shift_y = (params[2 + two] - height / 2) / width
        data.display_size = size / 15
        model_from_cam = rotation_of(q).T
        position = scale * turn @ -(model_from_cam @ t) + shift
        reach = float(np.linalg.norm(position - center)) + size
        data.clip_start, data.clip_end = reach / 1000, reach * 10
        matrix = np.eye(4)
        matrix[:3, :3] = turn @ model_from_cam @ np.diag((1, -1, -1))
        matrix[:3, 3] = position - offset
        thing = bpy.data.objects.new(shown(name), data)
        thing.matrix_world = Matrix(matrix.tolist())
        collection.objects.link(thing)
        if image is first:
            scene.camera = thing
        photograph = path_of(image_path, name)
        if photograph:
            num_photographs += 1
            num_distorted += not add_photograph(data, photograph, cameras[camera_id], frame)
    return len(images), num_photographs, num_distorted


def show_all(size):
    """Lets the 3D views of the window see as far as curves reach."""
    for area in bpy.context.screen.areas if bpy.context.screen else ():
        if area.type == 'VIEW_3D':
            view = area.spaces.active
            view.clip_start, view.clip_end = min(view.clip_start, size / 1000), max(view.clip_end, 100 * size)


def paths_of_run(path):
    """The COLMAP model and the images of a run, as report.json beside curves.json names them."""
    report = path.with_name('report.json')
    if not report.is_file():
        return None, pathlib.Path()
    with open(report, encoding='utf8') as file:
        source = json.load(file)['input']
    refined = path.with_name('sparse')
    model = refined if refined.is_dir() else path.parent / source['model_path']
    return model, path.parent / source['image_path']


def plural(count, noun):
    return f'{count} {noun}' + ('' if count == 1 else 's')


def import_file(path, cameras=True, model_path='', image_path='', separate=False, thickness=0.2):
    """Returns the new collection and a sentence. OSError, ValueError: with what is wrong."""
    path = pathlib.Path(path).resolve()
    document = read_curves(path)
    curves = document['curves']
    # All is read before anything is added.
    model, images = paths_of_run(path) if cameras else (None, pathlib.Path())
    model = pathlib.Path(model_path) if model_path else model
    images = pathlib.Path(image_path) if image_path else images
    colmap = read_model(model) if cameras and holds_model(model) else None
    center, size = extent_of(curves)
    # Blender has seven digits: a world far from its origin is moved there.
    offset = center if np.abs(center).max() > 50 * size else np.zeros(3)
    collection = bpy.data.collections.new(path.stem)
    bpy.context.scene.collection.children.link(collection)
    collection['offset'] = offset.tolist()
    show_all(size)
    add_curves(curves, collection, offset, size * thickness / 100, separate)
    said = plural(len(curves), 'curve')
    if offset.any():
        said += f', moved by {(-offset).tolist()}'
    if cameras and colmap is None:
        said += '; no cameras: name the folder of the COLMAP model'
    elif cameras:
        alignment = document.get('alignment', {}).get('world_from_model')
        count, found, distorted = add_cameras(colmap, images, collection, alignment, offset, center, size)
        said += f', {plural(count, "camera")}, {plural(found, "photograph")}'
        if found < count:
            are = 'is' if count - found == 1 else 'are'
            said += f'; {plural(count - found, "image")} {are} not in "{images}": name their folder'
        if distorted:
            have = 'has' if distorted == 1 else 'have'
            said += f'; {plural(distorted, "photograph")} {have} a lens that Blender does not have, curves are beside them'
    return collection, said + '.'


class ImportCurvix(bpy.types.Operator, ImportHelper):
    """Import the curves.json of colmap_curvix"""
    bl_idname = 'import_curve.curvix'
    bl_label = 'Import curves.json'
    bl_options = {'REGISTER', 'UNDO'}
    filename_ext = '.json'
    filter_glob: StringProperty(default='*.json', options={'HIDDEN'})
    cameras: BoolProperty(name='Cameras', default=True, description='The cameras of the COLMAP model, with their images')
    model_path: StringProperty(name='Model', description='Folder of the COLMAP model; empty: that of the run')
    image_path: StringProperty(name='Images', description='Folder of the images; empty: that of the run')
    separate: BoolProperty(name='Separate objects', description='One object per fit, instead of one per type')
    thickness: FloatProperty(name='Thickness, %', default=0.2, min=0, soft_max=2,
                             description='Diameter of the curves, in percent of their extent; 0: they do not render')

    def execute(self, _):
        try:
            _, said = import_file(self.filepath, self.cameras, self.model_path, self.image_path, self.separate,
                                  self.thickness)
        except (OSError, ValueError) as error:
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}
        except (KeyError, TypeError, IndexError) as error:
            self.report({'ERROR'}, f'{self.filepath}, or report.json beside it, is broken: {error!r}; write it again.')
            return {'CANCELLED'}
        self.report({'INFO'}, said)
        return {'FINISHED'}


def menu_entry(self, _):
    self.layout.operator(ImportCurvix.bl_idname, text='Curves from photographs (curves.json)')


def register():
    bpy.utils.register_class(ImportCurvix)
    bpy.types.TOPBAR_MT_file_import.append(menu_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(menu_entry)
    bpy.utils.unregister_class(ImportCurvix)


if __name__ == '__main__':
    register()
