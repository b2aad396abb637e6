# Checks that Blender moves the cloth of a .glb or .pc2 as weft did, and the colliders of a .glb as the file says. The same run must have written a sequence of .obj:
#
#   weft run SCENE --out film.glb --out film.pc2 --out frames/%04d.obj
#   blender --background --factory-startup --python scripts/check_blender.py -- film.glb frames/%04d.obj
#   blender --background --factory-startup --python scripts/check_blender.py -- film.pc2 frames/%04d.obj
#
# Of a .pc2, imports film.obj with the importer's defaults (up to Blender 3 also with the older importer) and adds
# film.pc2 with a Mesh Cache modifier and its defaults. Compares every vertex of several frames, in world space, with
# the .obj of that frame; those of a collider, with its mesh and its keys in the .glb. The exit status is the result.
import json
import math
import os
import struct
import sys

import bpy
import numpy
from mathutils import Matrix, Quaternion, Vector

# Debian 12 combines Blender 3.4, whose glTF importer uses numpy.bool, with a numpy that does not have that name.
if 'bool' not in vars(numpy):
    numpy.bool = bool

TOLERANCE = 1e-5  # m
CHECKED = 7  # frames, spread over the animation


def expected(path, only_used):
    """The vertices of each object in the file, turned as Blender has them: z up instead of y."""
    objects, used, count = [], set(), 0
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ['o']:
                objects.append((words[1], []))
            elif words[:1] == ['v']:
                x, y, z = map(float, words[1:])
                objects[-1][1].append((count, Vector((x, -z, y))))
                count += 1
            elif words[:1] == ['f']:
                used.update(int(word.split('/')[0]) - 1 for word in words[1:])
    return [(name, [at for i, at in vertices if i in used or not only_used]) for name, vertices in objects]


def open_cache(path, legacy):
    """The film as one object, and the times of its frames in frames of Blender."""
    rest = os.path.splitext(path)[0] + '.obj'
    if legacy:
        bpy.ops.import_scene.obj(filepath=rest, split_mode='OFF')  # "Keep Vertex Order"
    else:
        bpy.ops.wm.obj_import(filepath=rest)
    things = list(bpy.data.objects)
    if len(things) != 1:
        raise ValueError(f'{rest}: {len(things)} objects')
    cache = things[0].modifiers.new('film', 'MESH_CACHE')
    cache.cache_format = 'PC2'
    cache.filepath = os.path.abspath(path)
    return things, None


def is_cloth(thing):
    return thing.type == 'MESH' and thing.data.shape_keys is not None


def open_gltf(path):
    """The cloths by name, and the times of the frames in frames of Blender."""
    bpy.ops.import_scene.gltf(filepath=path, import_shading='SMOOTH')
    things = sorted(filter(is_cloth, bpy.data.objects), key=lambda thing: thing.name)
    curve = things[0].data.shape_keys.animation_data.action.fcurves[0]
    return things, [key.co.x for key in curve.keyframe_points]


