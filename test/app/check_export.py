#!/usr/bin/env python3
"""Compare what `jounce export` has written with run.h5, number by number.

usage: check_export.py FORMAT RECORDING OUTPUT FRAMES FPS      FRAMES: "0,2,4"; FPS: 0 for the simulation's own time
FORMAT: glb obj ply vtu vtu_surface pc2 usda; exits with 77 when a module is missing
"""
import json
import re
import struct
import sys
import xml.etree.ElementTree as xml

try:
	import h5py
	import meshio
	import numpy as np
except ImportError as error:
	print(error)
	sys.exit(77)

SINGLE = 1.2e-7  # relative error of a rounding to single precision, twice; sizes in the scenes are below 1 m


class Part:
	"""A body, by name, as h5py sees it: what its vertices and triangles must be."""

	def __init__(self, run, name):
		self.run, self.name, group = run, name, run["mesh"][name]
		self.first, self.count = group["cells"].attrs["first_node"], group["cells"].attrs["node_count"]
		self.thread = group.get("axis")
		triangles = group["surface/triangles"][()]
		self.is_embedded = group["surface"].attrs["kind"] == "embedded"
		self.is_points = len(triangles) == 0
		self.used = np.unique(triangles) if not self.is_points else np.arange(self.first, self.first + self.count)
		self.triangles = np.searchsorted(self.used, triangles)
		if self.is_embedded:
			self.nodes, self.weights = group["surface/nodes"][()], group["surface/weights"][()]
			self.offsets = group["surface/offsets"][()] if "offsets" in group["surface"] else 0

	def values(self, nodes):
		"""A field of the vertices: of an axis for threads."""
		if self.thread is not None:
			own = nodes[self.first:self.first + self.count]
			return np.einsum("k,fk...->f...", self.thread[()], own.reshape(-1, 3, *nodes.shape[1:]))
		if self.is_embedded:
			return np.einsum("sk,sk...->s...", self.weights, nodes[self.nodes])[self.used]
		return nodes[self.used]

	def vertices(self, frame):
		moved = self.values(self.run[f"frames/{frame:08d}/position"][()])
		return moved + self.offsets[self.used] if self.is_embedded and np.ndim(self.offsets) else moved

	def check_vertices(self, points, frame, tolerance):
		wanted = self.vertices(frame)
		if self.thread is not None and len(points) != len(wanted):  # a tube
			rings = points.reshape(len(wanted), -1, 3)
			assert np.allclose(rings.mean(axis=1), wanted, rtol=0, atol=tolerance), self.name
			radii = np.linalg.norm(rings - wanted[:, None], axis=2)
			assert np.allclose(radii, self.thread.attrs["radius"], rtol=0, atol=2 * tolerance), self.name
			return
		assert points.shape == wanted.shape, (self.name, points.shape, wanted.shape)
		assert np.abs(points - wanted).max() <= tolerance, (self.name, np.abs(points - wanted).max())

	def check_corners(self, triangles, points, frame, tolerance):
		"""Some vertices may be doubled: corner by corner, in the order of the triangles."""
		wanted = self.vertices(frame)[self.triangles]
		assert np.abs(points[triangles] - wanted).max() <= tolerance, self.name

	def check_triangles(self, triangles, points):
		if self.thread is None:
			assert np.array_equal(triangles, self.triangles), self.name
			return
		# every edge of a closed tube has one triangle on either side, and it encloses a positive volume
		edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
		assert {tuple(edge) for edge in edges} == {tuple(edge[::-1]) for edge in edges}, self.name
		assert len({tuple(edge) for edge in edges}) == len(edges), self.name
		a, b, c = (points[triangles[:, k]] for k in range(3))
		volume, links = np.einsum("ta,ta->", a, np.cross(b, c)) / 6, len(points) // 8 - 1
		assert 0.5 < volume / (np.pi * self.thread.attrs["radius"]**2 * links * 0.05) < 1.5, (self.name, volume)


def times_of(run, frames, fps):
	return [i / fps if fps else run[f"frames/{frame:08d}"].attrs["time"] for i, frame in enumerate(frames)]


def check_meshes(bodies, obstacles, points, triangles, frame):
	"""All parts one after the other in one mesh."""
	first = 0
	for part in bodies:
		own = triangles[(triangles >= first).all(axis=1)]
		count = len(part.vertices(frame)) * (8 if part.thread is not None else 1)
		own = own[(own < first + count).all(axis=1)] - first
		part.check_vertices(points[first:first + count], frame, SINGLE)
		part.check_triangles(own, points[first:first + count])
		first += count
	for obstacle in obstacles:
		assert np.allclose(points[first:first + len(obstacle["points"])], obstacle["points"], rtol=SINGLE, atol=SINGLE)
		first += len(obstacle["points"])
	assert first == len(points), (first, len(points))


