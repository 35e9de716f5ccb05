#!/usr/bin/env python3
"""Independent reference of the double-clamped beam: M a = f(x) stepped by diagonally implicit Runge-Kutta methods.

Box 0.25 x 0.25 x 2 m along z, 4 x 4 x 32 hex8 with 2 x 2 x 2 Gauss points, density 1000 kg/m^3, E = 1e5 Pa, nu = 0.4,
consistent mass, both end faces clamped, gravity -9.81 m/s^2 along y, at rest and undeformed at t = 0, no damping.
Every stage is solved by Newton with the exact tangent, from a = 0, until |M a - f| <= 1e-12 of the weight.

It shares no code with the engine: numpy over all elements at once, LAPACK banded Cholesky.

    reference_beam.py > test/reference/beam.csv               all rows, about three minutes
    reference_beam.py --method sdirk2 --dt 0.033 --steps 100  one run, a row after each step
    reference_beam.py --check                                 tableaus, derivatives of the laws and known values
"""
import argparse
import os
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")
import numpy as np
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded, solve_banded

SIZE, CELLS = np.array([0.25, 0.25, 2.0]), np.array([4, 4, 32])
DENSITY, YOUNG, POISSON, GRAVITY = 1000.0, 1e5, 0.4, 9.81
MU, LAMBDA = YOUNG / (2 * (1 + POISSON)), YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
TOLERANCE = 1e-12  # of the weight, 2-norm of the residual over the free degrees of freedom
EYE = np.eye(3)

# name: (order, rows of A up to the diagonal, then b)
TABLEAUS = {
    "backward_euler": (1, """
        1
        1"""),
    "sdirk2": (2, """
        0.29289321881345247559
        0.70710678118654752440 0.29289321881345247559
        0.70710678118654752440 0.29289321881345247559"""),
    "sdirk3": (3, """
        0.43586652150845899941
        0.28206673924577050029 0.43586652150845899941
        1.20849664917601007033 -0.6443631706844690697 0.43586652150845899941
        1.20849664917601007033 -0.6443631706844690697 0.43586652150845899941"""),
    "tr_bdf2": (2, """
        0
        0.29289321881345247559 0.29289321881345247559
        0.35355339059327376220 0.35355339059327376220 0.29289321881345247559
        0.35355339059327376220 0.35355339059327376220 0.29289321881345247559"""),
    "tr_bdf2_b": (2, """
        0
        0.25 0.25
        0.33333333333333333333 0.33333333333333333333 0.33333333333333333333
        0.33333333333333333333 0.33333333333333333333 0.33333333333333333333"""),
    "sdirk_ncs23": (3, """
        0.78867513459481288225
        -0.5773502691896257645 0.78867513459481288225
        0.5 0.5"""),
    "sdirk_nc34": (4, """
        1.06857902130162880641
        -0.5685790213016288064 1.06857902130162880641
        2.13715804260325761283 -3.2743160852065152256 1.06857902130162880641
        0.12888640051572042236 0.74222719896855915527 0.12888640051572042236"""),
    "sdirk_3345": (3, """
        1.06857902130162880641
        -0.9795586393701340109 1.06857902130162880641
        0 -0.3658114638130657109 1.06857902130162880641
        0 0.33037635945863359542 0.66962364054136640457"""),
    "sdirk_4347": (3, """
        1.28057976127530545730
        -0.9316494752114317229 1.28057976127530545730
        0 -0.5218811893179315090 1.28057976127530545730
        0 0 -1.1027049771310167112 1.28057976127530545730
        0 0 0.55460059077224693704 0.44539940922775306295"""),
    "implicit_midpoint": (2, """
        0.5
        1"""),
    "trapezoid": (2, """
        0
        0.5 0.5
        0.5 0.5"""),
    "esdirk324": (3, """
        0
        0.43586652150845899941 0.43586652150845899941
        0.25764824606642724579 -0.0935147675748862452 0.43586652150845899941
        0.18764102434672382516 -0.5952974735769549480 0.97178992772177212347 0.43586652150845899941
        0.18764102434672382516 -0.5952974735769549480 0.97178992772177212347 0.43586652150845899941"""),
    "esdirk325": (3, """
        0
        0.225 0.225
        0.27159902576697319299 0.27159902576697319299 0.225
        0.22374368670764581677 0.22374368670764581677 -0.0724873734152916335 0.225
        0.17554550212940522854 0.17554550212940522854 -0.3468582000260062242 0.77076719576719576719 0.225
        0.17554550212940522854 0.17554550212940522854 -0.3468582000260062242 0.77076719576719576719 0.225"""),
    "esdirk436": (4, """
        0
        0.25 0.25
        -0.0517766952966368811 -0.0517766952966368811 0.25
        -0.0765546083845572709 -0.0765546083845572709 0.52810921676911454192 0.25
        -0.7274063478261298469 -0.7274063478261298469 1.58499506174067934583 0.65981763391158034803 0.25
        -0.0155876350357165007 -0.0155876350357165007 0.38765767091320333128 0.50177261957216316593 -0.1082550204139334957 0.25
        -0.0155876350357165007 -0.0155876350357165007 0.38765767091320333128 0.50177261957216316593 -0.1082550204139334957 0.25"""),
}


