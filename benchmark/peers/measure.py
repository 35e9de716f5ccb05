"""Runs one row: its program on its model, several times where that is short, and what came of it."""
import math
import os
import resource
import subprocess
import time

import calculix
from model import Model, errors, read_states

SHORT = 3.0  # seconds: what takes less is run three times
LONGEST = 1800  # seconds on the clock: what takes longer is given up
PROGRAMS = {"jounce": "peer_own", "ARKODE": "peer_arkode", "PETSc": "peer_petsc", "Bullet": "peer_bullet", "CalculiX": "ccx"}
UNITS = {"ms": 1e-3, "us": 1e-6, "s": 1.0}


def seconds_of(text):
    for unit, size in UNITS.items():
        if text.endswith(unit):
            return float(text[:-len(unit)]) * size
    return float(text)


class Bench:
    """Where programs and files are, and the processor that they are held to."""

    def __init__(self, build, folder, core):
        self.build, self.folder, self.core = build, folder, core
        self.environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", CCX_NPROC_EQUATION_SOLVER="1")
        os.makedirs(folder, exist_ok=True)

    def path(self, program):
        """Of an executable; None where it is not."""
        name = PROGRAMS[program]
        if program == "CalculiX":
            return next((os.path.join(d, name) for d in os.environ["PATH"].split(":") if os.path.isfile(os.path.join(d, name))),
                        None)
        path = os.path.abspath(os.path.join(self.build, name))
        return path if os.path.isfile(path) else None

    def file(self, *parts):
        return os.path.join(self.folder, ".".join(parts))

    def call(self, words, folder=None):
        """Standard output and processor time; RuntimeError where the program fails."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            done = subprocess.run(words, cwd=folder, env=self.environment, capture_output=True, text=True, check=False,
                                  timeout=LONGEST, preexec_fn=lambda: os.sched_setaffinity(0, {self.core}))
        except subprocess.TimeoutExpired as late:
            raise RuntimeError(f"took longer than {LONGEST} s") from late
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            said = (done.stderr.strip() or done.stdout.strip()).splitlines()
            raise RuntimeError(said[-1][:200] if said else f"exit status {done.returncode}")
        return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def numbers_in(text):
    """Lines of a name and a number; where a name comes again, a list."""
    found = {}
    for line in text.splitlines():
        words = line.split()
        if len(words) == 2:
            found.setdefault(words[0], []).append(float(words[1]))
    return found


class Case:
    """A model of a problem: its mesh, its reference, and how programs are told what to run."""

    def __init__(self, bench, problem, name):
        self.bench, self.name = bench, f"{problem['name']}.{name}"
        self.model_of = problem["models"][name]
        self.span, self.samples = self.model_of["span"], self.model_of["samples"]
        self.scene = ["--scene", problem["scene"]]
        for text in problem["sets"] + self.model_of["sets"]:
            self.scene += ["--set", text]
        self.own = bench.path("jounce")
        self.text = bench.file(self.name, "model.txt")
        bench.call([self.own, "mesh", *self.options(), f"out={self.text}"])
        self.model = Model(self.text)
        self.mass = math.fsum(self.model.masses)
        states = bench.file(self.name, "reference.states")
        sets = [word for text in self.model_of["reference"] for word in ("--set", text)]
        bench.call([self.own, "run", *self.options(), *sets, "--frames", states])
        self.reference = read_states(states, self.model)
        self.exchanged = self.largest_kinetic()

    def options(self):
        return [*self.scene, "--span", repr(self.span), "--samples", str(self.samples)]

    def largest_kinetic(self):
        """At the times of the reference, over the mass [J/kg]: what an energy change is to be seen against."""
        masses = self.model.masses
        return max(math.fsum(0.5 * m * sum(v[3 * i + k] ** 2 for k in range(3)) for i, m in enumerate(masses)) / self.mass
                   for _, _, v in self.reference)

    def energy_change(self, states):
        """At the end of a file of states, by our energies on this model [J/kg]."""
        said, _ = self.bench.call([self.own, "energies", *self.options(), f"states={states}"])
        energies = numbers_in(said)["energy"]
        return energies[-1] - energies[0]


def words_for(case, row, frames):
    path, dt = case.bench.path(row["program"]), row["dt"]
    size = [f"dt={seconds_of(dt)!r}"] if dt else []
    if row["program"] == "jounce":
        return [path, "run", *case.options(), *[w for s in row["sets"] for w in ("--set", s)], "--frames", frames]
    if row["program"] == "Bullet":
        return [path, case.text, "--span", repr(case.span), "--samples", str(case.samples), "--frames", frames, *size,
                *row["words"]]
    factors = ["--set", "solver.method=direct"]  # what such a program asks us for is a factor that it may keep
    return [path, *case.options(), *factors, "--frames", frames, f"method={row['method']}", *size, *row["words"]]


def run_driver(case, row):
    """Of a program with a driver of ours: counts, seconds of each run, states, energy change."""
    frames = case.bench.file(case.name, "states")
    said = numbers_in(case.bench.call(words_for(case, row, frames))[0])
    taken = said["seconds"]
    while taken[0] < SHORT and len(taken) < 3:
        taken += numbers_in(case.bench.call(words_for(case, row, frames))[0])["seconds"]
    states = read_states(frames, case.model)
    if row["program"] == "Bullet" and case.model.axis:
        return {**{name: values[0] for name, values in said.items()}, "taken": taken}, states, math.nan  # not our energies
    return {**{name: values[0] for name, values in said.items()}, "taken": taken}, states, case.energy_change(frames)


def run_calculix_once(case, row, dt, folder):
    os.makedirs(folder, exist_ok=True)
    run = {"dt": dt, "span": case.span, "interval": case.span / case.samples, "alpha": row["alpha"], "contact": 200.0}
    calculix.write_input(calculix.input_name(folder) + ".inp", case.model, run)
    taken = case.bench.call([case.bench.path("CalculiX"), "-i", "model"], folder)[1]
    states, energies = calculix.read_output(calculix.input_name(folder) + ".dat", case.model)
    iterations = calculix.iterations(calculix.input_name(folder) + ".sta")
    return taken, states, energies, iterations


def run_calculix(case, row):
    """Its error of time is that against itself at half the step, times 4/3, as its methods have order two."""
    folder, dt = case.bench.file(case.name, "calculix"), seconds_of(row["dt"])
    taken, states, energies, iterations = run_calculix_once(case, row, dt, folder)
    _, finer, _, _ = run_calculix_once(case, row, dt / 2, folder)
    said = {"taken": [taken], "steps": len(iterations), "newton": sum(iterations), "finer": finer}
    weight = [sum(m * g * (x[3 * i + k] - node[k]) for i, (m, node) in enumerate(zip(case.model.masses, case.model.nodes))
                  for k, g in enumerate(case.model.gravity)) for _, x, _ in states[-1:]]
    start = math.fsum(0.5 * m * sum(c * c for c in v) for m, v in zip(case.model.masses, case.model.velocities))
    return said, states, (energies[-1] - weight[-1] - start) / case.mass


def measure(case, row):
    """A dictionary of what the table says of a row."""
    out = {"program": row["program"], "model": row["model"], "method": row["method"], "dt": row["dt"] or "",
           "label": row["label"], "span": case.span, "note": ""}
    if "why" in row:
        return {**out, "verdict": "left out", "note": row["why"]}
    if case.bench.path(row["program"]) is None:
        return {**out, "verdict": "not installed"}
    start = time.monotonic()
    try:
        said, states, change = (run_calculix if row["program"] == "CalculiX" else run_driver)(case, row)
    except (RuntimeError, ValueError, IndexError, KeyError) as problem:
        return {**out, "verdict": "failed", "note": str(problem)}
    rms, probe = errors(states, case.reference, case.model)
    if "finer" in said:
        out["model_difference"] = errors(said["finer"], case.reference, case.model)[0]
        rms, probe = (4 / 3 * e for e in errors(states, said["finer"], case.model))
    out.update(seconds=min(said["taken"]), slowest=max(said["taken"]), runs=len(said["taken"]),
               per_second=min(said["taken"]) / case.span, error=rms, probe=probe, energy=change,
               energy_share=change / case.exchanged, wall=time.monotonic() - start)
    out.update({name: said[name] for name in ("steps", "newton", "iterations", "factorizations") if name in said})
    return out
