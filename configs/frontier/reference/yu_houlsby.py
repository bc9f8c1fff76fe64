#!/usr/bin/python3
"""Cylindrical cavity in unbounded Mohr-Coulomb soil, finite strain: H. S. Yu and G. T. Houlsby (1991), Geotechnique 41, 173-183.
Writes the curve of the true cavity pressure and the profiles of stress at some cavity strains, for the sand of Fahey's test, beside
itself. Compression positive; alpha, beta, Y, gamma, delta, eta, xi, R as in the paper."""
from pathlib import Path

import numpy as np

E, NU, C, PHI, PSI, P0 = 100e6, 0.25, 1e3, np.radians(48.0), np.radians(16.5), 90e3
A0 = 0.02  # m
HERE = Path(__file__).resolve().parent

G = E / 2 / (1 + NU)
alpha, beta = [(1 + np.sin(x)) / (1 - np.sin(x)) for x in (PHI, PSI)]
Y = 2 * C * np.cos(PHI) / (1 - np.sin(PHI))
Q = Y + (alpha - 1) * P0
k = (alpha - 1) / alpha
gamma = alpha * (beta + 1) / ((alpha - 1) * beta)
delta = Q / (2 * (1 + alpha) * G)
eta = np.exp((beta + 1) * (1 - 2 * NU) * (1 + NU) * Q / (E * (alpha - 1) * beta))
xi = 2 * delta / ((alpha - 1) * beta) * ((1 - NU) * (alpha * beta + 1) - NU * (alpha + beta))
m = (1 + beta) / beta
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


def series(R):
    """Lambda(R, xi) = integral of rho^(-gamma - 1) exp(xi rho) from 1 to R; Gauss-Legendre in ln rho."""
    half = 0.5 * np.log(R)
    rho = np.exp(half * (NODES + 1))
    return half * np.sum(WEIGHTS * rho**-gamma * np.exp(xi * rho))


def remaining(R):
    return (1 - delta) ** m - gamma / eta * series(R)  # (r0 / c)^m of the ring whose stress is R


def stretch(p):
    """a / a0 under the pressure p."""
    R = (1 + alpha) * (Y + (alpha - 1) * p) / (2 * alpha * Q)
    return 1 + (p - P0) / (2 * G) if R <= 1 else R ** (-1 / k) / remaining(R) ** (1 / m)


def solve(f, low, high):
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    return 0.5 * (low + high)


def pressure(strain):
    limit = 3797e3
    return solve(lambda p: stretch(p) - 1 - strain, P0, limit)


def profile(strain):
    """Rows of initial radius, sigma_r, sigma_theta: plastic rings from the cavity to c, elastic ones beyond."""
    a, p = A0 * (1 + strain), pressure(strain)
    Ra = (1 + alpha) * (Y + (alpha - 1) * p) / (2 * alpha * Q)
    c = a * Ra ** (1 / k)
    rows = []
    for R in np.exp(np.linspace(np.log(Ra), 0, 400)):
        r0 = c * remaining(R) ** (1 / m)
        sigma_r = (2 * alpha * Q * R / (1 + alpha) - Y) / (alpha - 1)
        rows.append((r0, sigma_r, (sigma_r - Y) / alpha))
    size = (rows[-1][1] - P0) * c * c
    for r in np.geomspace(c, 2000 * A0, 300)[1:]:
        rows.append((r - delta * c * c / r, P0 + size / r**2, P0 - size / r**2))
    return rows


def main():
    for stretched, known in ((1.01, 460.003), (1.1, 1348.388), (2.0, 3047.555), (5.0, 3630.034)):
        assert abs(pressure(stretched - 1) / 1e3 - known) < 1e-3, (stretched, pressure(stretched - 1))
    strains = np.concatenate([np.linspace(0, 0.1, 401), np.linspace(0.1, 1, 181)[1:], np.linspace(1, 4, 121)[1:]])
    with open(HERE / "sand_without_bound.csv", "w") as file:
        file.write("cavity_strain,true_pressure_kPa\n")
        for strain in strains:
            file.write(f"{strain:.10g},{pressure(strain) / 1e3:.10g}\n")
    for name, strain in (("100permille", 0.1), ("1000permille", 1.0)):
        with open(HERE / f"sand_without_bound_{name}.csv", "w") as file:
            file.write("reference_radius_m,sigma_r_kPa,sigma_theta_kPa\n")
            for r0, sigma_r, sigma_theta in profile(strain):
                file.write(f"{r0:.10g},{sigma_r / 1e3:.10g},{sigma_theta / 1e3:.10g}\n")


if __name__ == "__main__":
    main()
