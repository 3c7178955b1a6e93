#!/usr/bin/env python3
"""Friction models M1 to M6 of a servo under a pendulum, as published (Duclusaud et al., "Extended friction models for the
physics simulation of servo actuators", 2024), fitted in the closed loop: the yardstick of what `gapscope diagnose` finds.

    servo_friction_fit.py FOLDER DUTY_PER_COUNT KEY

FOLDER has MOTION[_mGRAMS]_kpGAIN[_REPEAT].csv; of each value of KEY (m, kp) in turn the logs are held out. Written are, of
each model, the mean absolute position errors of the logs fitted and held out [mrad]. Needs numpy."""
import glob, os, re, sys
import numpy as np

STEP = 4e-3  # of the simulation, at most; the controller acts at each step, the goal is that of the row [s]
NAMES = {"t": ("t", "timestamp"), "goal": ("goal", "goal_position"), "x": ("x1", "position"),
         "volts": ("volts", "input_volts")}
# Begin of each number of M1: one that cannot be below zero moves in proportion to itself, the offset by its scale.
BASE = {"torque_per_volt": 0.15, "back_emf": 0.3, "armature": 0.02, "viscous": 0.05, "coulomb": 0.03,
        "arm_weight": 0.02, "offset": 0.0, "firmware_limit": 0.9}
# Each model: the one whose fit it begins with, and what it has beside that (a name: as that number of it).
MODELS = {"M1": (None, BASE), "M2": ("M1", {"stribeck": 0.02, "stribeck_speed": 0.3}), "M3": ("M1", {"load": 0.1}),
          "M4": ("M3", {"stribeck": 0.02, "stribeck_speed": 0.3, "load_stribeck": 0.05}),
          "M5": ("M4", {"motor": "load", "outer": 0.02, "motor_stribeck": "load_stribeck", "outer_stribeck": 0.02}),
          "M6": ("M5", {"motor_quadratic": 0.02, "outer_quadratic": 0.02})}
GONE = {"M5": ("load", "load_stribeck")}  # what another number has taken the place of


def read(path, duty_per_count):
    d = np.genfromtxt(path, delimiter=",", names=True)
    log = {k: d[next(n for n in names if n in d.dtype.names)] for k, names in NAMES.items()}
    log["x"] = np.unwrap(log["x"])
    near = np.median(np.lib.stride_tricks.sliding_window_view(np.pad(log["x"], 7, mode="edge"), 15), axis=1)
    log["use"] = np.abs(log["x"] - near) < 0.3  # no glitch
    log["x"] = np.where(log["use"], log["x"], near)
    name = os.path.basename(path)
    log["kp"] = float(re.search(r"_kp(\d+)", name)[1])
    log["m"] = float((re.search(r"_m(\d+)", name) or [0, "490"])[1]) * 1e-3
    log["gain"] = duty_per_count * log["kp"]
    log["off"] = 2.0 if name.startswith("lift_and_drop") else np.inf  # torque switched off [s]
    return log


def simulate(p, logs):
    """Positions at the rows (sets of numbers x logs x rows); p: name -> (sets x 1)."""
    rows = max(len(l["t"]) for l in logs)
    pad = lambda v: np.pad(v, (0, rows - len(v)), mode="edge")
    t, goal, volts = (np.stack([pad(l[k]) for l in logs]) for k in ("t", "goal", "volts"))
    mass, gain, off = (np.array([l[k] for l in logs]) for k in ("m", "gain", "off"))
    inertia, weight = p["armature"] + 0.01 * mass, 9.81 * 0.1 * mass + p["arm_weight"]
    x = np.stack([l["x"][0] for l in logs]) + 0.0 * inertia
    w, out = np.zeros_like(x), np.empty(x.shape + (rows,))
    has = lambda k: p.get(k, 0.0)
    for i in range(rows):
        out[..., i] = x
        span = t[:, i + 1] - t[:, i] if i + 1 < rows else np.zeros(len(logs))
        n = max(1, int(np.ceil(span.max() / STEP - 1e-6)))
        h, on = np.maximum(span / n, 1e-9), t[:, i] - t[:, 0] < off
        for _ in range(n):
            limit = p["firmware_limit"]
            duty = np.clip(gain * (goal[:, i] - x), -limit, limit)
            motor = on * (p["torque_per_volt"] * duty * volts[:, i] - p["back_emf"] * w)
            outer = -weight * np.sin(x + p["offset"])
            slow = np.exp(-np.abs(w / has("stribeck_speed"))) if "stribeck_speed" in p else 0.0
            dry = (p["coulomb"] + has("stribeck") * slow + np.abs(motor + outer) * (has("load") + has("load_stribeck") * slow)
                   + np.abs(motor) * (has("motor") + slow * (has("motor_stribeck") + has("motor_quadratic") * np.abs(motor)))
                   + np.abs(outer) * (has("outer") + slow * (has("outer_stribeck") + has("outer_quadratic") * np.abs(outer))))
            stop = inertia / h * w + motor + outer  # what would bring the arm to rest within the step
            w = h / inertia * (stop - np.clip(stop, -dry - p["viscous"] * np.abs(w), dry + p["viscous"] * np.abs(w)))
            x = x + h * w
    return out


