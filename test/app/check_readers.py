#!/usr/bin/env python3
"""Read what a run and `jounce export --as vtu` write with other people's readers, beside h5py: the same bits of every
frame. meshio reads XDMF and VTU, VTK reads VTU; where VTK has a reader of XDMF (ParaView's has, Debian's own has
not), that too. Every reader has code of its own, so that they agree only where the files mean what they should.

usage: check_readers.py COMMAND FOLDER      FOLDER: for recordings; exits with 77 when a module is missing
"""
import os
import shutil
import subprocess
import sys

try:
	import h5py
	import meshio
	import numpy as np
	from vtkmodules.util.numpy_support import vtk_to_numpy
	from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as error:
	print(f"skipped: {error} (Debian: apt-get install python3-h5py python3-meshio python3-vtk9)")
	sys.exit(77)

try:
	from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
	from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
except ImportError:
	vtkXdmfReader = None


def arrays_of_grid(grid):
	"""Name -> array of the nodes, points first, of a grid of VTK."""
	data = grid.GetPointData()
	fields = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
	return {"points": vtk_to_numpy(grid.GetPoints().GetData()), **fields}


def by_vtk(path):
	reader = vtkXMLUnstructuredGridReader()
	reader.SetFileName(path)
	reader.Update()
	assert reader.GetErrorCode() == 0, path
	return arrays_of_grid(reader.GetOutput()), reader.GetOutput().GetNumberOfCells()


def by_meshio(path):
	mesh = meshio.read(path)
	return {"points": mesh.points, **mesh.point_data}, sum(len(block.data) for block in mesh.cells)


def frames_by_meshio(path):
	with meshio.xdmf.TimeSeriesReader(path) as reader:
		_, cells = reader.read_points_cells()
		for k in range(reader.num_steps):
			time, fields, _ = reader.read_data(k)
			yield time, fields, sum(len(block.data) for block in cells)


def frames_by_vtk(path):
	reader = vtkXdmfReader()
	reader.SetFileName(path)
	reader.UpdateInformation()
	for time in reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()):
		reader.UpdateTimeStep(time)
		grid = reader.GetOutputDataObject(0)
		yield time, arrays_of_grid(grid), grid.GetNumberOfCells()


def compare(read, cells, frame, wanted_cells):
	"""Positions and every field of a frame, bit by bit, and how many cells there are."""
	fields = set(frame) - {"position", "surface"}
	assert fields <= set(read), (fields, set(read))
	for name in fields:
		assert np.array_equal(read[name], frame[name]), name
	points = [read[name] for name in ("points", "position") if name in read]
	assert points and all(np.array_equal(own, frame["position"]) for own in points)
	assert cells == wanted_cells, (cells, wanted_cells)


def check(command, folder, scene):
	source = os.path.join(os.path.dirname(os.path.abspath(__file__)), f"export_{scene}.yaml")
	recording = os.path.join(folder, scene)
	subprocess.run([command, "run", source, "-o", recording, "-q"], check=True)
	subprocess.run([command, "export", recording, "--as", "vtu"], check=True, stdout=subprocess.DEVNULL)
	with h5py.File(f"{recording}/run.h5") as run:
		frames = [run["frames"][name] for name in sorted(run["frames"])]
		cells = sum(len(run["mesh"][name]["cells"]) for name in run["mesh"] if name != "nodes")
		for frame in frames:
			path = f"{recording}/vtu/frame_{frame.name[-8:]}.vtu"
			for fields, count in (by_vtk(path), by_meshio(path)):
				compare(fields, count, frame, cells)
		for by in (frames_by_meshio, frames_by_vtk) if vtkXdmfReader else (frames_by_meshio,):
			read = list(by(f"{recording}/run.xdmf"))
			assert [time for time, _, _ in read] == [frame.attrs["time"] for frame in frames], by
			for (_, fields, count), frame in zip(read, frames):
				compare(fields, count, frame, cells)
	print(f"{scene}: {len(frames)} frames, {cells} cells; XDMF by meshio{' and VTK' if vtkXdmfReader else ''}, VTU by both")


def main():
	command, folder = sys.argv[1:]
	shutil.rmtree(folder, ignore_errors=True)
	os.makedirs(folder)
	for scene in ("solids", "points"):
		check(command, folder, scene)


main()
