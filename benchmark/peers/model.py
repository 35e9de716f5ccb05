"""Reads the model that peer_own has written as text, and files of states (peer.h)."""
import array
import math


class Model:
    """nodes: rest positions; velocities and masses beside them; held: (node, axis); cells: tuples of nodes."""

    def __init__(self, path):
        self.nodes, self.velocities, self.masses, self.held, self.cells = [], [], [], [], []
        self.planes, self.probes, self.gravity, self.material, self.axis = [], [], [0, 0, 0], None, None
        with open(path, encoding="utf-8") as file:
            for line in file:
                word, *rest = line.split()
                self._take(word, rest)

    def _take(self, word, rest):
        if word == "probe":
            self.probes.append(int(rest[1]))
        elif word in ("hex8", "tet4"):
            self.cells.append(tuple(map(int, rest)))
        elif word == "held":
            self.held.append(divmod(int(rest[0]), 3))
        elif word == "node":
            numbers = list(map(float, rest))
            self.nodes.append(numbers[:3])
            self.velocities.append(numbers[3:6])
            self.masses.append(numbers[6])
        elif word == "plane":
            self.planes.append(list(map(float, rest)))
        elif word == "gravity":
            self.gravity = list(map(float, rest))
        elif word == "thread":
            self.axis = list(map(float, rest[4:]))
        elif word == "material":
            self.material = list(map(float, rest))


def read_states(path, model):
    """A list of (t, x, v); x and v flat, 3 numbers a node."""
    numbers, n = array.array("d"), 3 * len(model.nodes)
    with open(path, "rb") as file:
        numbers.frombytes(file.read())
    width = 1 + 2 * n
    return [(numbers[k], numbers[k + 1:k + 1 + n], numbers[k + 1 + n:k + width]) for k in range(0, len(numbers), width)]


def points_compared(x, model):
    """All nodes; of a thread the points of its frames on the axis, which its peers have too."""
    if model.axis is None:
        return x
    return [math.fsum(model.axis[n] * x[9 * frame + 3 * n + k] for n in range(3))
            for frame in range(len(model.nodes) // 3) for k in range(3)]


def distance(a, b, nodes=None):
    """Root of the mean square distance of nodes, of all of them unless some are named."""
    if nodes is None:
        return math.sqrt(3 * math.fsum((p - q) ** 2 for p, q in zip(a, b)) / len(a))
    return math.sqrt(math.fsum((a[3 * i + k] - b[3 * i + k]) ** 2 for i in nodes for k in range(3)) / len(nodes))


def errors(states, reference, model):
    """Largest distance from the reference at any of its times over the largest displacement in it: of all nodes in the root
    mean square, and of the probe alone. NaN where a number is not finite or a time is missing."""
    rest = points_compared([c for node in model.nodes for c in node], model)
    if len(states) != len(reference) or any(abs(s[0] - r[0]) > 1e-6 * r[0] for s, r in zip(states, reference)):
        return math.nan, math.nan
    ours = [points_compared(r[1], model) for r in reference]
    theirs = [points_compared(s[1], model) for s in states]
    probe = [n // (3 if model.axis else 1) for n in model.probes[:1]] or None
    found = []
    for nodes in (None, probe):
        off = [distance(a, b, nodes) for a, b in zip(theirs, ours)]
        found.append(max(off) / max(distance(b, rest, nodes) for b in ours) if all(map(math.isfinite, off)) else math.nan)
    return tuple(found)
