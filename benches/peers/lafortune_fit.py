"""Fits the same residuals with scipy's MINPACK Levenberg-Marquardt: analytic Jacobian, the same clamps, the same first start.

Arguments: a folder with residual.f64 and products.f64, written by benches/lafortune_fit.rs, the least and the greatest exponent.
Writes lobes.f64 there and prints the seconds that the fits took.
"""

import sys
import time
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

folder, least, greatest = Path(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
products = np.fromfile(folder / "products.f64").reshape(-1, 3)
residual = np.fromfile(folder / "residual.f64").reshape(-1, len(products))
START = np.array([-1.0, -1.0, 1.0, 1.0])


def lobe(x):
    base = products @ x[:3]
    return np.where(base > 0, np.maximum(base, 1e-30) ** np.clip(x[3], least, greatest), 0.0)


def jacobian(x, _):
    exponent = np.clip(x[3], least, greatest)
    base = products @ x[:3]
    lit = base > 0
    base = np.where(lit, base, 1.0)
    value = np.where(lit, base**exponent, 0.0)
    slope = np.where(lit, exponent * value / base, 0.0)
    inside = least < x[3] < greatest
    return np.column_stack([slope[:, None] * products, np.where(lit & inside, value * np.log(base), 0.0)])


start = time.perf_counter()
theirs = [least_squares(lambda x, s: lobe(x) - s, START, jacobian, method="lm", args=(s,)).x for s in residual]
seconds = time.perf_counter() - start
print(seconds)
theirs = np.array(theirs)
theirs[:, 3] = np.clip(theirs[:, 3], least, greatest)
theirs.tofile(folder / "lobes.f64")