def begun(model, fits):
    parent, more = MODELS[model]
    numbers = dict(fits[parent]) if parent else {}
    numbers |= {k: numbers[v] if isinstance(v, str) else v for k, v in more.items()}
    return {k: v for k, v in numbers.items() if k not in GONE.get(model, ())}


def fit(begin, logs, steps=25):
    scale = np.array([0.1 if k == "offset" else 0.0 for k in begin])
    value = np.array(list(begin.values()))
    keys, damping = list(begin), 1e-2
    moved = lambda v, by: np.where(scale > 0.0, v + by * scale, v * np.exp(by))
    run = lambda sets: simulate({k: np.array([s[j] for s in sets])[:, None] for j, k in enumerate(keys)}, logs)
    def left(x):
        return [np.where(l["use"], l["x"] - x[r][: len(l["t"])], 0.0) for r, l in enumerate(logs)]
    mae = lambda e: np.mean([np.mean(np.abs(r)) for r in e])
    e, least = None, np.inf
    for _ in range(steps):
        x = run([value] + [moved(value, 0.01 * (np.arange(len(keys)) == j)) for j in range(len(keys))])
        e, now = left(x[0]), mae(left(x[0]))
        A, b = np.zeros((len(keys),) * 2), np.zeros(len(keys))
        for r, row in enumerate(e):
            J = (x[1:, r, : len(row)] - x[0, r, : len(row)]).T / 0.01
            weight = 1.0 / (np.maximum(np.abs(row), 2e-3) * len(row))
            A, b = A + J.T @ (weight[:, None] * J), b + J.T @ (weight * row)
        tries = [damping * f for f in (0.1, 1.0, 10.0, 100.0, 1000.0)]
        sets = [moved(value, np.clip(np.linalg.solve(A + d * np.diag(np.diag(A) + 1e-9 * A.max()), b), -1, 1)) for d in tries]
        errors = [mae(left(y)) for y in run(sets)]
        best = int(np.nanargmin(errors))
        least = min(now, errors[best])
        if errors[best] < now:
            value, damping = sets[best], max(tries[best], 1e-6)
        if not errors[best] < 0.998 * now:
            break
    return dict(zip(keys, value)), least, lambda logs2: np.mean([np.mean(np.abs(np.where(l["use"], l["x"] - x[: len(l["t"])], 0)))
        for l, x in zip(logs2, simulate({k: np.array([[v]]) for k, v in zip(keys, value)}, logs2)[0])])


if __name__ == "__main__":
    folder, duty, key = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    logs = [read(f, duty) for f in sorted(glob.glob(os.path.join(folder, "*_kp*.csv")))]
    for out in sorted({l[key] for l in logs}):
        fits = {}
        for model in MODELS:
            fits[model], fitted, held_out = fit(begun(model, fits), [l for l in logs if l[key] != out])
            told = {k: float(f"{v:.3g}") for k, v in fits[model].items()}
            print(f"{key} {out:g} held out, {model}: {1e3 * fitted:.1f} {1e3 * held_out([l for l in logs if l[key] == out]):.1f}",
                  told, flush=True)
