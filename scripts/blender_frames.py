# Renders images of an exported animation as Blender reads it:
#
#   blender --background --factory-startup --python scripts/blender_frames.py -- FILE.glb OUT_PREFIX FRAME...
#
# FRAME counts the exported frames from 0; each becomes OUT_PREFIX_NNNN.png (960x720). Cycles on the CPU, because
# Blender's other two engines need a display. Debian: blender, and python3-numpy for its glTF importer.
import json
import math
import struct
import sys

import bpy
import numpy
from mathutils import Vector

# Debian 12 combines Blender 3.4, whose glTF importer uses numpy.bool, with a numpy that does not have that name.
if 'bool' not in vars(numpy):
    numpy.bool = bool

SAMPLES = 48
WELD = 1e-5  # m; cloth that has not parted yet has coinciding vertices, at which it would be shaded like a seam
FIT_FRAMES = 12  # number of frames, spread over the animation, that the camera must show


def key_times(path):
    """Times of the exported frames in s: the keys of the file's one animation, or one frame at 0."""
    with open(path, 'rb') as file:
        magic, _, _, json_length, _ = struct.unpack('<4sIIII', file.read(20))
        if magic != b'glTF':
            raise ValueError(f'{path}: not a .glb')
        gltf = json.loads(file.read(json_length))
        if not gltf.get('animations'):
            return [0.0]
        accessor = gltf['accessors'][gltf['animations'][0]['samplers'][0]['input']]
        view = gltf['bufferViews'][accessor['bufferView']]
        file.seek(20 + json_length + 8 + view.get('byteOffset', 0) + accessor.get('byteOffset', 0))
        return list(struct.unpack(f'<{accessor["count"]}f', file.read(4 * accessor['count'])))


def show(scene, time):
    # The importer puts keys at time * fps, which may be between frames.
    frame = time * scene.render.fps
    scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))


def corners_over(scene, times):
    """The eight corners of all vertices at the given times."""
    low, high = Vector((math.inf,) * 3), Vector((-math.inf,) * 3)
    for time in times:
        show(scene, time)
        graph = bpy.context.evaluated_depsgraph_get()
        for thing in scene.objects:
            if thing.type != 'MESH':
                continue
            shown = thing.evaluated_get(graph)
            for vertex in shown.data.vertices:
                at = shown.matrix_world @ vertex.co
                low = Vector(map(min, low, at))
                high = Vector(map(max, high, at))
    return [Vector((x, y, z)) for x in (low.x, high.x) for y in (low.y, high.y) for z in (low.z, high.z)]


def add_camera(scene, corners):
    camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    scene.collection.objects.link(camera)
    scene.camera = camera
    toward = Vector((-0.55, 0.9, -0.5))
    camera.rotation_euler = toward.to_track_quat('-Z', 'Y').to_euler()
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    camera.location, _ = camera.camera_fit_coords(graph, [x for corner in corners for x in corner])
    size = (corners[-1] - corners[0]).length
    camera.location -= 0.1 * size * toward.normalized()  # a margin
    camera.data.clip_start = max(1e-4, 1e-3 * size)
    camera.data.clip_end = 100 * max(size, 1)


def add_light(scene):
    sun = bpy.data.objects.new('sun', bpy.data.lights.new('sun', 'SUN'))
    sun.data.energy = 2.5
    sun.data.angle = 0.1
    sun.rotation_euler = (math.radians(15), math.radians(-38), 0)  # low enough to show folds
    scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new('sky')
    scene.world.color = (0.16, 0.18, 0.21)


def set_up_render(scene):
    scene.render.engine = 'CYCLES'
    scene.cycles.device = 'CPU'
    scene.cycles.samples = SAMPLES
    scene.cycles.use_denoising = False  # not in every distribution's build
    scene.render.resolution_x, scene.render.resolution_y = 960, 720
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = 'PNG'
    scene.view_settings.view_transform = 'Standard'


def main(arguments):
    if len(arguments) < 3:
        raise ValueError('arguments: FILE.glb OUT_PREFIX FRAME...')
    path, prefix, frames = arguments[0], arguments[1], [int(text) for text in arguments[2:]]
    times = key_times(path)
    for frame in frames:
        if not 0 <= frame < len(times):
            raise ValueError(f'{path}: no frame {frame} among {len(times)}')

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path, import_shading='SMOOTH')
    scene = bpy.context.scene
    for thing in scene.objects:
        # Of an animation, only cloth has shape keys; welded colliders would lose their hard edges.
        if thing.type == 'MESH' and thing.data.shape_keys is not None:
            thing.modifiers.new('weld', 'WELD').merge_threshold = WELD
    step = max(1, len(times) // FIT_FRAMES)
    add_camera(scene, corners_over(scene, times[::step] + [times[frame] for frame in frames]))
    add_light(scene)
    set_up_render(scene)
    for frame in frames:
        show(scene, times[frame])
        scene.render.filepath = f'{prefix}_{frame:04d}.png'
        bpy.ops.render.render(write_still=True)
        print(f'blender_frames: {scene.render.filepath}')


try:
    main(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
except Exception as problem:  # Blender itself would print it and exit with 0
    print(f'blender_frames: error: {problem}', file=sys.stderr)
    sys.exit(1)
