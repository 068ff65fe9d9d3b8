#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes workspaces as people and programs make them, and says what happens.

  workspaces.py <colmap_curvix>         prints the lists of docs/workspaces.md
  workspaces.py <colmap_curvix> <page>  exits with 1 where the page has others

Each is a change of one small synthetic workspace. Exits with 77 without
Pillow and NumPy.
"""
import difflib
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from PIL import Image
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(77)

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
ROWS = []


def row(what, how):
    """Registers a function that changes a Workspace and may return arguments of the run."""
    def add(change):
        ROWS.append((what, how, change))
        return change
    return add


def run(*arguments, cwd=None):
    done = subprocess.run([PROGRAM, *map(os.fspath, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=cwd, check=False)
    return done.returncode, done.stdout.decode('utf8', 'replace')


class Workspace:
    """<path>/images and <path>/sparse/0, the model in memory, too."""

    def __init__(self, path):
        self.path, self.images, self.model = path, path / 'images', path / 'sparse/0'
        self.cameras, self.views, self.points = [], [], (self.model / 'points3D.bin').read_bytes()
        with open(self.model / 'cameras.bin', 'rb') as file:
            for _ in range(struct.unpack('<Q', file.read(8))[0]):
                camera = struct.unpack('<IiQQ', file.read(24))
                assert camera[1] == 1  # PINHOLE
                self.cameras.append(['PINHOLE', camera[0], *camera[2:], *struct.unpack('<4d', file.read(32))])
        with open(self.model / 'images.bin', 'rb') as file:
            for _ in range(struct.unpack('<Q', file.read(8))[0]):
                view = struct.unpack('<I7dI', file.read(64))
                name = b''.join(iter(lambda: file.read(1), b'\0')).decode()
                seen = file.read(24 * struct.unpack('<Q', file.read(8))[0])
                self.views.append([*view, name, [struct.unpack_from('<ddq', seen, i) for i in range(0, len(seen), 24)]])

    def files(self):
        return sorted(self.images.iterdir())

    def read_points(self):
        """(id, x, y, z, red, green, blue, error) and track of each point."""
        at = 8
        for _ in range(struct.unpack_from('<Q', self.points)[0]):
            *point, length = struct.unpack_from('<QdddBBBdQ', self.points, at)
            at += 51
            yield point, struct.unpack_from(f'<{2 * length}I', self.points, at)
            at += 8 * length

    def write_text(self, folder='sparse/0', end='\n', head='', points=True, between=' '):
        folder = self.path / folder
        shutil.rmtree(self.model)
        folder.mkdir(parents=True, exist_ok=True)
        lines = [between.join(map(str, [camera[1], camera[0], *camera[2:]])) for camera in self.cameras]
        (folder / 'cameras.txt').write_bytes((head + end.join(lines) + end).encode())
        lines = []
        for view in self.views:
            lines.append(between.join(map(str, view[:10])))
            lines.append(between.join(f'{x} {y} {point}' for x, y, point in view[10]) if points else '')
        (folder / 'images.txt').write_bytes((head + end.join(lines) + end).encode('utf8', 'surrogateescape'))
        lines = [between.join(map(str, [*point, *track])) for point, track in self.read_points()] if points else []
        (folder / 'points3D.txt').write_bytes((head + end.join(lines) + end).encode())

    def rename(self, new_name, file_name=None):
        """Names of the model by `new_name`, of the files by `file_name`."""
        for view in self.views:
            old, new = view[9], new_name(view[9])
            file = os.fsencode(self.images) + b'/' + os.fsencode((file_name or new_name)(old))
            os.makedirs(os.path.dirname(file), exist_ok=True)
            os.rename(self.images / old, file)
            view[9] = new
        self.write_text()

    def convert(self, ending, save):
        """Images by save(image, path)."""
        for file in self.files():
            image = Image.open(file)
            image.load()
            file.unlink()
            save(image, file.with_suffix(ending))
        for view in self.views:
            view[9] = str(pathlib.Path(view[9]).with_suffix(ending))
        self.write_text()


# Where things are.

@row('`sparse/0` and `images`', 'from `colmap automatic_reconstructor`')
def _(w):
    pass


@row('model in `sparse/`', 'from `colmap mapper`')
def _(w):
    for file in list(w.model.iterdir()):
        file.rename(w.path / 'sparse' / file.name)
    w.model.rmdir()


@row('model beside `images/`', '')
def _(w):
    for file in list(w.model.iterdir()):
        file.rename(w.path / file.name)
    shutil.rmtree(w.path / 'sparse')


@row('`dense/0`', 'from `colmap image_undistorter`')
def _(w):
    dense = w.path / 'dense/0'
    dense.mkdir(parents=True)
    w.images.rename(dense / 'images')
    w.model.rename(dense / 'sparse')
    shutil.rmtree(w.path / 'sparse')


@row('several models', '`sparse/0` with three images, `sparse/1` with all')
def _(w):
    shutil.copytree(w.model, w.path / 'sparse/1')
    w.views = w.views[:3]
    w.write_text(points=False)


@row('`rigs.bin` and `frames.bin`', 'as COLMAP 4.2 writes them: a rig per camera, a frame per image; `images.bin` has the poses')
def _(w):
    rigs = [struct.pack('<IIiI', camera[1], 1, 0, camera[1]) for camera in w.cameras]
    frames = [struct.pack('<II7dIiIQ', view[0], view[8], *view[1:8], 1, 0, view[8], view[0]) for view in w.views]
    for name, records in (('rigs.bin', rigs), ('frames.bin', frames)):
        (w.model / name).write_bytes(struct.pack('<Q', len(records)) + b''.join(records))


@row('database and other files beside the model and in `images/`', '')
def _(w):
    for name in ('database.db', 'images/Thumbs.db', 'images/.DS_Store', 'sparse/0/project.ini'):
        (w.path / name).write_bytes(b'')


@row('5000 more images in `images/`', '')
def _(w):
    for i in range(5000):
        (w.images / f'{i:05}.jpg').write_bytes(b'')


@row('an image is missing', '')
def _(w):
    (w.images / 'view_003.png').unlink()


@row('all but two images are missing', '')
def _(w):
    for file in w.files()[2:]:
        file.unlink()


@row('no folder `images/`', '')
def _(w):
    shutil.rmtree(w.images)


@row('images elsewhere', '`--image_path`')
def _(w):
    w.images.rename(w.path / 'photos')
    return ['--image_path', w.path / 'photos']


@row('relative path', '`--workspace_path .`')
def _(w):
    return ['--workspace_path', '.']


@row('model elsewhere', '`--input_path`')
def _(w):
    w.model.rename(w.path / 'model')
    return ['--input_path', w.path / 'model']


@row('path with blanks and UTF-8', '')
def _(w):
    link = w.path / 'mein Schloß'
    link.symlink_to(w.path)
    return ['--workspace_path', link]


@row('`images` is a link', '')
def _(w):
    w.images.rename(w.path / 'photos')
    w.images.symlink_to('photos')


@row('images are links', '')
def _(w):
    shutil.copytree(w.images, w.path / 'photos')
    for file in w.files():
        file.unlink()
        file.symlink_to(w.path / 'photos' / file.name)


@row('images are hard links', '')
def _(w):
    shutil.copytree(w.images, w.path / 'photos')
    for file in w.files():
        file.unlink()
        os.link(w.path / 'photos' / file.name, file)


@row('`sparse/0` is a link into the workspace', '')
def _(w):
    w.model.rename(w.path / 'model')
    w.model.symlink_to('../model')


# Names.

@row('images in nested folders', '`camera/left/view_000.png`')
def _(w):
    w.rename(lambda name: 'camera/left/' + name)


@row('endings in capitals', '`view_000.PNG`')
def _(w):
    w.rename(lambda name: name.replace('.png', '.PNG'))


@row('`.png` in the model, `.PNG` on the disk', '')
def _(w):
    w.rename(lambda name: name, lambda name: name.replace('.png', '.PNG'))


@row('names with spaces', '')
def _(w):
    w.rename(lambda name: 'my photo ' + name)


@row('names in UTF-8', '`Straße_ö_写真_view_000.png`')
def _(w):
    w.rename(lambda name: 'Straße_ö_写真_' + name)


@row('names in Latin-1', '')
def _(w):
    w.rename(lambda name: 'Stra\udcdfe_' + name)


@row('backslashes for folders', '`camera\\view_000.png` in the model')
def _(w):
    w.rename(lambda name: 'camera\\' + name, lambda name: 'camera/' + name)


@row('names that leave the folder', '`../images/view_000.png`')
def _(w):
    w.rename(lambda name: '../images/' + name, lambda name: name)


@row('names with a missing folder', '`images/view_000.png` in the model')
def _(w):
    w.rename(lambda name: 'images/' + name, lambda name: name)


# Models.

@row('text model', 'from `colmap model_converter`')
def _(w):
    w.write_text()


@row('text and binary model in one folder', '')
def _(w):
    copy = w.path / 'copy'
    shutil.copytree(w.model, copy)
    w.write_text()
    for file in copy.iterdir():
        file.rename(w.model / file.name)


@row('text model with CR LF', '')
def _(w):
    w.write_text(end='\r\n')


@row('text model with byte order marks', '')
def _(w):
    w.write_text(head='\ufeff')


@row('text model with tabs', '')
def _(w):
    w.write_text(between='\t')


# What the exports of other programs have of their own.

@row('text model as RealityScan exports it', 'exponents of three digits, names with spaces, blanks at the ends of lines')
def _(w):
    def real(number):
        mantissa, exponent = f'{number:.16e}'.split('e')
        return mantissa + ('' if int(exponent) == 0 else f'e{exponent[0]}{int(exponent[1:]):03}')

    w.rename(lambda name: 'A (' + name.replace('view_', '').replace('.', ').'))
    (w.model / 'images.txt').write_text('# Image list with two lines of data per image:\n' + ''.join(
        ' '.join([str(view[0]), *map(real, view[1:8]), str(view[8]), view[9]]) + '\n' +
        ''.join(f'{real(x)} {real(y)} {point} ' for x, y, point in view[10]) + '\n' for view in w.views))


@row('text model as OpenMVG exports it', 'ids from 0, six digits, blank lines, tracks of features that are not listed and of images without a pose')
def _(w):
    shutil.rmtree(w.model)
    w.model.mkdir()
    (w.model / 'cameras.txt').write_text('# Number of cameras: X\n' + ''.join(
        ' '.join([str(camera[1] - 1), camera[0], *(f'{number:.6g}' for number in camera[2:])]) + '\n\n' for camera in w.cameras))
    (w.model / 'images.txt').write_text('# Number of images: X, mean observations per image: Y\n' + ''.join(
        ' '.join([str(view[0] - 1), *(f'{number:.6g}' for number in view[1:8]), str(view[8] - 1), view[9], '\n']) +
        ''.join(f'{x:.6g} {y:.6g} {point - 1} ' for x, y, point in view[10] if point >= 0) + '\n' for view in w.views))
    (w.model / 'points3D.txt').write_text('# Number of points: X, mean track length: Y\n' + ''.join(
        ' '.join([str(point[0] - 1), *(f'{number:.6g}' for number in point[1:4]), *map(str, point[4:7]), '0',
                  *(f'{view - 1} {feature + 1000}' for view, feature in zip(track[::2], track[1::2])), '99 7']) + '\n'
        for point, track in w.read_points()))


@row('binary model as Metashape exports it', 'ids from 0, points without errors')
def _(w):
    with open(w.model / 'cameras.bin', 'wb') as file:
        file.write(struct.pack('<Q', len(w.cameras)))
        for camera in w.cameras:
            file.write(struct.pack('<IiQQ4d', camera[1] - 1, 1, *camera[2:]))
    with open(w.model / 'images.bin', 'wb') as file:
        file.write(struct.pack('<Q', len(w.views)))
        for view in w.views:
            file.write(struct.pack('<I7dI', view[0] - 1, *view[1:8], view[8] - 1) + view[9].encode() + b'\0')
            file.write(struct.pack('<Q', len(view[10])))
            for x, y, point in view[10]:
                file.write(struct.pack('<ddq', x, y, max(point - 1, -1)))
    with open(w.model / 'points3D.bin', 'wb') as file:
        points = list(w.read_points())
        file.write(struct.pack('<Q', len(points)))
        for point, track in points:
            file.write(struct.pack('<QdddBBBdQ', point[0] - 1, *point[1:7], 0, len(track) // 2))
            for view, feature in zip(track[::2], track[1::2]):
                file.write(struct.pack('<II', view - 1, feature))


@row('text model with comments and blank lines first', 'no points')
def _(w):
    w.write_text(head='# Exported\n#\n\n', points=False)


@row('text model without points', '')
def _(w):
    w.write_text(points=False)


@row('`images.txt` with one line per image', '')
def _(w):
    w.write_text(points=False)
    file = w.model / 'images.txt'
    file.write_text(''.join(line + '\n' for line in file.read_text().splitlines() if line))


@row('no `points3D` file', '')
def _(w):
    (w.model / 'points3D.bin').unlink()


@row('a camera per image', '')
def _(w):
    camera = w.cameras[0]
    w.cameras = [[camera[0], view[0], *camera[2:]] for view in w.views]
    for view in w.views:
        view[8] = view[0]
    w.write_text()


@row('a camera without images', '')
def _(w):
    w.cameras.append(['SIMPLE_RADIAL', 77, 3000, 2000, 2500.0, 1500.0, 1000.0, 0.1])
    w.write_text()


@row('`OPENCV` with zero distortion', '')
def _(w):
    for camera in w.cameras:
        camera[0] = 'OPENCV'
        camera += [0.0] * 4
    w.write_text()


@row('spherical images', '`EQUIRECTANGULAR`')
def _(w):
    w.cameras[0] = ['EQUIRECTANGULAR', *w.cameras[0][1:4]]
    w.write_text()


@row('cameras of half the width of the images', '')
def _(w):
    w.cameras[0][2] //= 2
    w.write_text()


@row('half of `images.bin`', '')
def _(w):
    file = w.model / 'images.bin'
    file.write_bytes(file.read_bytes()[:file.stat().st_size // 2])


# Images.

@row('images of twice the size', '')
def _(w):
    w.convert('.png', lambda image, path: image.resize((2 * image.width, 2 * image.height), Image.BICUBIC).save(path))


@row('JPEG', '')
def _(w):
    w.convert('.jpg', lambda image, path: image.convert('RGB').save(path, quality=95))


@row('progressive JPEG', '')
def _(w):
    w.convert('.jpg', lambda image, path: image.convert('RGB').save(path, progressive=True))


@row('grey JPEG', '')
def _(w):
    w.convert('.jpg', lambda image, path: image.convert('L').save(path, quality=95))


@row('CMYK JPEG', '')
def _(w):
    w.convert('.jpg', lambda image, path: image.convert('RGB').convert('CMYK').save(path, quality=95))


def save_turned(image, path):
    exif = Image.Exif()
    exif[0x0112] = 6
    image.convert('RGB').save(path, quality=95, exif=exif)


def save_deep(image, path):
    Image.fromarray(np.asarray(image.convert('L')).astype(np.uint16) * 257).save(path)


@row('JPEG with EXIF orientation 6', 'not rotated, as in COLMAP')
def _(w):
    w.convert('.jpg', save_turned)


@row('16-bit PNG', 'grey')
def _(w):
    w.convert('.png', save_deep)


@row('16-bit TIFF', 'grey')
def _(w):
    w.convert('.tif', save_deep)


@row('PNG with an opaque alpha channel', 'others: over black')
def _(w):
    w.convert('.png', lambda image, path: image.convert('RGBA').save(path))


@row('BMP', '')
def _(w):
    w.convert('.bmp', lambda image, path: image.save(path))


@row('PGM', '')
def _(w):
    w.convert('.pgm', lambda image, path: image.convert('L').save(path))


@row('WebP', 'lossless')
def _(w):
    w.convert('.webp', lambda image, path: image.convert('RGB').save(path, lossless=True))


@row('HEIF', '')
def _(w):
    w.convert('.heic', lambda _, path: path.write_bytes(b'\0\0\0\x18ftypheic\0\0\0\0mif1heic' + bytes(100)))


@row('raw images', 'DNG')
def _(w):
    w.convert('.dng', lambda _, path: path.write_bytes(b'II*\0\x08\0\0\0' + bytes(100)))


@row('half of `view_003.png`', '')
def _(w):
    file = w.images / 'view_003.png'
    file.write_bytes(file.read_bytes()[:file.stat().st_size // 2])


def make_masks(w, shrink_x=1, shrink_y=None):
    (w.path / 'masks').mkdir()
    for file in w.files():
        width, height = Image.open(file).size
        Image.new('L', (width // shrink_x, height // (shrink_y or shrink_x)), 255).save(w.path / 'masks' / (file.name + '.png'))
    return ['--mask_path', w.path / 'masks']


@row('white masks', '`masks/view_000.png.png`, `--mask_path`')
def _(w):
    return make_masks(w)


@row('a mask is missing', '')
def _(w):
    arguments = make_masks(w)
    (w.path / 'masks/view_003.png.png').unlink()
    return arguments


@row('masks of half the size', '')
def _(w):
    return make_masks(w, 2)


@row('masks of another shape', '')
def _(w):
    return make_masks(w, 1, 2)


# Models of other programs.

@row('nerfstudio\'s `transforms.json`', 'by `import --format nerf`')
def _(w):
    _, _, width, height, fx, fy, cx, cy = w.cameras[0]
    frames = []
    for image_id, qw, qx, qy, qz, *t, _, name, _ in w.views:
        a, b = np.array([qx, qy, qz]), qw
        cross = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
        turn = (np.eye(3) * (b * b - a @ a) + 2 * np.outer(a, a) + 2 * b * cross).T  # world from camera
        pose = np.eye(4)
        pose[:3] = np.c_[turn * [1, -1, -1], -turn @ t]
        frames.append({'file_path': 'images/' + name, 'transform_matrix': pose.tolist(), 'colmap_im_id': image_id})
    text = json.dumps({'w': width, 'h': height, 'fl_x': fx, 'fl_y': fy, 'cx': cx, 'cy': cy, 'k1': 0.0, 'k2': 0.0, 'p1': 0.0,
                       'p2': 0.0, 'camera_model': 'OPENCV', 'frames': frames,
                       'applied_transform': [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0]]})
    (w.path / 'transforms.json').write_text(text)
    code, said = run('import', '--format', 'nerf', '--input_path', w.path / 'transforms.json', '--workspace_path', w.path / 'made')
    assert code == 0, said
    return ['--workspace_path', w.path / 'made']


def happens(base, change, folder, expected):
    """The result, one of RESULTS, and what the program says."""
    shutil.copytree(base, folder, symlinks=True)
    arguments = change(Workspace(folder)) or []
    if '--workspace_path' not in arguments:
        arguments = ['--workspace_path', folder, *arguments]
    code, said = run(*arguments, '--refiner', 'none', '--refine_poses_with_curves', '0', '--output_formats', 'ply',
                     '--output_path', folder / 'results', '--num_threads', '1', cwd=folder)
    is_same = code == 0 and (not expected or (folder / 'results/curves.ply').read_bytes() == expected)
    # Sentences end with a full stop; lines of stages with a time.
    notes = [line for line in said.split('\nWritten to')[0].splitlines() if re.match(r'(ERROR: )?[A-Z/0-9].*[.;]$', line)]
    note = re.sub(r'\(missing: [^)]*\)', '(missing: ...)', ' '.join(notes).replace(str(folder), 'W').replace('ERROR: ', ''))
    return 'The same curves' if is_same else 'Curves' if code == 0 else 'Errors', note


RESULTS = ['The same curves', 'Curves', 'Errors']


def lists(scratch):
    """The lists of the page: a heading per result, a line per workspace."""
    base = scratch / 'base'
    run('synthesize', '--workspace_path', base, '--solid', 'block', '--num_views', '12', '--width', '120', '--height', '120',
        '--points_per_view', '20')
    items = {result: [] for result in RESULTS}
    expected = b''
    for number, (what, how, change) in enumerate(ROWS):
        folder = scratch / str(number)
        result, note = happens(base, change, folder, expected)
        expected = expected or (folder / 'results/curves.ply').read_bytes()
        items[result].append(f'- {what}' + (f' ({how})' if how else '') + (f': `{note}`' if note else ''))
        shutil.rmtree(folder)
    return [line for result in RESULTS for line in ('## ' + result, *items[result])]


def main():
    with tempfile.TemporaryDirectory(prefix='curvix-') as scratch:
        lines = lists(pathlib.Path(scratch).resolve())
    if len(sys.argv) < 3:
        print('\n'.join(lines))
        return 0
    page = pathlib.Path(sys.argv[2]).read_text('utf8').splitlines()
    page = [line for line in page if line.startswith(('## ', '- '))]
    print('\n'.join(difflib.unified_diff(page, lines, 'page', 'this run', n=0, lineterm='')))
    return page != lines


sys.exit(main())
