#!/usr/bin/python3
"""A second program for the same jet: what the C++ is compared with, bead by bead (independent-*.csv beside this file).

Written from the paper and sharing nothing with the rest of the tree: CGS units throughout, no scaling, no dense output.
Solved by SciPy's Dormand-Prince pair of order 8; an event is approached by integrating anew up to where Newton's method
puts its zero.

    independent_jet.py DECK T...    table of all beads at these times in s, with the slope of each
    independent_jet.py DECK --slopes TABLE    the same table, its slopes computed from the states it holds
"""

import math
import re
import sys

import numpy as np

COLUMNS = "t,id,held,x,y,z,vx,vy,vz,stress,ax,ay,az,stress_rate"


def read_deck(path):
    """Directives by their words: a number, or True for yes; no units, no lists."""
    deck = {}
    for line in open(path):
        words = re.split(r"[#!]", line)[0].split()
        if len(words) > 1 and words[0] not in ("print", "printstat"):
            value = {"yes": "1", "no": "0"}.get(words[-1], words[-1]).replace("d", "e")
            deck[" ".join(words[:-1])] = float(value)
    return deck


class Jet:
    """Rows are beads, the oldest first; r, v and stress of row i are those of the bead and of the element above it."""

    def __init__(self, deck):
        get = lambda words, default=0.0: deck.get(words, default)
        points = int(deck["points"])
        self.l_step, self.a0 = deck["initial length"] / points, deck["nozzle cross"]
        volume = math.pi * self.a0**2 * self.l_step
        self.m, self.q = deck["density mass"] * volume, deck["density charge"] * volume
        self.mu, self.G = deck["viscosity"], deck["elastic modulus"]
        self.alpha, self.h = get("surface tension"), deck["collector distance"]
        self.push = self.q * get("external potential") / self.h / self.m + 980.665 * get("gravity")
        self.speed, self.omega, self.A = get("nozzle velocity"), get("perturb freq"), get("perturb ampl") * get("perturb")
        self.yield_stress = get("yield stress")
        self.k, self.nu = (get("hbfluid consistency", 1.0), get("hbfluid index", 1.0)) if get("hbfluid") else (1.0, 1.0)
        self.reach = math.ceil(deck["cutoff"] / self.l_step) if "cutoff" in deck else None
        self.inserting, self.removing = get("inserting"), get("removing")

        self.t, self.held, self.number = 0.0, False, list(range(1, points + 1))
        self.r, self.v = np.zeros((points, 3)), np.zeros((points, 3))
        self.r[:, 0] = self.l_step * np.arange(points, 0, -1)
        self.v[:, 0] = self.speed
        self.stress = np.full(points, get("nozzle stress"))

    def nozzle(self, t):
        """Its position and velocity."""
        c, s = math.cos(self.omega * t), math.sin(self.omega * t)
        return self.A * np.array([0, c, s]), np.array([self.speed, -self.A * self.omega * s, self.A * self.omega * c])

    def held_bead(self, r, nozzle):
        """Position, on the chord to the youngest bead at r, and the part of its charge that has faded in."""
        d = np.linalg.norm(r - nozzle)
        return nozzle + self.l_step / d * (r - nozzle), (1 - math.cos(2 * math.pi * (d / self.l_step - 1.5))) / 2 if d > 1.5 * self.l_step else 0.0

    def slopes(self, t, r, v, stress):
        """dv/dt and d(stress)/dt."""
        n = len(r)
        nozzle, nozzle_v = self.nozzle(t)
        d, w = r - np.vstack([r[1:], nozzle]), v - np.vstack([v[1:], nozzle_v])
        l = np.sqrt((d**2).sum(1))
        rate = (d * w).sum(1) / l**2
        radius2 = self.a0**2 * self.l_step / l
        viscous = np.sign(rate) * (self.yield_stress + self.mu * self.k * np.abs(rate) ** self.nu)
        stress_rate = self.G / self.mu * (viscous - stress)

        pull = (math.pi * radius2 * stress / l)[:, None] * d  # of the element on its bead, towards the nozzle
        force = -pull
        force[1:] += pull[:-1]
        points, charge, above = np.vstack([r, nozzle]), np.ones(n + 1), nozzle
        if self.held:
            above, part = self.held_bead(r[-1], nozzle)
            points, charge = np.vstack([r, above, nozzle]), np.r_[np.ones(n), part, 1]
        force += self.coulomb(r, points, charge)
        if self.alpha and n > 1:
            force[1:] += self.surface_tension(np.vstack([r, above]), radius2)
        acceleration = force / self.m
        acceleration[:, 0] += self.push
        return acceleration, stress_rate

    def coulomb(self, r, points, charge):
        d = r[:, None] - points
        d2 = (d**2).sum(2)
        same = np.eye(len(r), len(points), dtype=bool)
        weight = np.where(same, 0, charge / np.where(same, 1, d2) ** 1.5)
        if self.reach:
            weight[abs(np.subtract.outer(np.arange(len(r)), np.arange(len(points)))) > self.reach] = 0
        return self.q**2 * (weight[:, :, None] * d).sum(1)

    def surface_tension(self, p, radius2):
        """alpha pi a^2 k towards the centre of the circle through a bead and its neighbours; a the mean of both elements'."""
        A, B = p[:-2] - p[1:-1], p[2:] - p[1:-1]
        A2, B2, C2 = ((x**2).sum(1)[:, None] for x in (A, B, A - B))
        curvature = 2 * np.cross(A2 * B - B2 * A, np.cross(A, B)) / (A2 * B2 * C2)
        a = (np.sqrt(radius2[:-1]) + np.sqrt(radius2[1:])) / 2
        return (self.alpha * math.pi * a**2)[:, None] * curvature

    # the solution as one vector, for the solver

    def packed(self):
        return np.concatenate([self.r.ravel(), self.v.ravel(), self.stress])

    def unpack(self, y):
        n = len(self.stress)
        return y[: 3 * n].reshape(n, 3), y[3 * n : 6 * n].reshape(n, 3), y[6 * n :]

    def derivative(self, t, y):
        r, v, stress = self.unpack(y)
        a, rate = self.slopes(t, r, v, stress)
        return np.concatenate([v.ravel(), a.ravel(), rate])

    def solver(self, end, step=None):
        from scipy.integrate import DOP853

        unit = np.concatenate([np.full(self.r.size, 0.1), np.full(self.v.size, 100.0), np.full(self.stress.size, self.G)])
        return DOP853(self.derivative, self.t, self.packed(), end, rtol=1e-11, atol=1e-13 * unit, first_step=step)

    def go(self, t, y):
        self.t, (self.r, self.v, self.stress) = t, (part.copy() for part in self.unpack(y))

    # events

    def insertion_overdue(self, t, y):
        return np.linalg.norm(self.unpack(y)[0][-1] - self.nozzle(t)[0]) - (2 if self.held else 1.5) * self.l_step

    def removal_overdue(self, t, y):
        return self.unpack(y)[0][0, 0] - self.h

    def insert(self):
        if self.held:
            place, _ = self.held_bead(self.r[-1], self.nozzle(self.t)[0])
            self.v = np.vstack([self.v, (self.v[-1] + [self.speed, 0, 0]) / 2])
            self.r, self.stress = np.vstack([self.r, place]), np.append(self.stress, 0.0)
            self.number.append(self.number[-1] + 1)
        self.held = not self.held

    def remove(self):
        self.r, self.v, self.stress, self.number = self.r[1:], self.v[1:], self.stress[1:], self.number[1:]

    def to(self, end):
        kinds = [k for on, *k in ((self.inserting, self.insertion_overdue, self.insert), (self.removing, self.removal_overdue, self.remove)) if on]
        while self.t < end:
            solver, due = self.solver(end), []
            while solver.status == "running" and not due:
                before = solver.t, solver.y.copy()
                message = solver.step()
                if solver.status == "failed":
                    raise RuntimeError(message)
                due = [self.zero(overdue, before, solver) + (apply,) for overdue, apply in kinds if overdue(solver.t, solver.y) >= 0]
            if not due:
                self.go(solver.t, solver.y)
                continue
            t, y, apply = min(due, key=lambda event: event[0])
            self.go(t, y)
            apply()
            for overdue, apply in 2 * kinds:  # what has become due at the same instant
                if overdue(self.t, self.packed()) >= -1e-13 * self.l_step:
                    apply()

    def zero(self, overdue, before, solver):
        """Time and state at which it is: a first guess from the step's interpolant, then Newton on solutions up to there."""
        from scipy.optimize import brentq

        between = solver.dense_output()
        t = brentq(lambda t: overdue(t, between(t)), before[0], solver.t, xtol=1e-18) if overdue(*before) < 0 else before[0]
        for _ in range(6):
            self.go(*before)
            part = self.solver(t, step=t - before[0]) if t > before[0] else None
            while part and part.status == "running":
                part.step()
            y = part.y if part else before[1]
            late, dt = overdue(t, y), 1e-9
            if abs(late) < 1e-14 * self.l_step:
                break
            t -= late * dt / (overdue(t + dt, y + dt * self.derivative(t, y)) - late)
        return t, y

    def rows(self):
        a, rate = self.slopes(self.t, self.r, self.v, self.stress)
        numbers = np.column_stack([self.r, self.v, self.stress, a, rate])
        for number, row in zip(self.number, numbers):
            yield ",".join([repr(self.t), str(number), str(int(self.held))] + [f"{x:.13g}" for x in row])


def with_slopes(deck, table):
    """The rows of a table with their slopes computed anew."""
    jet, data = Jet(deck), np.loadtxt(table, delimiter=",", skiprows=2)
    for t in np.unique(data[:, 0]):
        at_t = data[data[:, 0] == t]
        jet.t, jet.held, jet.number = t, bool(at_t[0, 2]), [int(i) for i in at_t[:, 1]]
        jet.r, jet.v, jet.stress = at_t[:, 3:6], at_t[:, 6:9], at_t[:, 9]
        yield from jet.rows()


if __name__ == "__main__":
    path, *rest = sys.argv[1:]
    print(f"# all beads of {path} by independent_jet.py; s, cm, cm/s, g/(cm s^2), cm/s^2, g/(cm s^3)\n{COLUMNS}")
    if rest[0] == "--slopes":
        print("\n".join(with_slopes(read_deck(path), rest[1])))
        sys.exit()
    jet = Jet(read_deck(path))
    for t in rest:
        jet.to(float(t))
        print("\n".join(jet.rows()))
