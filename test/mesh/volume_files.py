"""Write volume meshes for import_volume_test.c: volume_files.py FOLDER.

Reads nodes_SHAPE.txt and cells_SHAPE.txt in FOLDER. Writes good_SHAPE_*.* by meshio and, for what it cannot write, by
hand; and bad_*.*, the same files broken in at least ten ways each.
"""
import base64
import contextlib
import io
import random
import re
import struct
import sys
import zlib
from pathlib import Path

try:
    import meshio
    import numpy as np
except ImportError:
    sys.exit(77)  # the test is skipped

FOLDER = Path(sys.argv[1])
MESHIO_NAME = {"tet4": "tetra", "tet10": "tetra10", "hex8": "hexahedron"}
VTK_TYPE = {"tet4": 10, "tet10": 24, "hex8": 12}


def vtu_array(data, compressed, byte_order, header):
    """Bytes of a DataArray, in the pieces that VTK encodes one by one."""
    raw = data.astype(data.dtype.newbyteorder(byte_order)).tobytes()
    word = byte_order + header
    if not compressed:
        return [struct.pack(word, len(raw)) + raw]
    size = 100  # small, so that there are several blocks and a last one that is not full
    blocks = [raw[i : i + size] for i in range(0, len(raw), size)]
    packed = [zlib.compress(block) for block in blocks]
    head = [len(blocks), size, len(blocks[-1]) % size] + [len(block) for block in packed]
    return [b"".join(struct.pack(word, value) for value in head), b"".join(packed)]


def write_vtu(path, nodes, cells, types, where, compressed=False, byte_order="<", header="I", counts=None, size=None):
    """where: inline, raw or base64 (both appended). counts, size: what the file is to declare instead of the truth."""
    real = np.float64 if size is None else np.float32
    arrays = {
        "Points": (nodes.astype(real).ravel(), 3),
        "connectivity": (cells.ravel().astype(np.int32), 1),
        "offsets": (np.arange(1, len(cells) + 1, dtype=np.int64) * cells.shape[1], 1),
        "types": (np.asarray(types, np.uint8), 1),
        "set:low": ((nodes[:, 1] == nodes[:, 1].min()).astype(np.int8), 1),
    }
    appended, elements = b"", {}
    for name, (data, components) in arrays.items():
        pieces = vtu_array(data, compressed, byte_order, header)
        kind = {"f": "Float", "i": "Int", "u": "UInt"}[data.dtype.kind] + str(8 * data.dtype.itemsize)
        head = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
        if where == "inline":
            text = "".join(base64.b64encode(piece).decode() for piece in pieces)
            elements[name] = head + f'format="binary">\n  {text}\n</DataArray>\n'
        else:
            elements[name] = head + f'format="appended" offset="{len(appended)}"/>\n'
            appended += b"".join(pieces if where == "raw" else map(base64.b64encode, pieces))
    points, cell_count = counts or (len(nodes), len(cells))
    order = "LittleEndian" if byte_order == "<" else "BigEndian"
    text = (
        f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="{order}" '
        f'header_type="{"UInt32" if header == "I" else "UInt64"}"'
        + (' compressor="vtkZLibDataCompressor"' if compressed else "")
        + f'>\n<UnstructuredGrid>\n<Piece NumberOfPoints="{points}" NumberOfCells="{cell_count}">\n'
        + f'<PointData>{elements["set:low"]}</PointData>\n<Points>{elements["Points"]}</Points>\n'
        + f'<Cells>{elements["connectivity"]}{elements["offsets"]}{elements["types"]}</Cells>\n'
        + "</Piece>\n</UnstructuredGrid>\n"
    )
    tail = b"</VTKFile>\n"
    if where != "inline":
        tail = f'<AppendedData encoding="{where}">\n _'.encode() + appended + b"\n</AppendedData>\n" + tail
    Path(path).write_bytes(text.encode() + tail)


def write_vtk4(path, nodes, cells, types, binary):
    """Version 3 of the legacy format, with doubles and a FIELD before the points."""
    def put(data, kind):
        return data.astype(kind).tobytes() if binary else " ".join(map(repr, data.ravel().tolist())).encode()

    counted = np.hstack([np.full((len(cells), 1), cells.shape[1]), cells])
    Path(path).write_bytes(
        b"# vtk DataFile Version 3.0\nby hand\n" + (b"BINARY" if binary else b"ASCII")
        + b"\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n" + put(np.array([0.5]), ">f8")
        + f"\nPOINTS {len(nodes)} double\n".encode() + put(nodes, ">f8")
        + f"\nCELLS {len(cells)} {counted.size}\n".encode() + put(counted, ">i4")
        + f"\nCELL_TYPES {len(cells)}\n".encode() + put(np.asarray(types), ">i4") + b"\n"
    )