def read_obj(path):
	"""Name of object -> points and triangles with numbers of its own points."""
	objects, first = {}, 1
	for line in open(path, encoding="utf-8"):
		word, *rest = line.split()
		if word == "o":
			first += len(objects[name][0]) if objects else 0
			name = rest[0]
			objects[name] = ([], [], [])
		elif word == "v":
			objects[name][0].append([float(number) for number in rest])
		elif word in "fp":
			objects[name]["vfp".index(word)].append([int(number) - first for number in rest])
	return {name: [np.array(rows) for rows in lists] for name, lists in objects.items()}


def check_obj(run, bodies, output, frames, fps):
	for frame in frames:
		objects = read_obj(f"{output}/frame_{frame:08d}.obj")
		assert list(objects) == [part.name for part in bodies] + list(run.get("obstacles", []))
		for part in bodies:
			points, triangles, singles = objects[part.name]
			part.check_vertices(points, frame, 1e-9)
			if part.is_points:
				assert list(singles[:, 0]) == list(range(len(points)))
			else:
				part.check_triangles(triangles, points)


def check_ply(run, bodies, output, frames, fps):
	obstacles = list(run.get("obstacles", {}).values())
	values = {}
	for frame in frames:
		mesh = meshio.read(f"{output}/frame_{frame:08d}.ply")
		check_meshes(bodies, obstacles, mesh.points, mesh.cells_dict["triangle"], frame)
		values[frame] = mesh
		if "speed" not in mesh.point_data or obstacles:
			continue
		speed = [np.linalg.norm(part.values(run[f"frames/{frame:08d}/velocity"][()]), axis=1) for part in bodies]
		assert np.allclose(mesh.point_data["speed"], np.concatenate(speed), rtol=1e-6, atol=1e-7)
	if "speed" in values[frames[0]].point_data:
		speeds = np.concatenate([mesh.point_data["speed"] for mesh in values.values()])
		greens = np.concatenate([mesh.point_data["green"] for mesh in values.values()]).astype(int) % 256
		assert speeds.max() > 0 and greens[speeds.argmax()] == 231 and greens[speeds.argmin()] == 1  # ends of viridis


def check_vtu(run, bodies, output, frames, fps, surface=False):
	root = xml.parse(f"{output}/run.pvd").getroot()
	sets = [(float(entry.get("timestep")), entry.get("file")) for entry in root.iter("DataSet")]
	assert sets == list(zip(times_of(run, frames, fps), [f"frame_{frame:08d}.vtu" for frame in frames])), sets
	for time, name in sets:
		frame = run[f"frames/{int(name[6:14]):08d}"]
		mesh = meshio.read(f"{output}/{name}")
		fields = set(frame) - {"position", "surface"}
		assert set(mesh.point_data) == fields, (set(mesh.point_data), fields)
		if surface:
			wanted = np.concatenate([part.vertices(int(name[6:14])) for part in bodies])
			assert np.abs(mesh.points - wanted).max() < 1e-15
			for field in fields:
				wanted = np.concatenate([part.values(frame[field][()]) for part in bodies])
				assert np.allclose(mesh.point_data[field], wanted, rtol=1e-14, atol=1e-15), field
			threads = [part for part in bodies if part.thread is not None]
			lines = sum(len(part.vertices(0)) - 1 + part.thread.attrs["is_closed"] for part in threads)
			assert len(mesh.cells_dict.get("line", [])) == lines
			continue
		assert np.array_equal(mesh.points, frame["position"])
		for field in fields:
			assert np.array_equal(mesh.point_data[field], frame[field]), field
		types = {"hex8": "hexahedron", "tet4": "tetra", "point1": "vertex", "tri3": "triangle"}
		own = [run["mesh"][part.name]["cells"] for part in bodies]
		cells = [(types[rows.attrs["shape"]], rows[()]) for rows in own]
		for kind, block in mesh.cells_dict.items():
			assert np.array_equal(block, np.concatenate([rows for name, rows in cells if name == kind])), kind
		numbers = np.concatenate([np.full(len(rows), i) for i, (kind, rows) in enumerate(cells)])
		assert np.array_equal(np.sort(np.concatenate(mesh.cell_data["body"])), numbers)
	if "obstacles" in run:
		mesh = meshio.read(f"{output}/obstacles.vtu")
		assert np.array_equal(mesh.points, np.concatenate([obstacle["points"] for obstacle in run["obstacles"].values()]))


