# Checks that Blender moves the mesh of a .pc2 as weft did. The same run must have written a sequence of .obj:
#
#   weft run SCENE --out film.pc2 --out frames/%04d.obj
#   blender --background --factory-startup --python scripts/check_pc2.py -- film.pc2 frames/%04d.obj
#
# Imports film.obj with the importer's defaults (up to Blender 3 also with the older importer), adds film.pc2 with a
# Mesh Cache modifier and its defaults, and compares every vertex of several frames, in world space, with the .obj of
# that frame. The exit status is the result.
import os
import sys

import bpy
from mathutils import Vector

TOLERANCE = 1e-5  # m
CHECKED = 7  # frames, spread over the animation


def expected(path):
    """The vertices that faces use, in the order of the file, turned as Blender has them: z up instead of y."""
    vertices, used = [], set()
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ['v']:
                x, y, z = map(float, words[1:])
                vertices.append(Vector((x, -z, y)))
            elif words[:1] == ['f']:
                used.update(int(word.split('/')[0]) - 1 for word in words[1:])
    return [vertices[index] for index in sorted(used)]


def open_film(path, legacy):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    rest = os.path.splitext(path)[0] + '.obj'
    if legacy:
        bpy.ops.import_scene.obj(filepath=rest, split_mode='OFF')  # "Keep Vertex Order"
    else:
        bpy.ops.wm.obj_import(filepath=rest)
    objects = list(bpy.data.objects)
    if len(objects) != 1:
        raise ValueError(f'{rest}: {len(objects)} objects')
    cache = objects[0].modifiers.new('film', 'MESH_CACHE')
    cache.cache_format = 'PC2'
    cache.filepath = os.path.abspath(path)
    return objects[0]


def greatest_error(thing, frame, pattern):
    bpy.context.scene.frame_set(frame)
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    wanted = expected(pattern % frame)
    if len(shown.data.vertices) != len(wanted):
        raise ValueError(f'frame {frame}: {len(shown.data.vertices)} vertices instead of {len(wanted)}')
    return max((shown.matrix_world @ vertex.co - at).length for vertex, at in zip(shown.data.vertices, wanted))


def main(path, pattern):
    count = 0
    while os.path.exists(pattern % count):
        count += 1
    if count == 0:
        raise ValueError(f'there is no {pattern % 0}')
    frames = sorted({round(i * (count - 1) / (CHECKED - 1)) for i in range(CHECKED)})
    for legacy in (False, True) if bpy.app.version < (4, 0) else (False,):
        thing = open_film(path, legacy)
        for frame in frames:
            error = greatest_error(thing, frame, pattern)
            print(f'check_pc2: {"legacy" if legacy else "new"} importer, frame {frame}: within {error:.2g} m')
            if error > TOLERANCE:
                raise ValueError(f'frame {frame} is off by {error:.3g} m')


try:
    main(*sys.argv[sys.argv.index('--') + 1:])
except Exception as problem:  # Blender itself would print it and exit with 0
    print(f'check_pc2: error: {problem}', file=sys.stderr)
    sys.exit(1)