def tableau(name):
    order, text = TABLEAUS[name]
    rows = [[float(word) for word in line.split()] for line in text.split("\n") if line.strip()]
    a = np.zeros((len(rows) - 1, len(rows) - 1))
    for i, row in enumerate(rows[:-1]):
        a[i, : i + 1] = row
    return order, a, np.array(rows[-1])


# ---- laws: F [n,3,3] and the rotations R of the start of the step -> energy density, P, dP/dF [n,9,9] ----

def epsilon():
    e = np.zeros((3, 3, 3))
    e[0, 1, 2] = e[1, 2, 0] = e[2, 0, 1] = 1
    e[0, 2, 1] = e[2, 1, 0] = e[1, 0, 2] = -1
    return e


# d cof(F)_ia / d F_jb = COFACTOR_iajbkc F_kc, hence cof F = (1/2) COFACTOR F F
COFACTOR = np.einsum("ijk,abc->iajbkc", epsilon(), epsilon()).reshape(9, 9, 9)


def outer(a, b):
    return a.reshape(-1, 9, 1) * b.reshape(-1, 1, 9)


def times(s, a):
    return s.reshape((-1,) + (1,) * (a.ndim - 1)) * a


def stable_neo_hookean(F, R):
    """psi = mu/2 (I - 3) + lambda/2 (J - alpha)^2 - mu/2 ln(I + 1) - psi(identity), with re-mapped constants."""
    mu, lam = 4 * MU / 3, LAMBDA + 5 * MU / 6
    alpha = 1 + mu / lam - mu / (4 * lam)
    I, J = np.einsum("nij,nij->n", F, F), np.linalg.det(F)
    dC = np.tensordot(F.reshape(-1, 9), COFACTOR, (1, 2))
    C = 0.5 * np.einsum("nab,nb->na", dC, F.reshape(-1, 9)).reshape(-1, 3, 3)
    psi = mu / 2 * (I - 3) + lam / 2 * (J - alpha) ** 2 - mu / 2 * np.log((I + 1) / 4) - lam / 2 * (1 - alpha) ** 2
    P = times(mu * (1 - 1 / (I + 1)), F) + times(lam * (J - alpha), C)
    H = times(mu * (1 - 1 / (I + 1)), np.broadcast_to(np.eye(9), dC.shape)) + times(2 * mu / (I + 1) ** 2, outer(F, F))
    return psi, P, H + lam * outer(C, C) + times(lam * (J - alpha), dC)


def hooke(strain):
    """Energy and stress of Hooke's law for symmetric strains [n,3,3]."""
    trace = np.einsum("nii->n", strain)
    psi = MU * np.einsum("nij,nij->n", strain, strain) + LAMBDA / 2 * trace ** 2
    return psi, 2 * MU * strain + times(LAMBDA * trace, np.broadcast_to(EYE, strain.shape))


# d stress_ij / d strain_kl
HOOKE = MU * (np.einsum("ik,jl->ijkl", EYE, EYE) + np.einsum("il,jk->ijkl", EYE, EYE)) + LAMBDA * np.einsum(
    "ij,kl->ijkl", EYE, EYE)


