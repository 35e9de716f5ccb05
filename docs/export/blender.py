"""Opens what `jounce export` has written in Blender, and saves it as a .blend file or renders a frame.

blender --background --python docs/export/blender.py -- run.glb scene.blend
blender --background --python docs/export/blender.py -- FOLDER_OF_PC2 picture.png 24
"""
import glob
import os
import sys

import numpy

if "bool" not in numpy.__dict__:
    numpy.bool = bool  # the glTF importer of Blender 3.4 in Debian 12 is older than the NumPy beside it
import bpy
from mathutils import Vector

source, target, frame = (sys.argv[sys.argv.index("--") + 1:] + ["1"])[:3]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene

if os.path.isdir(source):  # a mesh and its point cache for each body; obstacles have no cache
    for mesh in sorted(glob.glob(os.path.join(source, "*.obj"))):
        bpy.ops.wm.obj_import(filepath=mesh)  # forward_axis="Y", up_axis="Z" where z is up in the scene
        cache = os.path.abspath(mesh[:-4] + ".pc2")
        if os.path.exists(cache):
            modifier = bpy.context.selected_objects[0].modifiers.new("cache", "MESH_CACHE")
            modifier.cache_format = "PC2"
            modifier.filepath = cache
            sampling = numpy.fromfile(cache, "<f4", 1, offset=24)[0]
            modifier.frame_scale = 1 / sampling  # samples a frame: Blender does not read this from the file
else:
    bpy.ops.import_scene.gltf(filepath=source, import_shading="SMOOTH")  # a cloth that starts flat would stay faceted

if target.endswith(".blend"):
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(target))
    sys.exit()

scene.frame_set(int(frame))
meshes = [item for item in scene.objects if item.type == "MESH" and ("cache" in item.modifiers or item.data.shape_keys)]
corners = [item.matrix_world @ Vector(corner) for item in meshes for corner in item.bound_box]
low, high = (Vector(map(pick, zip(*corners))) for pick in (min, max))
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (low + high) / 2 + Vector((1.2, -1.4, 0.8)) * (high - low).length
camera.rotation_euler = ((low + high) / 2 - camera.location).to_track_quat("-Z", "Y").to_euler()
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.rotation_euler, sun.data.energy = (0.7, 0.2, 0.5), 3
for item in (camera, sun):
    scene.collection.objects.link(item)
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.5, 0.55, 0.6, 1)
scene.camera, scene.render.engine, scene.cycles.samples = camera, "CYCLES", 32
scene.cycles.use_denoising = False  # Debian's Blender is built without a denoiser
scene.render.resolution_x, scene.render.resolution_y = 640, 480
scene.render.filepath = os.path.abspath(target)
bpy.ops.render.render(write_still=True)
