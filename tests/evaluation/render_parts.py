#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Models mechanical parts and writes workspaces with their exact edges.

usage: render_parts.py FOLDER [--parts NAME,...] [--views 50] [--size 800]

Writes FOLDER/NAME/images, sparse/0 (a model without points) and gt.txt: x y z
tx ty tz curve_id views_seen views_edge, a row every 0.002 along each edge whose
faces meet at more than 15 degrees on at least half of it. The longest side of a part is 1. A view has
an edge at a sample if the gradient across it is at its largest within half a
pixel of it, and at least 1 grey level per pixel.

Faces have fixed brightness, by their normals; pixels are means of 5 x 5. The
parts have what makes curves hard to tell: blends, round bodies, cylinders that
meet, thin steps, pockets, teeth.

Needs Debian's python3-gmsh, python3-vtk9, python3-scipy and python3-pil, and a
display, for instance that of xvfb-run.
"""
import argparse
import math
import pathlib

import gmsh
import numpy as np
import vtk
from PIL import Image
from scipy.ndimage import gaussian_filter, map_coordinates
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtk.util.numpy_support import vtk_to_numpy

SAMPLING = 5  # per pixel, each way
DISTANCE = 4.0  # of the cameras from the middle of the part
FOCAL = 1.39  # of the width of the image
STEP = 0.002
MIN_CREASE_DEG = 15
LIGHTS = [((.4, .5, .77), .28), ((-.7, .2, .4), .16), ((.1, -.8, -.35), .12),
          ((.5, -.2, -.8), .08)]  # direction, strength
AMBIENT = .42
OCC = gmsh.model.occ


# --- Parts ------------------------------------------------------------------

def fuse(first, *others):
    return OCC.fuse([(3, first)], [(3, o) for o in others])[0][0][1]


def cut(first, *others):
    return OCC.cut([(3, first)], [(3, o) for o in others])[0][0][1]


def prism(corners, height):
    points = [OCC.addPoint(x, y, 0) for x, y in corners]
    lines = [OCC.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
    face = OCC.addPlaneSurface([OCC.addCurveLoop(lines)])
    return next(t for d, t in OCC.extrude([(2, face)], 0, 0, height) if d == 3)


def rounded(body, radius, where=lambda x, y, z: True):
    """The body with a blend along the edges whose middle is `where`."""
    OCC.synchronize()
    faces = gmsh.model.getBoundary([(3, body)], oriented=False)
    edges = {e for _, e in gmsh.model.getBoundary(faces, combined=False,
                                                  oriented=False)}
    chosen = [e for e in sorted(edges) if where(*OCC.getCenterOfMass(1, e))]
    return OCC.fillet([body], chosen, [radius])[0][1]


def circle(count, radius, phase=0.0):
    return [(radius * math.cos(2 * math.pi * (i + phase) / count),
             radius * math.sin(2 * math.pi * (i + phase) / count))
            for i in range(count)]


def bolt():
    cone = OCC.addCone(0, 0, -.02, 0, 0, .2, .40, .235)
    head = OCC.intersect([(3, prism(circle(6, .26), .18))],
                         [(3, cone)])[0][0][1]
    fuse(head, OCC.addCylinder(0, 0, -.8, 0, 0, .8, .13),
         OCC.addCone(0, 0, -.84, 0, 0, .04, .09, .13))


def tee():
    outside = fuse(OCC.addCylinder(-.5, 0, 0, 1, 0, 0, .2),
                   OCC.addCylinder(0, 0, 0, 0, 0, .5, .15),
                   OCC.addCylinder(-.5, 0, 0, .08, 0, 0, .28),
                   OCC.addCylinder(.42, 0, 0, .08, 0, 0, .28),
                   OCC.addCylinder(0, 0, .44, 0, 0, .06, .22))
    cut(outside, OCC.addCylinder(-.6, 0, 0, 1.2, 0, 0, .14),
        OCC.addCylinder(0, 0, 0, 0, 0, .6, .1))


def soapbox():
    cut(rounded(OCC.addBox(0, 0, 0, 1, .6, .35), .08),
        OCC.addBox(.25, .15, .2, .5, .3, .3))


def dome():
    body = fuse(OCC.addBox(-.5, -.5, 0, 1, 1, .1),
                OCC.addSphere(0, 0, .1, .35))
    cut(body, OCC.addBox(-.05, -.6, .25, .1, 1.2, .5),
        OCC.addBox(-1, -1, -1, 2, 2, 1))


def shaft():
    body = fuse(OCC.addCylinder(0, 0, 0, .3, 0, 0, .12),
                OCC.addCylinder(.3, 0, 0, .35, 0, 0, .18),
                OCC.addCylinder(.65, 0, 0, .35, 0, 0, .1))
    cut(body, OCC.addBox(.38, -.03, .12, .2, .06, .2),
        OCC.addCylinder(.9, 0, -.3, 0, 0, .6, .03))


def bracket():
    angle = fuse(OCC.addBox(0, 0, 0, .9, .5, .1), OCC.addBox(0, 0, 0, .1, .5, .7))
    rib = prism([(.1, .1), (.5, .1), (.1, .5)], .06)
    OCC.rotate([(3, rib)], 0, 0, 0, 1, 0, 0, math.pi / 2)
    OCC.translate([(3, rib)], 0, .28, 0)
    holes = [OCC.addCylinder(-.1, .25, .55, .4, 0, 0, .08)]
    for y in (.12, .38):
        holes += [OCC.addCylinder(.7, y, -.1, 0, 0, .4, .05),
                  OCC.addCone(.7, y, .05, 0, 0, .051, .05, .09)]
    cut(fuse(angle, rib), *holes)


def gear():
    outline = []
    for tooth in range(16):
        for radius, phase in ((.42, -.3), (.5, -.16), (.5, .16), (.42, .3)):
            turn = 2 * math.pi * (tooth + phase) / 16
            outline.append((radius * math.cos(turn), radius * math.sin(turn)))
    body = fuse(prism(outline, .15), OCC.addCylinder(0, 0, 0, 0, 0, .25, .18))
    cut(body, OCC.addCylinder(0, 0, -.1, 0, 0, .5, .09),
        OCC.addBox(-.025, 0, -.1, .05, .12, .5))


def enclosure():
    outside = rounded(OCC.addBox(0, 0, 0, 1, .7, .4), .06,
                      lambda x, y, z: .05 < z < .35)
    inside = rounded(OCC.addBox(.03, .03, .03, .94, .64, .5), .04,
                     lambda x, y, z: .1 < z < .4)
    places = [(x, y) for x in (.12, .88) for y in (.12, .58)]
    body = fuse(cut(outside, inside),
                *(OCC.addBox(x, .02, .02, .02, .66, .2) for x in (.3, .66)),
                *(OCC.addCylinder(x, y, .01, 0, 0, .25, .05)
                  for x, y in places))
    cut(body, OCC.addBox(.4, -.1, .12, .2, .3, .1),
        *(OCC.addCylinder(x, y, .1, 0, 0, .5, .02) for x, y in places))


def knob():
    grip = rounded(OCC.addCylinder(0, 0, 0, 0, 0, .4, .45), .1,
                   lambda x, y, z: z > .2)
    body = fuse(grip, OCC.addCylinder(0, 0, -.25, 0, 0, .26, .2))
    cut(body, OCC.addCylinder(0, 0, -.3, 0, 0, .35, .08),
        *(OCC.addCylinder(x, y, -.1, 0, 0, .7, .09) for x, y in circle(8, .5)))


def wedge():
    lid = OCC.addBox(-1, -1, .2, 3, 3, 1)
    OCC.rotate([(3, lid)], .5, .3, .3, .3, 1, .2, .5)
    body = cut(prism([(0, 0), (1, 0), (.75, .5), (.2, .65)], .5), lid)
    cut(body, OCC.addCylinder(.45, .25, -.3, .2, .1, .9, .08))


def plates():
    stack = [OCC.addBox(.08 * i, .06 * i, .03 * i - .001 * (i > 0),
                        1 - .16 * i, .8 - .12 * i, .03 + .001 * (i > 0))
             for i in range(5)]
    cut(fuse(*stack), *(OCC.addCylinder(.5 + .1 * i, .4, -.1, 0, 0, .5, .02)
                        for i in (-1, 0, 1)))


def ring():
    cut(OCC.addTorus(0, 0, 0, .38, .12), OCC.addBox(0, -.05, -.5, 1, .1, 1))


def bottle():
    corners = [OCC.addPoint(x, 0, z) for x, z in (
        (0, 0), (.18, 0), (.22, .06), (.22, .45), (.17, .6), (.08, .7),
        (.07, .8), (.09, .83), (.09, .9), (0, .9))]
    outline = [OCC.addLine(*corners[:2]), OCC.addSpline(corners[1:7])]
    outline += [OCC.addLine(corners[i], corners[(i + 1) % 10])
                for i in range(6, 10)]
    half = OCC.addPlaneSurface([OCC.addCurveLoop(outline)])
    turned = OCC.revolve([(2, half)], 0, 0, 0, 0, 0, 1, 2 * math.pi)
    cut(next(tag for dim, tag in turned if dim == 3),
        OCC.addCylinder(0, 0, .5, 0, 0, .6, .05))


def mouse():
    body = OCC.addSphere(0, 0, 0, .5)
    OCC.dilate([(3, body)], 0, 0, 0, 1, .6, .45)
    cut(body, OCC.addBox(-1, -1, -1, 2, 2, .95),
        OCC.addBox(.1, -.02, -.1, 1, .04, 1),
        OCC.addCylinder(-.2, 0, 0, 0, 0, 1, .1))


def pebble():
    cut(rounded(prism([(0, 0), (1, 0), (.9, .6), (.1, .7)], .4), .12),
        OCC.addCylinder(.3, .3, .25, 0, 0, .3, .12),
        OCC.addCylinder(.7, .3, -.2, 0, 0, 1, .08))


def handle():
    fuse(OCC.addCylinder(-.5, 0, 0, 1, 0, 0, .07),
         *(OCC.addCylinder(x, 0, -.3, 0, 0, .3, .06) for x in (-.4, .4)),
         *(OCC.addBox(x, -.12, -.35, .2, .24, .06) for x in (-.5, .3)),
         *(OCC.addSphere(x, 0, 0, .07) for x in (-.5, .5)))


def cup():
    cut(rounded(OCC.addCone(0, 0, 0, 0, 0, .7, .25, .4), .05,
                lambda x, y, z: z < .3),
        OCC.addCone(0, 0, .05, 0, 0, .7, .2, .36))


PARTS = [bolt, tee, soapbox, dome, shaft, bracket, gear, enclosure, knob, wedge,
         plates, ring, bottle, mouse, pebble, handle, cup]


# --- The part as triangles and as edges -------------------------------------

def directions(rows):
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


class Part:
    """Triangles with normals, and samples of the edges; longest side 1, around
    the origin."""

    def __init__(self, build):
        gmsh.model.add(build.__name__)
        build()
        OCC.synchronize()
        box = np.array(gmsh.model.getBoundingBox(-1, -1)).reshape(2, 3)
        self._middle = box.mean(0)
        self._side = (box[1] - box[0]).max()
        self.points, self.normals, self.triangles = self._mesh()
        self.samples = self._edge_samples()
        gmsh.model.remove()

    def _scaled(self, flat):
        return (np.array(flat).reshape(-1, 3) - self._middle) / self._side

    def _mesh(self):
        gmsh.option.setNumber('Mesh.MeshSizeMax', self._side / 15)
        gmsh.option.setNumber('Mesh.MeshSizeMin', self._side / 800)
        gmsh.option.setNumber('Mesh.MeshSizeFromCurvature', 160)
        gmsh.model.mesh.generate(2)
        points, normals, triangles, count = [], [], [], 0
        for _, face in gmsh.model.getEntities(2):
            tags, xyz, uv = gmsh.model.mesh.getNodes(
                2, face, includeBoundary=True, returnParametricCoord=True)
            index = {tag: count + i for i, tag in enumerate(tags)}
            triangles += [index[t] for t in
                          gmsh.model.mesh.getElementsByType(2, face)[1]]
            points.append(self._scaled(xyz))
            normals.append(
                np.array(gmsh.model.getNormal(face, uv)).reshape(-1, 3))
            count += len(tags)
        points = np.concatenate(points)
        triangles = np.array(triangles).reshape(-1, 3)
        starts = np.cumsum([0] + [len(n) for n in normals])
        for k, rows in enumerate(normals):
            if not self._points_outwards(rows, starts[k], points, triangles):
                rows *= -1
        return points, np.concatenate(normals), triangles

    @staticmethod
    def _points_outwards(normals, start, points, triangles):
        """Whether a ray from the largest triangle of a face, along the normals
        there, meets the part an even number of times."""
        a, b, c = (points[triangles[:, i]] for i in range(3))
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        mine = ((triangles >= start) & (triangles < start + len(normals))).all(1)
        largest = triangles[np.argmax(np.where(mine, areas, 0))]
        normal = directions(normals[largest - start].mean(0)[None])[0]
        origin = points[largest].mean(0) + 1e-4 * normal
        # Slanted, so that it meets no edge.
        ray = directions((normal + np.array([.0371, .0521, .0769]))[None])[0]
        h = np.cross(ray, c - a)
        det = (h * (b - a)).sum(1)
        det[np.abs(det) < 1e-18] = 1e-18
        u = ((origin - a) * h).sum(1) / det
        q = np.cross(origin - a, b - a)
        v = q @ ray / det
        t = (q * (c - a)).sum(1) / det
        hits = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
        return hits.sum() % 2 == 0

    def _edge_samples(self):
        """Rows of position, tangent, id of the curve."""
        faces_of = {}
        for _, face in gmsh.model.getEntities(2):
            for _, edge in gmsh.model.getBoundary([(2, face)], oriented=False):
                faces_of.setdefault(edge, []).append(face)
        rows = []
        for edge, faces in sorted(faces_of.items()):
            if len(faces) != 2:
                continue  # the seam of a closed face
            low, high = (b[0] for b in gmsh.model.getParametrizationBounds(1, edge))
            dense = np.linspace(low, high, 2001)
            polyline = self._scaled(gmsh.model.getValue(1, edge, dense))
            along = np.concatenate(
                [[0], np.cumsum(np.linalg.norm(np.diff(polyline, axis=0), axis=1))])
            count = max(2, round(along[-1] / STEP) + 1)
            at = np.interp(np.linspace(0, along[-1], count), along, dense)
            normals = [np.array(gmsh.model.getNormal(
                face, gmsh.model.reparametrizeOnSurface(1, edge, at, face)))
                .reshape(-1, 3) for face in faces]
            cosines = np.abs((normals[0] * normals[1]).sum(1))
            sharp = cosines < math.cos(math.radians(MIN_CREASE_DEG))
            if along[-1] < STEP or sharp.mean() < .5:
                continue
            tangents = directions(
                np.array(gmsh.model.getDerivative(1, edge, at)).reshape(-1, 3))
            positions = self._scaled(gmsh.model.getValue(1, edge, at))
            rows.append(np.column_stack(
                [positions, tangents, np.full(count, len(rows))])[sharp])
        return np.concatenate(rows)


# --- Cameras and pictures ---------------------------------------------------

def poses(count):
    """Rotations and translations, cam_from_world, of cameras all around, in
    directions that are random, but the same for each part."""
    generator = np.random.default_rng(1)
    result = []
    for outwards in directions(generator.standard_normal((count, 3))):
        right = directions(np.cross([0, 0, 1], outwards)[None])[0]
        rotation = np.stack([right, np.cross(right, outwards), -outwards])
        result.append((rotation, DISTANCE * rotation @ -outwards))
    return result


class Renderer:
    """Brightness and depth of a part, `SAMPLING` times per pixel."""

    def __init__(self, part, size):
        self._size = size
        self._points = part.points
        brightness = np.full(len(part.points), AMBIENT)
        for direction, strength in LIGHTS:
            light = np.array(direction) / np.linalg.norm(direction)
            brightness += strength * np.clip(part.normals @ light, 0, None)
        mesh = vtk.vtkPolyData()
        points = vtk.vtkPoints()
        points.SetData(numpy_to_vtk(part.points, deep=1))
        mesh.SetPoints(points)
        cells = vtk.vtkCellArray()
        rows = np.column_stack([np.full(len(part.triangles), 3), part.triangles])
        cells.SetCells(len(rows), numpy_to_vtkIdTypeArray(
            rows.ravel().astype(np.int64), deep=1))
        mesh.SetPolys(cells)
        mesh.GetPointData().SetScalars(numpy_to_vtk(
            np.repeat(brightness[:, None], 3, 1).astype(np.float32), deep=1))
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(mesh)
        mapper.SetColorModeToDirectScalars()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().LightingOff()
        self._scene = vtk.vtkRenderer()
        self._scene.SetBackground(1, 1, 1)
        self._scene.AddActor(actor)
        self._window = vtk.vtkRenderWindow()
        self._window.SetOffScreenRendering(1)
        self._window.SetMultiSamples(0)
        self._window.SetSize(size * SAMPLING, size * SAMPLING)
        self._window.AddRenderer(self._scene)

    def render(self, rotation, translation):
        depths = (self._points @ rotation.T + translation)[:, 2]
        near, far = .98 * depths.min(), 1.02 * depths.max()
        camera = self._scene.GetActiveCamera()
        center = -rotation.T @ translation
        camera.SetPosition(*center)
        camera.SetFocalPoint(*(center + rotation[2]))
        camera.SetViewUp(*-rotation[1])
        camera.SetClippingRange(near, far)
        projection = vtk.vtkMatrix4x4()
        for (row, column), value in {
                (0, 0): 2 * FOCAL, (1, 1): 2 * FOCAL, (3, 2): -1, (3, 3): 0,
                (2, 2): -(far + near) / (far - near),
                (2, 3): -2 * far * near / (far - near)}.items():
            projection.SetElement(row, column, value)
        camera.SetExplicitProjectionTransformMatrix(projection)
        camera.SetUseExplicitProjectionTransformMatrix(True)
        self._window.Render()
        side = self._size * SAMPLING
        colors, buffer = vtk.vtkUnsignedCharArray(), vtk.vtkFloatArray()
        self._window.GetPixelData(0, 0, side - 1, side - 1, 0, colors, 0)
        self._window.GetZbufferData(0, 0, side - 1, side - 1, buffer)
        fine = vtk_to_numpy(colors).reshape(side, side, 3)[::-1, :, 0]
        grey = fine.reshape(self._size, SAMPLING, self._size, SAMPLING).mean((1, 3))
        z = 2 * vtk_to_numpy(buffer).reshape(side, side)[::-1] - 1
        return grey, 2 * far * near / (far + near - z * (far - near))


def look(samples, rotation, translation, grey, depth):
    """Of each sample, whether nothing hides it, and whether it is an edge."""
    size = len(grey)
    in_camera = samples[:, :3] @ rotation.T + translation
    pixels = FOCAL * size * in_camera[:, :2] / in_camera[:, 2:] + size / 2
    seen = np.zeros(len(samples), bool)
    for shift in np.ndindex(5, 5):
        x, y = np.clip((pixels * SAMPLING + shift - 2).astype(int), 0,
                       size * SAMPLING - 1).T
        seen |= depth[y, x] > in_camera[:, 2] - .0025
    ahead = samples[:, 3:6] @ rotation.T
    tangents = ahead[:, :2] * in_camera[:, 2:] - ahead[:, 2:] * in_camera[:, :2]
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True) + 1e-12
    across = np.stack([-tangents[:, 1], tangents[:, 0]], 1)
    gradient = [gaussian_filter(grey, 1, order=order) for order in ((0, 1), (1, 0))]

    def at(image, offset):
        x, y = (pixels - .5 + offset * across).T
        return map_coordinates(image, [y, x], order=1, mode='nearest')

    offsets = np.linspace(-1.5, 1.5, 13)
    profile = np.array([at(np.hypot(*gradient), o) for o in offsets])
    is_peak = np.abs(offsets[profile.argmax(0)]) < .6
    slope = np.abs(at(gradient[0], 0) * across[:, 0]
                   + at(gradient[1], 0) * across[:, 1])
    return seen, seen & is_peak & (slope > 1)


# --- Files ------------------------------------------------------------------

def quaternion(rotation):
    """w, x, y, z."""
    values, vectors = np.linalg.eigh(np.array([
        [rotation[0, 0] - rotation[1, 1] - rotation[2, 2], 0, 0, 0],
        [rotation[0, 1] + rotation[1, 0],
         rotation[1, 1] - rotation[0, 0] - rotation[2, 2], 0, 0],
        [rotation[0, 2] + rotation[2, 0], rotation[1, 2] + rotation[2, 1],
         rotation[2, 2] - rotation[0, 0] - rotation[1, 1], 0],
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0],
         rotation[1, 0] - rotation[0, 1], np.trace(rotation)]]))
    x, y, z, w = vectors[:, values.argmax()]
    return w, x, y, z


def write_model(folder, size, views):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'cameras.txt').write_text(
        f'1 PINHOLE {size} {size} {FOCAL * size} {FOCAL * size} '
        f'{size / 2} {size / 2}\n')
    (folder / 'points3D.txt').write_text('')
    with open(folder / 'images.txt', 'w') as file:
        for i, (rotation, translation) in enumerate(views):
            numbers = ' '.join(
                f'{v:.17g}' for v in (*quaternion(rotation), *translation))
            file.write(f'{i + 1} {numbers} 1 {i:03d}.png\n\n')


def write_workspace(folder, build, num_views, size):
    part = Part(build)
    views = poses(num_views)
    write_model(folder / 'sparse' / '0', size, views)
    (folder / 'images').mkdir(exist_ok=True)
    renderer = Renderer(part, size)
    counts = np.zeros((len(part.samples), 2), int)
    for i, pose in enumerate(views):
        grey, depth = renderer.render(*pose)
        rgb = np.repeat(np.rint(grey)[:, :, None].astype(np.uint8), 3, 2)
        Image.fromarray(rgb).save(folder / 'images' / f'{i:03d}.png')
        counts += np.stack(look(part.samples, *pose, grey, depth), 1)
    np.savetxt(folder / 'gt.txt', np.column_stack([part.samples, counts]),
               fmt=['%.7f'] * 6 + ['%d'] * 3)
    print(f'{folder}: {len(part.triangles)} triangles, {len(counts)} samples, '
          f'{100 * (counts[:, 1] >= 4).mean():.0f} % of them in four views')


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('--parts', default='')
    parser.add_argument('--views', type=int, default=50)
    parser.add_argument('--size', type=int, default=800)
    arguments = parser.parse_args()
    chosen = [name for name in arguments.parts.split(',') if name]
    unknown = set(chosen) - {build.__name__ for build in PARTS}
    if unknown:
        parser.error('there is no part ' + ', '.join(sorted(unknown)))
    gmsh.initialize()
    gmsh.option.setNumber('General.Terminal', 0)
    for build in PARTS:
        if not chosen or build.__name__ in chosen:
            write_workspace(arguments.folder / build.__name__, build,
                            arguments.views, arguments.size)
    gmsh.finalize()


if __name__ == '__main__':
    main()