def linear(F, R):
    psi, P = hooke((F + F.transpose(0, 2, 1)) / 2 - EYE)
    return psi, P, np.broadcast_to(HOOKE.reshape(9, 9), (len(F), 9, 9))


def st_venant_kirchhoff(F, R):
    psi, S = hooke((F.transpose(0, 2, 1) @ F - EYE) / 2)
    H = np.einsum("nia,abcd,njc->nibjd", F, HOOKE, F, optimize=True) + np.einsum("ij,nbd->nibjd", EYE, S)
    return psi, F @ S, H.reshape(-1, 9, 9)


def signed_svd(F):
    """F = U diag(s) V^T with rotations U and V; the smallest s carries the sign of det F."""
    U, s, Vt = np.linalg.svd(F)
    flip_u, flip_v = np.linalg.det(U) < 0, np.linalg.det(Vt) < 0
    U[flip_u, :, 2] *= -1
    Vt[flip_v, 2, :] *= -1
    s[flip_u ^ flip_v, 2] *= -1
    return U, s, Vt


def rotation(F):
    U, _, Vt = signed_svd(F)
    return U @ Vt


def corotated_frozen(F, R):
    """Hooke's law for sym(R^T F) - 1 with R constant over the step."""
    G = R.transpose(0, 2, 1) @ F
    psi, S = hooke((G + G.transpose(0, 2, 1)) / 2 - EYE)
    H = np.einsum("nia,abcd,njc->nibjd", R, HOOKE, R, optimize=True)
    return psi, R @ S, H.reshape(-1, 9, 9)


def corotated(F, _):
    """Hooke's law for R^T F - 1 with R the rotation of F itself, and its exact tangent."""
    U, s, Vt = signed_svd(F)
    R = U @ Vt
    psi, S = hooke(np.einsum("nka,nk,nkb->nab", Vt, s - 1, Vt))
    dR = np.zeros((len(F), 9, 9))
    for i, j in ((0, 1), (0, 2), (1, 2)):
        twist = (U[:, :, i, None] * Vt[:, j, None, :] - U[:, :, j, None] * Vt[:, i, None, :]).reshape(-1, 9)
        dR += times(1 / (s[:, i] + s[:, j]), outer(twist, twist))
    H = 2 * MU * np.eye(9) + LAMBDA * outer(R, R) + times(LAMBDA * (s.sum(1) - 3) - 2 * MU, dR)
    return psi, R @ S, H


LAWS = {law.__name__: law for law in (stable_neo_hookean, linear, st_venant_kirchhoff, corotated_frozen, corotated)}


# ---- the beam ----

