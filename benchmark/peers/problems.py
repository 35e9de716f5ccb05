"""What is compared: problems, their models, and a row for every program and method.

A model is our scene with some settings; every row belongs to one. Errors are measured against the model's reference, which
jounce computes on it with small steps. Peers with elements or laws of their own are given the model that is nearest to
theirs; `differs` says what remains.
"""

LUMPED = "bodies[0].mass=lumped"
TETS = "bodies[0].shape.element=tet4"
NEO_HOOKE = "bodies[0].material.law=neo_hookean"
LAG = "options=-snes_lag_jacobian 50 -snes_lag_jacobian_persists true"
LAG_LITTLE = "options=-snes_lag_jacobian 5 -snes_lag_jacobian_persists true"
LAG_PRECONDITIONER = "options=-snes_lag_preconditioner 50 -snes_lag_preconditioner_persists true"
BALANCE = "newton.tolerance=1e-4"


EXPLICIT = {"verlet", "pefrl", "symplectic_euler", "erk3", "erk4", "rk3bs", "rk5dp", "explicit", "rope explicit"}


def own(model, method, dt, *sets, label=""):
    return {"program": "jounce", "model": model, "method": method, "dt": dt, "label": label,
            "sets": [f"integrator.method={method}", f"step.dt={dt}", *sets]}


def foreign(program, model, method, dt=None, *words, label=""):
    return {"program": program, "model": model, "method": method, "dt": dt, "label": label, "words": list(words)}


def calculix(model, dt, alpha, label):
    return {"program": "CalculiX", "model": model, "method": "hht", "dt": dt, "alpha": alpha, "label": label}


def left_out(program, model, why):
    return {"program": program, "model": model, "method": "", "dt": None, "label": "", "why": why}


def ours_and_theirs(dt, half, stable, lag, model="lumped"):
    """Rows of programs that integrate our forces: implicit ones at dt and half of it, explicit ones at what is stable, for
    Verlet and for pefrl; PETSc keeps its Jacobian as `lag` says."""
    return [
        own(model, "sdirk2", dt, BALANCE),
        own(model, "newmark", dt, BALANCE),
        own(model, "sdirk2", dt, label="tolerance 1e-8"),
        own(model, "sdirk2", half, BALANCE),
        own(model, "verlet", stable[0]),
        own(model, "pefrl", stable[1]),
        foreign("ARKODE", model, "sdirk2", dt, "predictor=1", "coefficient=1"),
        foreign("ARKODE", model, "trbdf2", dt, "predictor=1", "coefficient=1"),
        foreign("ARKODE", model, "erk3", None, "relative=1e-3", "absolute=1e-5", label="adaptive 1e-3"),
        foreign("PETSc", model, "alpha2", dt, "tolerance=1e-4", lag, label="our factor, kept"),
        foreign("PETSc", model, "alpha2", dt, "tolerance=1e-4", "linear=pbjacobi", label="CG, block Jacobi"),
        foreign("PETSc", model, "alpha2", dt, "tolerance=1e-4", "linear=icc", LAG_PRECONDITIONER, label="CG, ICC kept"),
        foreign("PETSc", model, "rk3bs", None, "adapt=1", "relative=1e-3", "absolute=1e-5", label="adaptive 1e-3"),
    ]


BEAM = {
    "name": "beam",
    "scene": "scenes/beam.yaml",
    "sets": [],
    "models": {
        "lumped": {"sets": [LUMPED], "span": 0.5, "samples": 5, "reference": ["integrator.method=pefrl", "step.dt=0.5ms"]},
        "consistent": {"sets": [], "span": 0.5, "samples": 5,
                       "reference": ["integrator.method=sdirk_nc34", "step.dt=0.5ms", "newton.tolerance=1e-10"]},
        "tets": {"sets": [TETS, LUMPED], "span": 0.5, "samples": 5,
                 "reference": ["integrator.method=pefrl", "step.dt=0.5ms"]},
        "neo_hookean": {"sets": [NEO_HOOKE], "span": 0.5, "samples": 5,
                        "reference": ["integrator.method=sdirk_nc34", "step.dt=0.5ms", "newton.tolerance=1e-10"]},
    },
    "rows": [
        *ours_and_theirs("5ms", "2.5ms", ("2ms", "5ms"), LAG),
        own("lumped", "pefrl", "2.5ms"),
        own("lumped", "esdirk436", "10ms", "newton.tolerance=1e-6"),
        own("lumped", "ros34pw2", "5ms"),
        foreign("ARKODE", "lumped", "erk4", "2ms"),
        foreign("ARKODE", "lumped", "esdirk436", "10ms", "predictor=1", "coefficient=1"),
        foreign("PETSc", "lumped", "rk5dp", "2ms"),
        foreign("PETSc", "lumped", "cn", "5ms", "tolerance=1e-4", LAG),
        foreign("PETSc", "lumped", "bdf2", "5ms", "tolerance=1e-4", LAG),
        foreign("PETSc", "lumped", "rosw", "5ms"),
        own("consistent", "sdirk2", "5ms", BALANCE),
        own("consistent", "newmark", "5ms", BALANCE),
        foreign("ARKODE", "consistent", "sdirk2", "5ms", "predictor=1", "coefficient=1"),
        foreign("PETSc", "consistent", "alpha2", "5ms", "tolerance=1e-4", LAG, label="our factor, kept"),
        own("tets", "verlet", "1ms"),
        own("tets", "sdirk2", "5ms", BALANCE),
        own("tets", "backward_euler", "5ms", BALANCE),
        foreign("Bullet", "tets", "implicit", "5ms", "implicit=1"),
        foreign("Bullet", "tets", "implicit", "1ms", "implicit=1"),
        foreign("Bullet", "tets", "explicit", "1ms", "implicit=0"),
        own("neo_hookean", "newmark", "5ms", BALANCE),
        own("neo_hookean", "sdirk2", "5ms", BALANCE),
        calculix("neo_hookean", "5ms", 0, "alpha = 0"),
        calculix("neo_hookean", "5ms", None, "alpha = -0.05"),
    ],
}

