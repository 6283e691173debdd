"""Errors of the resistance models against the exact tables in data/resistance.

The error of a mode is that of the whole resistance to it, isolated drag and the model's term together, as a pair or a sphere feels
it. Modes of a pair, in the basis of lib/resistance/pair_lubrication.h: squeeze and twist; shear and rolling, the diagonal of
the block of s = n x v and q; their coupling, over the root of the product of the two; and "worst", the largest relative
deviation of the dissipation over all motions of that block (a generalised eigenvalue). Before a boundary: perpendicular
(squeeze), twist, parallel (shear), rolling, coupling, worst.
"""
import csv
import pathlib

import numpy as np

REFERENCE = pathlib.Path(__file__).resolve().parents[2] / "data/resistance"
SMALLER, VISCOSITY = 0.5e-6, 1e-3      # as in points.py and scene.yaml
MODES = ("squeeze", "twist", "shear", "rolling", "coupling", "worst")
BANDS = ((0, 1e-4), (1e-4, 1e-3), (1e-3, 1e-2), (1e-2, 0.1), (0.1, 0.4))  # gap over the smaller radius
PI = np.pi


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: np.array([float(r[k]) if r[k] not in ("inf", "surface") else np.inf for r in rows[1:]]) for k, name in enumerate(rows[0])}, \
        np.array([r[1] for r in rows[1:]])


def block_error(model, exact):
    """Largest relative deviation of two quadratic forms (a, b, c): eigenvalues of exact^-1 (model - exact)."""
    (a, b, c), (A, B, C) = model, exact
    d11, d12, d22, det = a - A, b - B, c - C, A * C - B * B
    trace, product = (C * d11 - 2 * B * d12 + A * d22) / det, (d11 * d22 - d12 * d12) / det
    root = np.sqrt(np.maximum(0, trace**2 / 4 - product))
    return np.maximum(abs(trace / 2 + root), abs(trace / 2 - root))


def compared(model, exact):
    """model, exact: squeeze, twist, and the block's three entries, whole resistances. Signed errors by mode."""
    (n, t, a, b, c), (N, T, A, B, C) = model, exact
    return {"squeeze": n / N - 1, "twist": t / T - 1, "shear": a / A - 1, "rolling": c / C - 1, "coupling": (b - B) / np.sqrt(A * C),
            "worst": block_error((a, b, c), (A, B, C))}


def leading_pair(R, kappa, h):
    """Leading terms of lubrication theory: 1/x and logarithms without constants [jeffrey1984]."""
    x = h / R
    log = np.where(x < 1, np.log(1 / np.minimum(x, 1)), 0)
    return (6 * PI * R * (1 / x + 0.2 * (1 + 1.25 * (1 - kappa**2)) * log), 0 * x, 2 * PI * R * log, 4.8 * PI * R**3 * log, 0 * x)


def leading_wall(a, h):
    """Before a plane [goldman1967]: 1/x and logarithms, without constants."""
    x = h / a
    log = np.where(x < 1, np.log(1 / np.minimum(x, 1)), 0)
    drag = 6 * PI * a
    return drag * (1 / x + 0.2 * log), 0 * x, drag * 8 / 15 * log, 8 * PI * a**3 * 0.4 * log, -drag * a * 2 / 15 * log


def leading_surface(a, h):
    """Before a free surface: the sphere and its mirror image approach each other; nothing singular else."""
    R, x = a / 2, 4 * h / a
    log = np.where(x < 1, np.log(1 / np.minimum(x, 1)), 0)
    # The image moves at -U through a gap of 2h: force 2U times the pair's squeeze function.
    return 12 * PI * R * (1 / x + 0.2 * 2.25 * log), 0 * x, 0 * x, 0 * x, 0 * x


