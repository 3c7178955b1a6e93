"""The benchmark's fit by scipy: least_squares over solve_ivp with events, the free run of the recording that
bench_fit wrote. Same drive, free numbers and start; prints CPU times.

The motion is integrated from event to event, each a terminal event of solve_ivp: the contact closes or opens,
the load stops or breaks away. The input is held from sample to sample, which the step size respects.
"""
import csv
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

M1, KM, K, C = 8.78e-4, 0.172, 200.0, 0.05
TRUTH = np.array([18.8e-3, 0.062, 1.0, 0.035, 0.05, -0.004])  # gap, d1, m2/m1, d2, Fc2, x1 - x2 at the start
START = TRUTH * np.array([1.3, 1 / 1.3, 1.3, 1 / 1.3, 1.3, 0.0])
SCALE = np.abs(TRUTH)


def read(path):
    with open(path) as f:
        rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
    return tuple(np.array([float(r[k]) for r in rows]) for k in ("t", "u", "x1"))


def falling(guard):
    guard.terminal, guard.direction = True, -1
    return guard


def simulate(p, t, u):
    gap, d1, ratio, d2, friction, apart = p
    half, m2, dt = gap / 2, M1 * ratio, t[1] - t[0]
    side, load = 0, 0  # closed flank, direction of the load's friction (0: open, sticks)

    def torque(z):
        return side * max(0.0, side * (K * (z[0] - z[2] - side * half) + C * (z[1] - z[3]))) if side else 0.0

    def pull(z):  # of the contact law, may be negative
        return side * (K * (z[0] - z[2] - side * half) + C * (z[1] - z[3]))

    def rates(now, z):
        tau = torque(z)
        command = KM * u[min(int((now - t[0]) / dt + 1e-6), len(u) - 1)]
        a2 = 0.0 if load == 0 else (tau - d2 * z[3] - load * friction) / m2
        return [z[1], (command - d1 * z[1] - tau) / M1, z[3] if load else 0.0, a2]

    def guards():
        closing = [("+", lambda n, z: half - (z[0] - z[2])), ("-", lambda n, z: half + (z[0] - z[2]))]
        opening = [("open", lambda n, z: pull(z))]
        sticking = [("go+", lambda n, z: friction - torque(z)), ("go-", lambda n, z: friction + torque(z))]
        slipping = [("stop", lambda n, z: load * z[3])]
        return (opening if side else closing) + (slipping if load else sticking)

    z, now, done = np.array([0.0, 0.0, -apart, 0.0]), t[0], 0
    out = np.empty(len(t))
    while done < len(t):
        active = guards()
        r = solve_ivp(rates, (now, t[-1] + dt), z, events=[falling(g) for _, g in active], dense_output=True,
                      rtol=1e-7, atol=1e-10, max_step=dt)
        reached = min(len(t), int(np.searchsorted(t, r.t[-1])))
        if reached > done:
            out[done:reached] = r.sol(t[done:reached])[0]
            done = reached
        if r.status != 1:
            break
        name = next(active[i][0] for i, e in enumerate(r.t_events) if len(e))
        now, z = r.t[-1], r.y[:, -1].copy()
        if name in "+-":
            side = 1 if name == "+" else -1
        elif name == "open":
            side = 0
        elif name == "stop":
            load, z[3] = 0, 0.0
        else:
            load = 1 if name == "go+" else -1
        if load == 0 and abs(torque(z)) > friction:
            load = int(np.sign(torque(z)))
        z = z + 1e-9 * np.array(rates(now, z))  # past the zero that ended the step
        now += 1e-9
    return out


def main():
    t, u, x1 = read(sys.argv[1])
    begin = time.process_time()
    left = np.sqrt(np.mean((simulate(TRUTH, t, u) - x1) ** 2))
    one = time.process_time() - begin
    begin = time.process_time()
    found = least_squares(lambda q: (simulate(q * SCALE, t, u) - x1) / 1e-6, START / SCALE, diff_step=1e-5,
                          max_nfev=30)
    spent = time.process_time() - begin
    print(f"one simulation {one:.2f} s, {1e6 * left:.2f} urad rms at the truth; least_squares {spent:.1f} s, "
          f"{found.nfev} evaluations, {found.njev} Jacobians, gap {found.x[0] * SCALE[0]:.6f} rad, "
          f"rms {1e6 * np.sqrt(2 * found.cost / len(t)) * 1e-6:.2f} urad")


if __name__ == "__main__":
    main()