def writers():
    """name and extension -> function(path, nodes, cells, shape)"""
    def by_meshio(kind, **options):
        def write(path, nodes, cells, shape):
            mesh = meshio.Mesh(nodes, [(MESHIO_NAME[shape], cells)])
            with contextlib.redirect_stderr(io.StringIO()):  # it warns of text files
                meshio.write(path, mesh, file_format=kind, **options)
        return write

    def by_hand(function, *arguments, **options):
        return lambda path, nodes, cells, shape: function(
            path, nodes, cells, [VTK_TYPE[shape]] * len(cells), *arguments, **options)

    return {
        "msh22_text.msh": by_meshio("gmsh22", binary=False),
        "msh22_binary.msh": by_meshio("gmsh22", binary=True),
        "msh41_text.msh": by_meshio("gmsh", binary=False),
        "msh41_binary.msh": by_meshio("gmsh", binary=True),
        "vtk5_text.vtk": by_meshio("vtk", binary=False),
        "vtk5_binary.vtk": by_meshio("vtk", binary=True),
        "vtk3_text.vtk": by_hand(write_vtk4, False),
        "vtk3_binary.vtk": by_hand(write_vtk4, True),
        "vtu_text.vtu": by_meshio("vtu", binary=False),
        "vtu_base64.vtu": by_meshio("vtu", binary=True, compression=None),
        "vtu_zlib.vtu": by_meshio("vtu", binary=True, compression="zlib"),
        "vtu_inline64.vtu": by_hand(write_vtu, "inline", header="Q"),
        "vtu_inline_zlib64.vtu": by_hand(write_vtu, "inline", True, header="Q"),
        "vtu_raw.vtu": by_hand(write_vtu, "raw"),
        "vtu_raw64_big.vtu": by_hand(write_vtu, "raw", byte_order=">", header="Q"),
        "vtu_raw_zlib.vtu": by_hand(write_vtu, "raw", True),
        "vtu_appended64.vtu": by_hand(write_vtu, "base64", header="Q"),
        "vtu_appended_zlib_big.vtu": by_hand(write_vtu, "base64", True, byte_order=">"),
        "vtu_float.vtu": by_hand(write_vtu, "inline", size=4),
    }


COUNTS = [  # places where a file states how many nodes or cells it has
    rb"(?<=\$Nodes\n)\d+(?=\n)", rb"(?<=\$Elements\n)\d+(?=\n)",
    rb"(?<=\$Nodes\n1 )\d+", rb"(?<=\$Elements\n1 )\d+",
    rb"(?<=POINTS )\d+", rb"(?<=\nCELLS )\d+", rb"(?<=CELL_TYPES )\d+",
    rb'(?<=NumberOfPoints=")\d+', rb'(?<=NumberOfCells=")\d+',
]


def change_count(data, change):
    """Every stated count changed, one at a time."""
    for pattern in COUNTS:
        found = re.search(pattern, data)
        if found:
            yield data[: found.start()] + str(change(int(found.group()))).encode() + data[found.end() :]
    for name in (b"$Nodes\n", b"$Elements\n"):  # 4.1 binary: blocks, count
        at = data.find(name) + len(name)
        if name in data and data[at : at + 8] == struct.pack("<Q", 1):
            count = change(struct.unpack("<Q", data[at + 8 : at + 16])[0])
            yield data[: at + 8] + struct.pack("<q", count) + data[at + 16 :]


def broken(data):
    """reason -> contents"""
    random.seed(1)
    yield "empty", b""
    for tenth in (1, 3, 5, 7, 8, 9):
        yield f"cut{tenth}", data[: len(data) * tenth // 10]
    yield "random", bytes(random.randrange(256) for _ in data)
    yield "header", b"#!" + data[2:]
    yield "tail_only", data[len(data) // 3 :]
    for reason, change in {"less": lambda n: n - 1, "more": lambda n: n + 1, "negative": lambda n: -n,
                           "huge": lambda n: 10**15, "much": lambda n: 2**31 + n}.items():
        for i, contents in enumerate(change_count(data, change)):
            yield f"count_{reason}{i}", contents


def main():
    meshes = {}
    for shape in MESHIO_NAME:
        nodes = np.loadtxt(FOLDER / f"nodes_{shape}.txt")
        meshes[shape] = nodes, np.loadtxt(FOLDER / f"cells_{shape}.txt", dtype=int)
    for name, write in writers().items():
        for shape, (nodes, cells) in meshes.items():
            write(FOLDER / f"good_{shape}_{name}", nodes, cells, shape)
        nodes, cells = meshes["tet4"]
        for reason, contents in broken((FOLDER / f"good_tet4_{name}").read_bytes()):
            (FOLDER / f"bad_{reason}_{name}").write_bytes(contents)
        wrong = cells.copy()
        wrong[len(cells) // 2, 1] = len(nodes) + 3
        write(FOLDER / f"bad_node_{name}", nodes, wrong, "tet4")
        wrong = nodes.copy()
        wrong[len(nodes) // 2, 1] = np.nan
        write(FOLDER / f"bad_nan_{name}", wrong, cells, "tet4")


main()