class Errors:
    """of[model][partner]: gap over the smaller radius, and the error of each mode. partner: a ratio, "wall" or "surface"."""

    def __init__(self, results, models=("exact", "tapered", "thesis")):
        table = np.genfromtxt(REFERENCE / "relative_K_basis.csv", delimiter=",", skip_header=1)
        self.ratios = sorted({1 / l for l in table[:, 0] if l > 0})
        self.of = {}
        for model in (*models, "leading"):
            values, partner = columns(results / f"{'exact' if model == 'leading' else model}.csv")
            self.of[model] = {}
            for ratio in self.ratios:
                rows = table[np.isclose(table[:, 0], 1 / ratio)]
                mine = (partner != "inf") & (partner != "surface") & np.isclose(values["a1"] / values["a2"], ratio)
                self.of[model][ratio] = self.pair(model, rows, {k: v[mine] for k, v in values.items()})
            for name, word, file in (("wall", "inf", "wall_resistance"), ("surface", "surface", "free_surface")):
                rows = np.genfromtxt(REFERENCE / f"{file}.csv", delimiter=",", skip_header=1)
                self.of[model][name] = self.boundary(model, name, rows, {k: v[partner == word] for k, v in values.items()})

    def pair(self, model, rows, values):
        a1, a2, h = values["a1"], values["a2"], values["h"]
        assert len(rows) == len(h) and np.allclose(rows[:, 2] * SMALLER, h, rtol=1e-9)
        R, kappa = a1 * a2 / (a1 + a2), (a1 - a2) / (a1 + a2)
        exact = (rows[:, 3] * 6 * PI * R, rows[:, 7] * 8 * PI * R**3, rows[:, 4] * 2 * PI * R, rows[:, 5] * 4.8 * PI * R**3, rows[:, 6] * PI * R**2)
        ours = leading_pair(R, kappa, h) if model == "leading" else tuple(values[k] / VISCOSITY for k in ("kn", "kt", "ks", "kp", "ksp"))
        # Isolated drags, as a resistance to relative motion: (G R^-1 G^T)^-1.
        f1, f2, t1, t2 = 1 / (6 * PI * a1), 1 / (6 * PI * a2), 1 / (8 * PI * a1**3), 1 / (8 * PI * a2**3)
        l1, l2 = a1 + h / 2, a2 + h / 2
        m11, m12, m22 = f1 + f2 + l1**2 * t1 + l2**2 * t2, l1 * t1 - l2 * t2, t1 + t2
        det = m11 * m22 - m12**2
        isolated = (1 / (f1 + f2), 1 / (t1 + t2), m22 / det, -m12 / det, m11 / det)
        t = kappa / (2 * R)

        def whole(k):
            n, twist, s, p, sp = k
            return tuple(x + y for x, y in zip((n, twist, s + t * t * p - 2 * t * sp, t * p - sp, p), isolated))

        return h / SMALLER, compared(whole(ours), whole(exact))

    def boundary(self, model, name, rows, values):
        a, h = values["a1"], values["h"]
        assert len(rows) == len(h) and np.allclose(rows[:, 0] * SMALLER, h, rtol=1e-9)
        drag, torque = 6 * PI * a, 8 * PI * a**3
        exact = (rows[:, 1] * drag, rows[:, 6] * torque, rows[:, 2] * drag, rows[:, 4] * drag * a, rows[:, 5] * torque)
        if model == "leading":
            n, t, s, p, sp = leading_wall(a, h) if name == "wall" else leading_surface(a, h)
        else:
            n, t, s, p, sp = (values[k] / VISCOSITY for k in ("kn", "kt", "ks", "kp", "ksp"))
        return h / a, compared((drag + n, torque + t, drag + s, sp, torque + p), exact)

    def within(self, model, partner, low, high):
        """Errors by mode at gaps low < h/b <= high, as positive numbers."""
        gap, errors = self.of[model][partner]
        inside = (gap > low) & (gap <= high * (1 + 1e-9))
        return {mode: np.abs(e[inside]) for mode, e in errors.items()}