class Beam:
    """Mesh, mass and forces; vectors are [dofs], dof = 3 node + axis, nodes counted along x, then y, then z."""

    def __init__(self, law):
        self.law = LAWS[law]
        nx, ny, nz = CELLS + 1
        z, y, x = np.meshgrid(*(np.linspace(0, SIZE[k], CELLS[k] + 1) for k in (2, 1, 0)), indexing="ij")
        self.rest = np.stack([x, y, z], -1).reshape(-1)
        number = np.arange(nx * ny * nz).reshape(nz, ny, nx)
        corners = [(i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
        cells = np.stack([number[k:nz - 1 + k, j:ny - 1 + j, i:nx - 1 + i].ravel() for i, j, k in corners], 1)
        self.dofs = (3 * cells[:, :, None] + np.arange(3)).reshape(-1, 24)
        self.middle = number[nz // 2, ny // 2, nx // 2]
        clamped = np.concatenate([number[0].ravel(), number[-1].ravel()])
        self.free = np.setdiff1d(np.arange(self.rest.size), (3 * clamped[:, None] + np.arange(3)).ravel())
        self.element(np.array(corners) * 2.0 - 1)
        self.bands()
        self.R = np.broadcast_to(EYE, (8 * len(cells), 3, 3))

    def element(self, signs):
        """Shape functions: all elements are equal boxes, so one table of N and dN/dX serves them all."""
        edge = SIZE / CELLS
        points = signs / np.sqrt(3.0)
        factors = (1 + signs[None] * points[:, None]) / 2  # [point, node, axis]
        N = factors.prod(2)
        gradient = np.empty((8, 8, 3))
        for k in range(3):
            others = [m for m in range(3) if m != k]
            gradient[:, :, k] = signs[:, k] / edge[k] * factors[:, :, others].prod(2)
        self.weight = edge.prod() / 8
        self.gradient = gradient
        # B[q]: 9 x 24, F_ib = delta_ib + sum_n u_ni dN_n/dX_b
        self.B = np.einsum("qnb,ij->qibnj", gradient, EYE).reshape(8, 9, 24)
        self.element_mass = np.kron(DENSITY * self.weight * N.T @ N, EYE)
        self.mass_total = DENSITY * SIZE.prod()

    def bands(self):
        """Positions of the elements' entries in the lower band of the matrix over the free dofs."""
        index = np.full(self.rest.size, -1)
        index[self.free] = np.arange(self.free.size)
        local = index[self.dofs]
        row, column = np.repeat(local, 24, 1).ravel(), np.tile(local, (1, 24)).ravel()
        self.width = int(np.max(row - column, where=(row >= 0) & (column >= 0), initial=0))
        self.keep = (column >= 0) & (row >= column)
        self.slot = ((row - column) * self.free.size + column)[self.keep]
        mass = np.broadcast_to(self.element_mass, (len(self.dofs), 24, 24)).ravel()
        self.mass_band = self.assemble(mass)
        self.load = np.zeros(self.rest.size)
        np.add.at(self.load, self.dofs, self.element_mass @ np.tile([0, -GRAVITY, 0], 8))

    def assemble(self, blocks):
        shape = (self.width + 1, self.free.size)
        return np.bincount(self.slot, blocks.ravel()[self.keep], shape[0] * shape[1]).reshape(shape)

    def scatter(self, element_vectors):
        return np.bincount(self.dofs.ravel(), element_vectors.ravel(), self.rest.size)

    def mass_times(self, a):
        return self.scatter(a[self.dofs] @ self.element_mass)

    def deformation(self, u):
        F = np.einsum("qkl,el->eqk", self.B, u[self.dofs], optimize=True).reshape(-1, 3, 3)
        return F + EYE

    def freeze(self, u):
        if self.law is corotated_frozen:
            self.R = rotation(self.deformation(u))

    def evaluate(self, u):
        """Elastic energy [J], total force [N] and the element stiffness [e,24,24]."""
        psi, P, H = self.law(self.deformation(u), self.R)
        P, H = P.reshape(-1, 8, 9), H.reshape(-1, 8, 9, 9)
        force = -self.weight * np.einsum("eqk,qkl->el", P, self.B, optimize=True)
        stiffness = np.zeros((len(self.dofs), 24, 24))
        for q in range(8):
            stiffness += self.B[q].T @ (H[:, q] @ self.B[q])
        return self.weight * psi.sum(), self.load + self.scatter(force), self.weight * stiffness

    def energies(self, u, v):
        """Kinetic, elastic and gravitational energy [J]."""
        return 0.5 * v @ self.mass_times(v), self.evaluate(u)[0], -self.load @ u


# ---- time steps ----

class NotConverged(Exception):
    pass


class Newton:
    """Find a with M a = f(u + h^2 a): full steps first; if they fail, again with line search on the residual norm."""

    def __init__(self, beam):
        self.beam = beam
        self.iterations = self.searches = self.indefinite = 0

    def residual(self, u, h, a):
        _, force, stiffness = self.beam.evaluate(u + h * h * a)
        return (self.beam.mass_times(a) - force)[self.beam.free], stiffness

    def direction(self, r, stiffness, h):
        beam = self.beam
        band = beam.mass_band + h * h * beam.assemble(stiffness)
        try:
            return -cho_solve_banded((cholesky_banded(band, lower=True), True), r)
        except LinAlgError:
            self.indefinite += 1
        w, n = beam.width, beam.free.size
        full = np.zeros((2 * w + 1, n))
        full[w:] = band
        for k in range(1, w + 1):
            full[w - k, k:] = band[k, :n - k]
        return -solve_banded((w, w), full, r)

    def solve(self, u, h):
        for search in (False, True):
            a = self.attempt(u, h, search)
            if a is not None:
                self.searches += search
                return a
        raise NotConverged

    def attempt(self, u, h, search):
        beam, a = self.beam, np.zeros(self.beam.rest.size)
        limit = TOLERANCE * beam.mass_total * GRAVITY
        r, stiffness = self.residual(u, h, a)
        for _ in range(200 if search else 40):
            norm = np.linalg.norm(r)
            if norm <= limit:
                return a
            if not norm < 1e12:
                return None
            self.iterations += 1
            step, scale = np.zeros_like(a), 1.0
            step[beam.free] = self.direction(r, stiffness, h)
            r, stiffness = self.residual(u, h, a + step)
            while search and not np.linalg.norm(r) < (1 - 1e-4 * scale) * norm:
                scale /= 2
                if scale < 1e-10:
                    return None
                r, stiffness = self.residual(u, h, a + scale * step)
            a = a + scale * step
        return None


def explicit_acceleration(beam, u):
    a = np.zeros_like(u)
    factor = cholesky_banded(beam.mass_band, lower=True)
    a[beam.free] = cho_solve_banded((factor, True), beam.evaluate(u)[1][beam.free])
    return a


def step(beam, newton, a_table, b, dt, u, v):
    """U_i = v~ + h V_i, M V_i = f(u + dt sum_j<i a_ij U_j + h U_i), v~ = v + dt sum_j<i a_ij V_j, h = a_ii dt."""
    U, V = [], []
    beam.freeze(u)
    for i in range(len(b)):
        h = a_table[i, i] * dt
        stage_v = v + dt * sum(a_table[i, j] * V[j] for j in range(i))
        stage_u = u + dt * sum(a_table[i, j] * U[j] for j in range(i)) + h * stage_v
        V.append(newton.solve(stage_u, h) if h else explicit_acceleration(beam, stage_u))
        U.append(stage_v + h * V[i])
    return u + dt * sum(w * k for w, k in zip(b, U)), v + dt * sum(w * k for w, k in zip(b, V))


def simulate(law, method, dt, wanted):
    """Rows after the wanted numbers of steps; the frozen law's energy takes the rotations of the reported state."""
    beam = Beam(law)
    newton = Newton(beam)
    _, a_table, b = tableau(method)
    u, v = np.zeros(beam.rest.size), np.zeros(beam.rest.size)
    for count in range(1, max(wanted) + 1):
        try:
            u, v = step(beam, newton, a_table, b, dt, u, v)
        except NotConverged:
            print(f"# {law} {method} dt={dt}: step {count} did not converge", file=sys.stderr)
            return
        if count in wanted:
            beam.freeze(u)
            kinetic, elastic, gravity = beam.energies(u, v)
            total = (kinetic + elastic + gravity) / beam.mass_total
            numbers = (count * dt, total, u[3 * beam.middle + 1], kinetic, elastic, gravity)
            yield f"{method},{dt:g},{count}," + ",".join(f"{x:.15g}" for x in numbers) + f",{law}", numbers
    print(f"# {law} {method} dt={dt}: {newton.iterations} iterations, {newton.searches} stages with line search, "
          f"{newton.indefinite} indefinite matrices", file=sys.stderr)


HEADER = "method,dt,steps,t,total_specific,mid_y_displacement,kinetic,elastic,gravity,law"


def all_runs():
    long_runs = ("backward_euler", "sdirk2", "tr_bdf2")
    for method in TABLEAUS:
        for dt in (0.033, 0.005):
            yield "stable_neo_hookean", method, dt, (1, 10, 100) if dt == 0.033 and method in long_runs else (1, 10)
    for law in LAWS:
        if law != "stable_neo_hookean":
            yield law, "sdirk2", 0.033, (1, 10)


# ---- self-check ----

def check_tableaus():
    """Order conditions of linear and quadrature type up to the stated order."""
    for name in TABLEAUS:
        order, a, b = tableau(name)
        c = a.sum(1)
        conditions = [b.sum() - 1, b @ c - 1 / 2, b @ c ** 2 - 1 / 3, b @ a @ c - 1 / 6, b @ c ** 3 - 1 / 4,
                      (b * c) @ a @ c - 1 / 8, b @ a @ c ** 2 - 1 / 12, b @ a @ a @ c - 1 / 24]
        worst = np.abs(conditions[: (0, 1, 2, 4, 8)[order]]).max()
        assert worst < 1e-14, (name, worst)
        print(f"{name}: order {order}, largest violation {worst:.1e}")


def check_laws():
    """P and dP/dF against central differences at random F, a third of them inverted; the step 1e-5 leaves 1e-8."""
    random = np.random.default_rng(1)
    F, R, step_size = EYE + 0.4 * random.standard_normal((60, 3, 3)), rotation(random.standard_normal((60, 3, 3))), 1e-5
    F[::3, :, 0] *= -1
    for name, law in LAWS.items():
        psi, P, H = law(F, R)
        worst = [0.0, 0.0]
        for k in range(9):
            d = np.zeros((3, 3))
            d.flat[k] = step_size
            plus, minus = law(F + d, R), law(F - d, R)
            slope_psi = (plus[0] - minus[0]) / (2 * step_size)
            slope_P = ((plus[1] - minus[1]) / (2 * step_size)).reshape(-1, 9)
            worst[0] = max(worst[0], (np.abs(slope_psi - P.reshape(-1, 9)[:, k]) / np.abs(P).max((1, 2))).max())
            worst[1] = max(worst[1], (np.abs(slope_P - H[:, :, k]).max(1) / np.abs(H).max((1, 2))).max())
        at_rest = law(EYE[None], EYE[None])
        assert max(worst) < 1e-6 and abs(at_rest[0][0]) < 1e-10 and np.abs(at_rest[1]).max() < 1e-10, (name, worst)
        assert np.allclose(symmetric(at_rest[2]), HOOKE.reshape(9, 9), rtol=1e-12, atol=1e-8), name
        print(f"{name}: force {worst[0]:.1e}, tangent {worst[1]:.1e} from central differences; Hooke's law at rest")


def symmetric(H):
    """dP/dF at rest acting on symmetric dF, which is all that Hooke's tensor sees."""
    sym = (np.einsum("ik,jl->ijkl", EYE, EYE) + np.einsum("il,jk->ijkl", EYE, EYE)).reshape(9, 9) / 2
    return (sym @ H @ sym)[0]


# (method, steps of 33 ms, specific energy, mid displacement or None), each rounded to the digits shown
KNOWN = [("backward_euler", 1, "-0.04392735", None), ("backward_euler", 100, "-1.404362", "-0.394169"),
         ("sdirk2", 1, "-1.115576e-4", "-0.0053415484"), ("sdirk2", 100, "-0.029018", "-0.548829")]


def check_known():
    for method in ("backward_euler", "sdirk2"):
        rows = {n: row for n, (_, row) in zip((1, 100), simulate("stable_neo_hookean", method, 0.033, (1, 100)))}
        for _, count, energy, middle in (known for known in KNOWN if known[0] == method):
            for text, value in ((energy, rows[count][1]), (middle, rows[count][2])):
                if text:
                    print(f"{method} after {count} steps: {value:.12g}, known {text}")
                    assert agrees(value, text), (method, count, value, text)


def agrees(value, text):
    """Equal to half a unit (and a little) of the last digit of `text`."""
    mantissa, _, exponent = text.partition("e")
    unit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(value - float(text)) <= 0.51 * unit


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="check tableaus, laws and known values")
    parser.add_argument("--method", choices=TABLEAUS, help="one run with this method")
    parser.add_argument("--law", choices=LAWS, default="stable_neo_hookean")
    parser.add_argument("--dt", type=float, default=0.033, help="time step [s]")
    parser.add_argument("--steps", type=int, default=10)
    options = parser.parse_args()
    if options.check:
        check_tableaus()
        check_laws()
        check_known()
        return
    runs = all_runs()
    if options.method:
        runs = [(options.law, options.method, options.dt, range(1, options.steps + 1))]
    print(HEADER)
    for run in runs:
        for row, _ in simulate(*run):
            print(row, flush=True)


if __name__ == "__main__":
    main()