class Colliders:
    """The rigid objects of a .glb, read without Blender's importer."""

    def __init__(self, path):
        with open(path, 'rb') as file:
            json_length = struct.unpack('<4sIIII', file.read(20))[3]
            self.gltf = json.loads(file.read(json_length))
            file.seek(8, os.SEEK_CUR)
            self.binary = file.read()
        meshes = self.gltf['meshes']
        self.nodes = [i for i, node in enumerate(self.gltf['nodes'])
                      if 'targets' not in meshes[node['mesh']]['primitives'][0]]

    def floats(self, accessor_index):
        accessor = self.gltf['accessors'][accessor_index]
        width = {'SCALAR': 1, 'VEC3': 3, 'VEC4': 4}[accessor['type']]
        offset = self.gltf['bufferViews'][accessor['bufferView']].get('byteOffset', 0)
        values = numpy.frombuffer(self.binary, dtype='<f4', count=accessor['count'] * width, offset=offset)
        return values.reshape(-1, width).tolist()

    def name(self, node):
        return self.gltf['nodes'][node]['name']

    def pose(self, node, frame):
        at = self.gltf['nodes'][node]['translation']
        turn = self.gltf['nodes'][node]['rotation']
        animation = self.gltf['animations'][0]
        for channel in animation['channels']:
            if channel['target']['node'] != node:
                continue
            value = self.floats(animation['samplers'][channel['sampler']]['output'])[frame]
            if channel['target']['path'] == 'translation':
                at = value
            else:
                turn = value
        x, y, z, w = turn
        return Matrix.Translation(at) @ Quaternion((w, x, y, z)).to_matrix().to_4x4()

    def vertices(self, node, frame):
        """In world space, turned as Blender has them."""
        mesh = self.gltf['meshes'][self.gltf['nodes'][node]['mesh']]
        pose = self.pose(node, frame)
        placed = (pose @ Vector(v) for v in self.floats(mesh['primitives'][0]['attributes']['POSITION']))
        return [Vector((v.x, -v.z, v.y)) for v in placed]

    def greatest_error(self, frame):
        """Of the scene as Blender shows it now. Blender numbers objects whose name is taken."""
        worst = 0
        for node in self.nodes:
            wanted = self.vertices(node, frame)
            errors = [max((thing.matrix_world @ vertex.co - at).length for vertex, at in zip(thing.data.vertices, wanted))
                      for thing in bpy.data.objects
                      if thing.type == 'MESH' and not is_cloth(thing) and len(thing.data.vertices) == len(wanted)
                      and (thing.name == self.name(node) or thing.name.startswith(self.name(node) + '.'))]
            if not errors:
                raise ValueError(f'no object shows the collider {self.name(node)}')
            worst = max(worst, min(errors))
        return worst


def greatest_error(things, time, wanted):
    bpy.context.scene.frame_set(math.floor(time), subframe=time - math.floor(time))
    worst = 0
    if len(things) != len(wanted):
        raise ValueError(f'{len(things)} objects instead of {len(wanted)}')
    for thing, vertices in zip(things, wanted):
        shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
        if len(shown.data.vertices) != len(vertices):
            raise ValueError(f'{thing.name}: {len(shown.data.vertices)} vertices instead of {len(vertices)}')
        errors = ((shown.matrix_world @ vertex.co - at).length for vertex, at in zip(shown.data.vertices, vertices))
        worst = max(worst, *errors)
    return worst


def main(path, pattern):
    count = 0
    while os.path.exists(pattern % count):
        count += 1
    if count == 0:
        raise ValueError(f'there is no {pattern % 0}')
    frames = sorted({round(i * (count - 1) / (CHECKED - 1)) for i in range(CHECKED)})
    is_gltf = path.endswith('.glb')
    importers = [('glTF', open_gltf)] if is_gltf else [('new', lambda path: open_cache(path, False))]
    if not is_gltf and bpy.app.version < (4, 0):
        importers.append(('legacy', lambda path: open_cache(path, True)))
    colliders = Colliders(path) if is_gltf else None
    for name, importer in importers:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        things, times = importer(path)
        for frame in frames:
            wanted = expected(pattern % frame, only_used=not is_gltf)
            if is_gltf:
                wanted = [vertices for _, vertices in sorted(wanted, key=lambda entry: entry[0])]
            else:
                wanted = [[at for _, vertices in wanted for at in vertices]]
            error = greatest_error(things, times[frame] if times else frame, wanted)
            print(f'check_blender: {name} importer, frame {frame}: within {error:.2g} m')
            if colliders and colliders.nodes:
                rigid = colliders.greatest_error(frame)
                print(f'check_blender: {len(colliders.nodes)} colliders, frame {frame}: within {rigid:.2g} m')
                error = max(error, rigid)
            if error > TOLERANCE:
                raise ValueError(f'frame {frame} is off by {error:.3g} m')


try:
    main(*sys.argv[sys.argv.index('--') + 1:])
except Exception as problem:  # Blender itself would print it and exit with 0
    print(f'check_blender: error: {problem}', file=sys.stderr)
    sys.exit(1)