CLOTH = {
    "name": "cloth",
    "scene": "scenes/cloth.yaml",
    "sets": ["bodies[0].drag=0", "gravity=[0, -9.81, 6]"],  # a steady wind across, as a force on all mass
    "models": {
        "lumped": {"sets": [LUMPED], "span": 0.1, "samples": 2, "reference": ["integrator.method=pefrl", "step.dt=0.2ms"]},
        "tets": {"sets": [TETS, LUMPED], "span": 0.1, "samples": 2,
                 "reference": ["integrator.method=pefrl", "step.dt=0.1ms"]},
        "neo_hookean": {"sets": [NEO_HOOKE], "span": 0.02, "samples": 1,
                        "reference": ["integrator.method=sdirk_nc34", "step.dt=1ms", "newton.tolerance=1e-9"]},
    },
    "rows": [
        *ours_and_theirs("5ms", "2.5ms", ("0.25ms", "0.5ms"), LAG_LITTLE),
        own("tets", "verlet", "0.2ms"),
        own("tets", "sdirk2", "5ms", BALANCE),
        foreign("Bullet", "tets", "implicit", "5ms", "implicit=1"),
        foreign("Bullet", "tets", "explicit", "0.2ms", "implicit=0"),
        own("neo_hookean", "newmark", "5ms", BALANCE),
        calculix("neo_hookean", "5ms", 0, "alpha = 0"),
    ],
}

WITHOUT_CONTACT = "it has no contact, and a floor of springs would be another problem"
BALL = {
    "name": "ball",
    "scene": "scenes/ball.yaml",
    "sets": ["bodies[0].shape.center=[0, 0.55, 0]", "bodies[0].velocity=[0, -6.9, 0]"],  # just before it lands
    "models": {
        "consistent": {"sets": [], "span": 0.15, "samples": 3,
                       "reference": ["integrator.method=sdirk2", "step.dt=0.25ms"]},
        "tets": {"sets": [TETS, LUMPED], "span": 0.15, "samples": 3,
                 "reference": ["integrator.method=verlet", "step.dt=0.1ms"]},
        "neo_hookean": {"sets": [NEO_HOOKE], "span": 0.1, "samples": 2,
                        "reference": ["integrator.method=sdirk2", "step.dt=0.25ms"]},
    },
    "rows": [
        own("consistent", "sdirk2", "5ms", BALANCE),
        own("consistent", "sdirk2", "2.5ms", BALANCE),
        left_out("ARKODE", "consistent", WITHOUT_CONTACT),
        left_out("PETSc", "consistent", WITHOUT_CONTACT),
        own("tets", "sdirk2", "5ms", BALANCE),
        own("tets", "backward_euler", "5ms", BALANCE),
        own("tets", "verlet", "0.4ms"),
        foreign("Bullet", "tets", "implicit", "5ms", "implicit=1"),
        foreign("Bullet", "tets", "implicit", "1ms", "implicit=1"),
        foreign("Bullet", "tets", "implicit", "0.5ms", "implicit=1"),
        foreign("Bullet", "tets", "explicit", "0.1ms", "implicit=0"),
        own("neo_hookean", "newmark", "5ms", BALANCE),
        own("neo_hookean", "sdirk2", "5ms", BALANCE),
        own("neo_hookean", "sdirk2", "2ms", BALANCE),
        calculix("neo_hookean", "2ms", None, "alpha = -0.05, stiff springs as floor"),
    ],
}

THREAD = {
    "name": "thread",
    "scene": "scenes/thread.yaml",
    "sets": [],
    "models": {
        "frames": {"sets": [], "span": 0.5, "samples": 5, "reference": ["integrator.method=rk4", "step.dt=0.005ms"]},
    },
    "rows": [
        own("frames", "symplectic_euler", "0.2ms"),
        own("frames", "verlet", "0.2ms"),
        own("frames", "verlet", "0.1ms"),
        own("frames", "sdirk2", "5ms", BALANCE),
        own("frames", "sdirk2", "1ms", BALANCE),
        foreign("ARKODE", "frames", "erk3", None, "relative=1e-3", "absolute=1e-5", label="adaptive 1e-3"),
        foreign("ARKODE", "frames", "erk4", "0.2ms"),
        foreign("ARKODE", "frames", "sdirk2", "1ms", "predictor=1", "coefficient=1"),
        foreign("PETSc", "frames", "rk3bs", "0.2ms"),
        foreign("PETSc", "frames", "alpha2", "1ms", "tolerance=1e-4", LAG, label="our factor, kept"),
        foreign("Bullet", "frames", "rope implicit", "1ms", "implicit=1"),
        foreign("Bullet", "frames", "rope explicit", "0.2ms", "implicit=0"),
    ],
}

PROBLEMS = [BEAM, CLOTH, BALL, THREAD]

# What a peer computes beside what it is given, for the page.
DIFFERS = {
    "ARKODE": "nothing: our forces and our factors, its methods",
    "PETSc": "nothing: our forces, its methods, our factors or its own iterative solvers on our matrix",
    "Bullet": "single precision; a thread becomes a chain of points and springs without bending or twist",
    "CalculiX": "the law C10 (I1 J^-2/3 - 3) + (J - 1)^2 / D1 in place of mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2",
}