def check_pc2(run, bodies, output, frames, fps):
	for part in bodies:
		data = open(f"{output}/{part.name}.pc2", "rb").read()
		magic, version, count, start, sampling, samples = struct.unpack("<12siiffi", data[:32])
		assert (magic, version, start, samples) == (b"POINTCACHE2\0", 1, 0, len(frames))
		spacing = np.diff(times_of(run, frames, 0)).mean() * 24
		assert np.isclose(sampling, 1 if fps else spacing, rtol=1e-6), sampling
		points = np.frombuffer(data[32:], "<f4").reshape(samples, count, 3)
		base = read_obj(f"{output}/{part.name}.obj")[part.name]
		assert np.abs(base[0] - points[0]).max() <= SINGLE
		if not part.is_points:
			part.check_triangles(base[1], points[0])
		for row, frame in zip(points, frames):
			part.check_vertices(row, frame, SINGLE)
	for name, obstacle in run.get("obstacles", {}).items():
		assert np.allclose(read_obj(f"{output}/{name}.obj")[name][0], obstacle["points"], rtol=1e-8)


def vectors(text):
	return np.array([[float(number) for number in row.split(",")] for row in re.findall(r"\(([^)]*)\)", text)])


def check_usda(run, bodies, output, frames, fps):
	text = open(output, encoding="utf-8").read()
	assert text.startswith("#usda 1.0\n(\n")
	assert text.count("{") == text.count("}") and text.count("[") == text.count("]")
	head = dict(re.findall(r"^\t(\w+) = (.*)$", text[:text.index("def Xform")], re.M))
	rate = fps or 24
	gravity = run["gravity"][()]
	assert head["upAxis"] == ('"Z"' if abs(gravity[2]) > abs(gravity[1]) else '"Y"'), head
	assert head["metersPerUnit"] == "1" and float(head["timeCodesPerSecond"]) == rate
	codes = [(time - times_of(run, frames, fps)[0]) * rate for time in times_of(run, frames, fps)]
	assert np.isclose(float(head["endTimeCode"]), codes[-1], rtol=1e-8)
	pattern = r"\tdef (\w+) \"\w+\" \(\n\t\tcustomData = \{\n\t\t\tstring name = \"([^\"]*)\".*?\n\t\{\n(.*?)\n\t\}"
	prims = {name: (kind, body) for kind, name, body in re.findall(pattern, text, re.S)}
	for part in bodies:
		kind, body = prims[part.name]
		assert kind == ("BasisCurves" if part.thread is not None else "Points" if part.is_points else "Mesh")
		rows = re.search(r"points\.timeSamples = \{\n(.*?)\n\t\t\}", body, re.S)[1].splitlines()
		boxes = re.search(r"extent\.timeSamples = \{\n(.*?)\n\t\t\}", body, re.S)[1].splitlines()
		assert len(rows) == len(boxes) == len(frames)
		for row, box, frame, code in zip(rows, boxes, frames, codes):
			time, values = row.split(":")
			assert np.isclose(float(time), code, rtol=1e-8)
			points, grown = vectors(values), part.thread.attrs["radius"] if part.thread is not None else 0
			part.check_vertices(points, frame, 1e-9)
			low, high = vectors(box)
			assert np.allclose([low + grown, high - grown], [points.min(axis=0), points.max(axis=0)], rtol=0, atol=1e-9)
		if kind == "Mesh":
			numbers = re.search(r"faceVertexIndices = \[(.*)\]", body)[1].split(",")
			part.check_triangles(np.array(numbers, int).reshape(-1, 3), points)
			assert len(re.search(r"faceVertexCounts = \[(.*)\]", body)[1].split(",")) == len(numbers) // 3
	assert set(run.get("obstacles", {})) <= set(prims)


