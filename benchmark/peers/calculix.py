"""CalculiX on a model of ours: writes its input, runs it, reads states and energies back.

Elements C3D8 with consistent masses; law *HYPERELASTIC, NEO HOOKE: C10 (I1 J^-2/3 - 3) + (J - 1)^2 / D1, with the shear and bulk
modulus of small strains that our material has. A plane becomes the face of a block of one element that is held, against
which the nodes of the body's surface press with a linear pressure of 'contact' times Young's modulus over a metre.
"""
import collections
import math
import os

# Faces of a hexahedron in CalculiX's order, by local nodes from 0.
FACES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]


def real(value):
    """In the 20 characters that CalculiX reads."""
    return f"{value:.12g}"


def rows(numbers, width=12):
    return "".join(", ".join(map(str, numbers[k:k + width])) + ",\n" for k in range(0, len(numbers), width))


def surface_nodes(model):
    count = collections.Counter(frozenset(cell[k] for k in face) for cell in model.cells for face in FACES)
    return sorted({node for face, times in count.items() if times == 1 for node in face})


def plane_lines(model, young, contact):
    """A block under a plane whose normal is y, and the contact with it."""
    first, height, half, depth = len(model.nodes) + 1, model.planes[0][1], 2.0, 1.0
    corners = [(x, y, z) for y in (height - depth, height) for x, z in
               ((-half, half), (half, half), (half, -half), (-half, -half))]
    yield "*NODE, NSET=PLATE\n"
    for k, corner in enumerate(corners):
        yield f"{first + k}, " + ", ".join(map(str, corner)) + "\n"
    yield f"*ELEMENT, TYPE=C3D8, ELSET=PLATE\n{len(model.cells) + 1}, " + ", ".join(str(first + k) for k in range(8)) + "\n"
    yield "*SOLID SECTION, ELSET=PLATE, MATERIAL=RUBBER\n*BOUNDARY\nPLATE, 1, 3\n"
    yield "*SURFACE, NAME=FLOOR, TYPE=ELEMENT\nPLATE, S2\n"
    yield "*NSET, NSET=SKIN\n" + rows([k + 1 for k in surface_nodes(model)])
    yield "*SURFACE, NAME=BODY, TYPE=NODE\nSKIN\n"
    yield "*CONTACT PAIR, INTERACTION=MEET, TYPE=NODE TO SURFACE\nBODY, FLOOR\n"
    yield f"*SURFACE INTERACTION, NAME=MEET\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{real(contact * young)}, 0.\n"


def write_input(path, model, run):
    density, young, poisson = model.material
    shear, bulk = young / (2 * (1 + poisson)), young / (3 * (1 - 2 * poisson))
    weight = math.hypot(*model.gravity)
    with open(path, "w", encoding="utf-8") as out:
        out.write("*NODE, NSET=ALL\n")
        out.writelines(f"{k + 1}, " + ", ".join(map(real, x)) + "\n" for k, x in enumerate(model.nodes))
        out.write("*ELEMENT, TYPE=C3D8, ELSET=ALL\n")
        out.writelines(f"{k + 1}, " + ", ".join(str(n + 1) for n in cell) + "\n" for k, cell in enumerate(model.cells))
        out.write(f"*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, NEO HOOKE\n{real(shear / 2)}, {real(2 / bulk)}\n*DENSITY\n{real(density)}\n")
        out.write("*SOLID SECTION, ELSET=ALL, MATERIAL=RUBBER\n")
        if model.held:
            out.write("*BOUNDARY\n")
        out.writelines(f"{node + 1}, {axis + 1}, {axis + 1}\n" for node, axis in model.held)
        if model.planes:
            out.writelines(plane_lines(model, young, run["contact"]))
        if any(any(v) for v in model.velocities):
            out.write("*INITIAL CONDITIONS, TYPE=VELOCITY\n")
            out.writelines(f"{k + 1}, {axis + 1}, {real(v[axis])}\n" for k, v in enumerate(model.velocities) for axis in range(3)
                           if v[axis])
        steps = round(run["interval"] / run["dt"])
        alpha = "" if run["alpha"] is None else f", ALPHA={run['alpha']}"
        out.write(f"*STEP, NLGEOM, INC=1000000, AMPLITUDE=STEP\n*DYNAMIC, DIRECT{alpha}\n{real(run['dt'])}, {real(run['span'])}\n")
        out.write(f"*DLOAD\nALL, GRAV, {real(weight)}, " + ", ".join(real(g / weight) for g in model.gravity) + "\n")
        out.write(f"*NODE PRINT, NSET=ALL, FREQUENCY={steps}\nU, V\n")
        out.write(f"*EL PRINT, ELSET=ALL, FREQUENCY={steps}, TOTALS=ONLY\nELSE, ELKE\n*END STEP\n")


def read_output(path, model):
    """States as (t, x, v), and the sum of elastic and kinetic energy at their times [J]."""
    states, energies, what, t = {}, collections.defaultdict(float), None, 0.0
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if " and time " in line:
                what, t = line, float(words[-1])
                states.setdefault(t, ([0.0] * 3 * len(model.nodes), [0.0] * 3 * len(model.nodes)))
            elif len(words) == 4 and what.lstrip().startswith(("displacements", "velocities")):
                node = int(words[0]) - 1
                states[t][what.lstrip()[0] == "v"][3 * node:3 * node + 3] = map(float, words[1:])
            elif len(words) == 1 and "energy" in what:
                energies[t] += float(words[0])
    rest = [c for node in model.nodes for c in node]
    out = [(t, [a + b for a, b in zip(rest, u)], v) for t, (u, v) in sorted(states.items())]
    return out, [energies[t] for t, *_ in out]


def input_name(folder):
    return os.path.join(folder, "model")


def iterations(path):
    """Newton iterations of each increment that was accepted."""
    with open(path, encoding="utf-8") as file:
        rows_of = [line.split() for line in file]
    return [int(words[3]) for words in rows_of if len(words) == 7 and words[0].isdigit()]
