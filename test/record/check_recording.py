"""Open a recording with the libraries that users open it with, and compare them with each other.

usage: check_recording.py DIRECTORY CELL_TYPE...      exits with 77 when a module is missing
"""
import csv
import json
import sys

try:
	import h5py
	import meshio
	import numpy as np
except ImportError as error:
	print(error)
	sys.exit(77)

directory, cell_types = sys.argv[1], sys.argv[2:]

with open(f"{directory}/summary.json", encoding="utf-8") as stream:
	summary = json.load(stream)
assert summary["outcome"] == "done", summary
assert summary["message"] == 'tab\there, quote ", backslash \\', summary

with h5py.File(f"{directory}/run.h5") as run:
	assert run.attrs["outcome"] == "done"
	assert run["scene"].asstr()[()] == "name: beam\n# --set dt=1e-3\n"
	with open(f"{directory}/series.csv", newline="") as stream:
		rows = list(csv.DictReader(stream))
	assert set(rows[0]) == set(run["series"]), rows[0]
	for name, values in run["series"].items():
		assert [float(row[name]) for row in rows] == list(values), name

	with meshio.xdmf.TimeSeriesReader(f"{directory}/run.xdmf") as reader:
		points, cells = reader.read_points_cells()
		assert [block.type for block in cells] == cell_types, cells
		assert np.array_equal(points, run["frames/00000000/position"])
		assert reader.num_steps == run["frames"].attrs["count"] == summary["frames"]
		for k in range(reader.num_steps):
			time, point_data, cell_data = reader.read_data(k)
			frame = run[f"frames/{k:08d}"]
			assert time == frame.attrs["time"]
			fields = set(frame) - {"surface"}
			assert set(point_data) == fields, (set(point_data), fields)
			for name in fields:
				assert np.array_equal(point_data[name], frame[name]), name
			assert [list(block) for block in cell_data["body"]] == [[i] for i in range(len(cells))]

	surfaces = [run["mesh"][name]["surface"] for name in run["mesh"] if name != "nodes"]
	with meshio.xdmf.TimeSeriesReader(f"{directory}/surface.xdmf") as reader:
		points, cells = reader.read_points_cells()
		assert [block.type for block in cells] == ["triangle"], cells
		assert len(cells[0].data) == sum(len(surface["triangles"]) for surface in surfaces)
		assert reader.num_steps == summary["frames"]
		has_embedding = any(surface.attrs["kind"] == "embedded" for surface in surfaces)
		for k in range(reader.num_steps):
			time, point_data, cell_data = reader.read_data(k)
			frame = run[f"frames/{k:08d}"]
			assert time == frame.attrs["time"]
			assert np.array_equal(point_data["position"], frame["surface" if has_embedding else "position"])
			assert len(cell_data["body"][0]) == len(cells[0].data)
			fields = {"position"} if has_embedding else set(frame) - {"velocity"}
			assert set(point_data) == fields, (set(point_data), fields)
			for name in fields - {"position"}:
				assert np.array_equal(point_data[name], frame[name]), name
			for surface in surfaces:
				if surface.attrs["kind"] != "embedded":
					continue
				first, count = surface.attrs["first_point"], surface.attrs["point_count"]
				carried = np.einsum("sk,ska->sa", surface["weights"], frame["position"][()][surface["nodes"][()]])
				assert np.allclose(point_data["position"][first:first + count], carried, rtol=0, atol=1e-14)
				own = surface["triangles"][()] + first
				assert all((cells[0].data == triangle).all(axis=1).any() for triangle in own)

	if "obstacles" in run:
		mesh = meshio.read(f"{directory}/obstacles.xdmf")
		names = ["floor", "wall"]
		assert set(run["obstacles"]) == set(names)
		first = 0
		for i, name in enumerate(names):
			points, own = run[f"obstacles/{name}/points"], run[f"obstacles/{name}/triangles"]
			assert np.array_equal(mesh.points[first:first + len(points)], points), name
			chosen = mesh.cell_data["obstacle"][0] == i
			assert np.array_equal(mesh.cells[0].data[chosen], own[()] + first), name
			first += len(points)
