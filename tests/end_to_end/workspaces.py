#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes workspaces as people and programs make them, and says what happens.

  workspaces.py <colmap_curvix>         prints the table of docs/workspaces.md
  workspaces.py <colmap_curvix> <page>  exits with 1 where the page has another one

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
        lines, at = [], 8
        for _ in range(struct.unpack_from('<Q', self.points)[0] if points else 0):
            *point, length = struct.unpack_from('<QdddBBBdQ', self.points, at)
            at += 51
            track = struct.unpack_from(f'<{2 * length}I', self.points, at)
            at += 8 * length
            lines.append(between.join(map(str, [*point, *track])))
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

@row('`sparse/0` and `images`', 'as `colmap automatic_reconstructor`')
def _(w):
    pass


@row('model in `sparse/`', 'as `colmap mapper` by hand')
def _(w):
    for file in list(w.model.iterdir()):
        file.rename(w.path / 'sparse' / file.name)
    w.model.rmdir()


@row('the workspace is the model', 'files beside `images/`')
def _(w):
    for file in list(w.model.iterdir()):
        file.rename(w.path / file.name)
    shutil.rmtree(w.path / 'sparse')


@row('`dense/0` of undistorted images', 'as `colmap image_undistorter`')
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


@row('files of rigs and frames', '`rigs.bin` and `frames.bin`, empty, beside `images.bin`, which has the poses')
def _(w):
    for name in ('rigs.bin', 'frames.bin'):
        (w.model / name).write_bytes(struct.pack('<Q', 0))


@row('database, project file and other files', 'beside the model and in `images/`')
def _(w):
    for name in ('database.db', 'images/Thumbs.db', 'images/.DS_Store', 'sparse/0/project.ini'):
        (w.path / name).write_bytes(b'')


@row('5000 images that are not in the model', 'in `images/`')
def _(w):
    for i in range(5000):
        (w.images / f'{i:05}.jpg').write_bytes(b'')


@row('one image is not there', 'deleted')
def _(w):
    (w.images / 'view_003.png').unlink()


@row('all but two are not there', 'deleted')
def _(w):
    for file in w.files()[2:]:
        file.unlink()


@row('no images', '`images/` deleted')
def _(w):
    shutil.rmtree(w.images)


@row('images elsewhere', '`--image_path`')
def _(w):
    w.images.rename(w.path / 'photos')
    return ['--image_path', w.path / 'photos']


@row('relative paths', 'run in the workspace with `--workspace_path .`')
def _(w):
    return ['--workspace_path', '.']


@row('model elsewhere', '`--input_path`')
def _(w):
    w.model.rename(w.path / 'model')
    return ['--input_path', w.path / 'model']


@row('a path with blanks and letters of UTF-8', 'a link to the workspace')
def _(w):
    link = w.path / 'mein Schloß'
    link.symlink_to(w.path)
    return ['--workspace_path', link]


@row('`images` is a link', 'to a folder')
def _(w):
    w.images.rename(w.path / 'photos')
    w.images.symlink_to('photos')


@row('images are links', 'each')
def _(w):
    shutil.copytree(w.images, w.path / 'photos')
    for file in w.files():
        file.unlink()
        file.symlink_to(w.path / 'photos' / file.name)


@row('images are hard links', 'each')
def _(w):
    shutil.copytree(w.images, w.path / 'photos')
    for file in w.files():
        file.unlink()
        os.link(w.path / 'photos' / file.name, file)


@row('`sparse/0` is a link', 'to a folder of the workspace')
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


@row('endings in other capitals than the model has', '`.png` in the model, `.PNG` on the disk')
def _(w):
    w.rename(lambda name: name, lambda name: name.replace('.png', '.PNG'))


@row('names with spaces', 'text model')
def _(w):
    w.rename(lambda name: 'my photo ' + name)


@row('names in UTF-8', '`Straße_ö_写真_view_000.png`')
def _(w):
    w.rename(lambda name: 'Straße_ö_写真_' + name)


@row('names in Latin-1', 'bytes that are no UTF-8')
def _(w):
    w.rename(lambda name: 'Stra\udcdfe_' + name)


@row('backslashes in names', '`camera\\view_000.png` in the model, folders on the disk')
def _(w):
    w.rename(lambda name: 'camera\\' + name, lambda name: 'camera/' + name)


@row('names that lead out of the folder', '`../images/view_000.png`')
def _(w):
    w.rename(lambda name: '../images/' + name, lambda name: name)


@row('names with a folder that is not there', '`images/view_000.png` in the model')
def _(w):
    w.rename(lambda name: 'images/' + name, lambda name: name)


# Models.

@row('text model', 'as `colmap model_converter`')
def _(w):
    w.write_text()


@row('text and binary model', 'both in `sparse/0`')
def _(w):
    copy = w.path / 'copy'
    shutil.copytree(w.model, copy)
    w.write_text()
    for file in copy.iterdir():
        file.rename(w.model / file.name)


@row('text model, Windows', 'lines end with CR LF')
def _(w):
    w.write_text(end='\r\n')


@row('text model, byte order mark', 'three bytes at the start of each file')
def _(w):
    w.write_text(head='\ufeff')


@row('text model, tabs', 'between the words')
def _(w):
    w.write_text(between='\t')


@row('text model, comments and blank lines first', 'no points')
def _(w):
    w.write_text(head='# Exported\n#\n\n', points=False)


@row('text model without points', 'every second line of `images.txt` is empty')
def _(w):
    w.write_text(points=False)


@row('text model without the empty lines', '`images.txt` has one line per image')
def _(w):
    w.write_text(points=False)
    file = w.model / 'images.txt'
    file.write_text(''.join(line + '\n' for line in file.read_text().splitlines() if line))