class Glb:
	def __init__(self, path):
		data = open(path, "rb").read()
		magic, version, length, size, kind = struct.unpack("<4sII I4s", data[:20])
		assert (magic, version, length, kind) == (b"glTF", 2, len(data), b"JSON")
		self.json = json.loads(data[20:20 + size])
		size2, kind = struct.unpack("<I4s", data[20 + size:28 + size])
		assert kind == b"BIN\0" and size2 == self.json["buffers"][0]["byteLength"] == len(data) - 28 - size
		self.data = data[28 + size:]

	def view(self, index, dtype):
		view = self.json["bufferViews"][index]
		return np.frombuffer(self.data[view["byteOffset"]:view["byteOffset"] + view["byteLength"]], dtype)

	def array(self, index):
		accessor = self.json["accessors"][index]
		width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
		dtype = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
		out = np.zeros((accessor["count"], width), dtype)
		if "bufferView" in accessor:
			out = self.view(accessor["bufferView"], dtype).reshape(-1, width)
		if "sparse" in accessor:
			out[self.view(accessor["sparse"]["indices"]["bufferView"], "<u4")] = self.view(
				accessor["sparse"]["values"]["bufferView"], dtype).reshape(-1, width)
		assert len(out) == accessor["count"]
		return out


def check_creases(points, triangles, normals):
	"""The normal of a corner is within half a right angle of its triangle's, as edges of 50 degrees and more are cut."""
	a, b, c = (points[triangles[:, k]] for k in range(3))
	own = np.cross(b - a, c - a)
	own /= np.linalg.norm(own, axis=1)[:, None]
	assert np.einsum("tka,ta->tk", normals[triangles], own).min() > np.cos(np.pi / 4)


def check_glb(run, bodies, output, frames, fps):
	glb = Glb(output)
	nodes = {node["name"]: node for node in glb.json["nodes"][1:]}
	assert len(nodes) == len(bodies) + len(run.get("obstacles", {}))
	up = -run["gravity"][()] / np.linalg.norm(run["gravity"])
	x, y, z, w = glb.json["nodes"][0]["rotation"]
	turned = up + 2 * np.cross([x, y, z], np.cross([x, y, z], up) + w * up)
	assert np.allclose(turned, [0, 1, 0], atol=1e-6), turned
	sparse = 0
	for part in bodies:
		mesh = glb.json["meshes"][nodes[part.name]["mesh"]]
		primitive = mesh["primitives"][0]
		base = glb.array(primitive["attributes"]["POSITION"]).astype(float)
		triangles = None if part.is_points else glb.array(primitive["indices"]).reshape(-1, 3).astype(int)
		assert primitive["mode"] == (0 if part.is_points else 4)
		points = len(part.vertices(0)) * (8 if part.thread is not None else 1)  # behind them come doubled ones
		if part.is_points:
			assert len(base) == points
		else:
			normals = glb.array(primitive["attributes"]["NORMAL"])
			assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)
			if frames[0] == 0:
				check_creases(base, triangles, normals)
		assert mesh["weights"] == [0] * (len(frames) - 1) and len(primitive["targets"]) == len(frames) - 1
		targets = [glb.array(target["POSITION"]) for target in primitive["targets"]]
		for moved, frame in zip([base] + [base + target for target in targets], frames):
			part.check_vertices(moved[:points], frame, SINGLE)
			if not part.is_points and part.thread is None:
				part.check_corners(triangles, moved, frame, SINGLE)
		for target in primitive["targets"]:
			sparse += "bufferView" not in glb.json["accessors"][target["POSITION"]]
			if not part.is_points:
				moved = normals + glb.array(target["NORMAL"])
				assert np.allclose(np.linalg.norm(moved, axis=1), 1, atol=1e-6)
	animation = glb.json["animations"][0]
	assert len(animation["channels"]) == len(bodies)
	times = glb.array(animation["samplers"][0]["input"])[:, 0]
	wanted = np.array(times_of(run, frames, fps))
	assert np.allclose(times, wanted - wanted[0], rtol=1e-6, atol=1e-9), times
	weights = glb.array(animation["samplers"][0]["output"]).reshape(len(frames), -1)
	assert np.array_equal(weights, np.vstack([np.zeros(len(frames) - 1), np.eye(len(frames) - 1)]))
	if "resting" in run["mesh"]:
		assert sparse >= len(frames) - 1, sparse  # of the body that does not move


def main():
	form, recording, output, chosen, fps = sys.argv[1:]
	with h5py.File(f"{recording}/run.h5") as run:
		bodies = [Part(run, name) for name in run["mesh"] if name != "nodes"]
		bodies.sort(key=lambda part: part.first)
		check = {"glb": check_glb, "obj": check_obj, "ply": check_ply, "vtu": check_vtu, "pc2": check_pc2, "usda": check_usda,
			"vtu_surface": lambda *arguments: check_vtu(*arguments, surface=True)}[form]
		check(run, bodies, output, [int(number) for number in chosen.split(",")], float(fps))


main()