@row('no `points3D` file', 'deleted')
def _(w):
    (w.model / 'points3D.bin').unlink()


@row('a camera per image', 'as without `--single_camera`')
def _(w):
    camera = w.cameras[0]
    w.cameras = [[camera[0], view[0], *camera[2:]] for view in w.views]
    for view in w.views:
        view[8] = view[0]
    w.write_text()


@row('a camera that no image has', 'as of images that were not registered')
def _(w):
    w.cameras.append(['SIMPLE_RADIAL', 77, 3000, 2000, 2500.0, 1500.0, 1000.0, 0.1])
    w.write_text()


@row('`OPENCV` without distortion', 'four zeros')
def _(w):
    for camera in w.cameras:
        camera[0] = 'OPENCV'
        camera += [0.0] * 4
    w.write_text()


@row('spherical images', '`EQUIRECTANGULAR`')
def _(w):
    w.cameras[0] = ['EQUIRECTANGULAR', *w.cameras[0][1:4]]
    w.write_text()


@row('a size of another image', 'half of that of the images')
def _(w):
    w.cameras[0][2:] = [w.cameras[0][2] // 2, w.cameras[0][3] // 2, *(number / 2 for number in w.cameras[0][4:])]
    w.write_text()


@row('a model cut off', 'half of `images.bin`')
def _(w):
    file = w.model / 'images.bin'
    file.write_bytes(file.read_bytes()[:file.stat().st_size // 2])


# Images.

@row('JPEG', 'quality 95')
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


@row('JPEG turned by EXIF', 'orientation 6; COLMAP does not turn it, either')
def _(w):
    w.convert('.jpg', save_turned)


@row('16-bit PNG', 'grey')
def _(w):
    w.convert('.png', save_deep)


@row('16-bit TIFF', 'grey')
def _(w):
    w.convert('.tif', save_deep)


@row('PNG with an opaque alpha', 'four channels')
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


@row('HEIF', 'its first bytes')
def _(w):
    w.convert('.heic', lambda _, path: path.write_bytes(b'\0\0\0\x18ftypheic\0\0\0\0mif1heic' + bytes(100)))


@row('raw', 'the first bytes of a DNG')
def _(w):
    w.convert('.dng', lambda _, path: path.write_bytes(b'II*\0\x08\0\0\0' + bytes(100)))


@row('an image cut off', 'half of `view_003.png`')
def _(w):
    file = w.images / 'view_003.png'
    file.write_bytes(file.read_bytes()[:file.stat().st_size // 2])


def make_masks(w, shrink=1):
    (w.path / 'masks').mkdir()
    for file in w.files():
        width, height = Image.open(file).size
        Image.new('L', (width // shrink, height // shrink), 255).save(w.path / 'masks' / (file.name + '.png'))
    return ['--mask_path', w.path / 'masks']


@row('masks', 'white, `masks/view_000.png.png`, `--mask_path`')
def _(w):
    return make_masks(w)


@row('a mask is not there', 'that of `view_003.png`')
def _(w):
    arguments = make_masks(w)
    (w.path / 'masks/view_003.png.png').unlink()
    return arguments


@row('masks of another size', 'half of that of the images')
def _(w):
    return make_masks(w, 2)


# Models of other programs.

@row('nerfstudio\'s `transforms.json`', '`colmap_im_id` and `applied_transform` in it; `import --format nerf`')
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
    shutil.copytree(base, folder, symlinks=True)
    arguments = change(Workspace(folder)) or []
    if '--workspace_path' not in arguments:
        arguments = ['--workspace_path', folder, *arguments]
    code, said = run(*arguments, '--refiner', 'none', '--refine_poses_with_curves', '0', '--output_formats', 'ply',
                     '--output_path', folder / 'results', '--num_threads', '1', cwd=folder)
    curves = folder / 'results/curves.ply'
    result = 'the same curves' if code == 0 and curves.read_bytes() == expected else 'curves' if code == 0 else 'error'
    # Sentences end with a full stop; lines of stages with a time.
    notes = [line for line in said.split('\nWritten to')[0].splitlines() if re.match(r'(ERROR: )?[A-Z/0-9].*[.;]$', line)]
    notes = [note.replace(str(folder), 'W').replace('ERROR: ', '').replace('|', '\\|') for note in notes]
    return ': '.join([result, *notes]) if notes else result


def table(scratch):
    base = scratch / 'base'
    run('synthesize', '--workspace_path', base, '--solid', 'block', '--num_views', '12', '--width', '120', '--height', '120',
        '--points_per_view', '20')
    lines = ['| what | how | what happens |', '|---|---|---|']
    expected = b''
    for number, (what, how, change) in enumerate(ROWS):
        folder = scratch / str(number)
        happened = happens(base, change, folder, expected)
        if not expected:
            expected = (folder / 'results/curves.ply').read_bytes()
            happened = 'curves, the same as those below'
        lines.append(f'| {what} | {how} | {happened} |')
        shutil.rmtree(folder)
    return lines


def main():
    with tempfile.TemporaryDirectory(prefix='curvix-') as scratch:
        lines = table(pathlib.Path(scratch).resolve())
    if len(sys.argv) < 3:
        print('\n'.join(lines))
        return 0
    page = pathlib.Path(sys.argv[2]).read_text('utf8').splitlines()
    page = [line for line in page if line.startswith('|')]
    print('\n'.join(difflib.unified_diff(page, lines, 'page', 'this run', n=0, lineterm='')))
    return page != lines


sys.exit(main())
