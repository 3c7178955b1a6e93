"""Servos as they are sold, by another language and other laws: does the loop name what the firmware does?

    python3 tests/diagnosis/servo_study.py build/bin/gapscope FIRST COUNT [FOLDER]

Draws COUNT servos from seed FIRST on. Each has a firmware of 250 to 2000 Hz behind a bus of 40 to 200 rows a second,
an encoder of 12 bit in the loop, an output that ends at a duty of 1, and by chance a profile of its goal, a filter,
a delay, a gain that falls as e/(1 + |e|/e0), dry friction; three masses, three gains, three motions, of which one
each is held out. The configuration declares gain, masses and arm alone. Prints for each number whether its interval
holds, what was named of what is there, and what was named that is not there.
"""

import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

KINDS = ["sines", "steps", "ramps"]
GAINS = [8, 16, 32]
SECONDS = 6.0


def drawn(seed):
    g = random.Random(f"servo {seed}")
    torque = g.uniform(1.5, 4.0)
    return {
        "firmware_hz": g.choice([250, 500, 1000, 2000]),
        "bus_hz": math.exp(g.uniform(math.log(40), math.log(200))),
        "jitter": g.choice([0.0, 0.05]),
        "torque": torque,  # N m per unit of duty
        "inertia": math.exp(g.uniform(math.log(0.003), math.log(0.02))),
        "damping": torque / g.uniform(5, 9),
        "friction": torque * g.choice([0.0, 0.02, 0.05]),
        "gain": g.uniform(0.1, 0.3),  # duty per register count and rad
        "delay_s": g.choice([0.0, 0.002, 0.01]),
        "filter_s": g.choice([0.0, 0.0, g.uniform(0.02, 0.08)]),
        "profile": g.choice([None, None, (g.uniform(2.0, 4.0), g.uniform(10.0, 40.0))]),
        "falls_at": g.choice([math.inf, math.inf, g.uniform(0.2, 0.6)]),
        "masses": sorted(g.uniform(0.1, 0.8) for _ in range(3)),
        "arm": g.choice([0.1, 0.15]),
        "seed": seed,
    }


class Goal:
    def __init__(self, g, kind):
        self.kind = kind
        self.lines = [(g.uniform(0.2, 0.6), g.uniform(0.2, 1.2), g.uniform(0, 2 * math.pi)) for _ in range(3)]
        self.places = [g.uniform(-1.2, 1.2) for _ in range(12)]

    def at(self, t):
        if self.kind == "sines":
            rise = min(1.0, 2.0 * t)
            return rise * sum(a * math.sin(2 * math.pi * f * t + p) for a, f, p in self.lines)
        if self.kind == "steps":
            return self.places[min(11, int(t / 0.8))]
        k = min(10, int(t))
        return self.places[k] + (self.places[k + 1] - self.places[k]) * (t - int(t))


class Firmware:
    """From its goal and its encoder to a duty, once a turn."""

    def __init__(self, s, gain, goal):
        self.s, self.gain, self.turn = s, gain, 1.0 / s["firmware_hz"]
        self.filtered = self.place = goal
        self.speed = 0.0

    def followed(self, goal):
        tau = self.s["filter_s"]
        self.filtered += (goal - self.filtered) * (1.0 - math.exp(-self.turn / tau) if tau else 1.0)
        if not self.s["profile"]:
            return self.filtered
        top, most = self.s["profile"]
        way = self.filtered - self.place
        wanted = math.copysign(min(top, math.sqrt(2.0 * most * abs(way))), way)
        self.speed += max(-most * self.turn, min(most * self.turn, wanted - self.speed))
        if abs(self.speed * self.turn) > abs(way) and abs(self.speed) <= 1.5 * most * self.turn:
            self.place, self.speed = self.filtered, 0.0
        else:
            self.place += self.speed * self.turn
        return self.place

    def duty(self, goal, x, quantum):
        e = quantum * (round(self.followed(goal) / quantum) - round(x / quantum))
        if self.s["falls_at"] < math.inf:
            e /= 1.0 + abs(e) / self.s["falls_at"]
        return max(-1.0, min(1.0, self.s["gain"] * self.gain * e))


def log_of(s, mass, gain, kind, number):
    """Rows [t, goal, position]: the arm by symplectic Euler at 8 kHz, dry friction as an impulse that it cannot exceed."""
    g = random.Random(f"log {s['seed']} {number}")
    goal, quantum = Goal(g, kind), 2.0 * math.pi / 4096
    inertia = s["inertia"] + mass * s["arm"] ** 2
    weight = mass * 9.81 * s["arm"]
    h = 1.0 / (s["firmware_hz"] * max(1, round(8000 / s["firmware_hz"])))
    x = target = goal.at(0.0)
    firmware = Firmware(s, gain, round(target / quantum) * quantum)
    v = duty = t = 0.0
    next_turn, next_row, rows, sent = g.uniform(0.0, firmware.turn), 0.0, [], []
    while t < SECONDS:
        if t >= next_row:
            asked = round(goal.at(next_row) / quantum) * quantum
            sent.append((t + s["delay_s"], asked))
            rows.append((t, asked, round(x / quantum) * quantum))
            next_row = (len(rows) + g.uniform(-1, 1) * s["jitter"]) / s["bus_hz"]
        while sent and sent[0][0] <= t:
            target = sent.pop(0)[1]
        if t >= next_turn:
            next_turn += firmware.turn
            duty = firmware.duty(target, x, quantum)
        free = (v + h * (s["torque"] * duty - weight * math.sin(x)) / inertia) / (1.0 + h * s["damping"] / inertia)
        held = h * s["friction"] / inertia
        v = 0.0 if abs(free) <= held else free - math.copysign(held, free)
        x += h * v
        t += h
    return rows


def write(s, folder):
    lists = {"file": [], "held_out": []}
    number = 0
    for m, mass in enumerate(s["masses"]):
        for k, kind in enumerate(KINDS):
            gain, number = GAINS[(k + m) % 3], number + 1
            name = f"{kind}_m{mass:.3f}_kp{gain}.csv"
            with open(folder / name, "w", encoding="utf-8") as f:
                f.write("t,goal,position\n")
                f.writelines(f"{t:.6f},{a:.6f},{b:.6f}\n" for t, a, b in log_of(s, mass, gain, kind, number))
            item = f"    - {{file: {name}, mass: {mass}, arm: {s['arm']}, gain: {gain}}}\n"
            lists["held_out" if k == m else "file"].append(item)
    (folder / "servo.yaml").write_text(
        "recording:\n" + "".join(f"  {key}:\n{''.join(items)}" for key, items in lists.items())
        + "  columns: {time: t, target: goal, position: position}\nencoder: {bits: 12}\n"
        + f"controller: {{position: {{gain: {s['gain']}}}}}\nmodel:\n  parameters: {{torque_constant: {{estimate: true}}, "
        + "motor_damping: {value: 0.3, estimate: true}, mass_ratio: 0}\n", encoding="utf-8")


def truths(s):
    """Of each number: its size, and whether a law of this name is there."""
    there = {
        "controller.rate": s["firmware_hz"],
        "controller.profile.speed": s["profile"] and s["profile"][0],
        "controller.profile.acceleration": s["profile"] and s["profile"][1],
        "controller.goal_filter_s": s["filter_s"],
        "controller.goal_delay_s": s["delay_s"],
        "controller.position.saturation": 1.0,
        "controller.position.falls_at": s["falls_at"] if s["falls_at"] < math.inf else None,
        "motor_coulomb_friction.level_nm": s["friction"],
    }
    drive = {"torque_constant": s["torque"], "motor_damping": s["damping"],
             "motor_inertia": s["inertia"] + s["masses"][0] * s["arm"] ** 2}
    return {k: v for k, v in there.items() if v}, drive


def main():
    program, first, count = str(pathlib.Path(sys.argv[1]).resolve()), int(sys.argv[2]), int(sys.argv[3])
    keep = pathlib.Path(sys.argv[4]) if len(sys.argv) > 4 else None
    told, held, wrong = {}, {}, 0
    for seed in range(first, first + count):
        s = drawn(seed)
        with tempfile.TemporaryDirectory() as scratch:
            folder = (keep or pathlib.Path(scratch)) / f"servo_{seed}"
            folder.mkdir(parents=True, exist_ok=True)
            write(s, folder)
            subprocess.run([program, "diagnose", "servo.yaml", "-o", "report", "--quiet"], cwd=folder, check=False,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            answer = folder / "report" / "diagnosis.json"
            fit = json.loads(answer.read_text(encoding="utf-8")).get("closed_loop_fit") if answer.exists() else None
        if not fit:
            print(f"{seed}: no loop")
            continue
        laws, drive = truths(s)
        numbers = {n["parameter"]: n for n in fit["numbers"]}
        line = []
        for key, truth in {**laws, **drive}.items():
            # Delays are free in the last fit, added or not: told is what was added.
            found = numbers.get(key) if key in fit["added"] or not key.startswith("controller.") else None
            told.setdefault(key, [0, 0])[1] += 1
            if not found:
                line.append(f"{key} {truth:.4g} not told")
                continue
            low, high = found["ci95"]
            inside = low <= truth <= high
            told[key][0] += 1
            held.setdefault(key, [0, 0])[1] += 1
            held[key][0] += inside
            line.append(f"{key} {truth:.4g}: {found['value']:.4g} [{low:.4g}, {high:.4g}]{'' if inside else ' MISS'}")
        more = [key for key in fit["added"] if key not in laws and "sharpness" not in key and key + ".level_nm" not in laws]
        wrong += bool(more)
        print(f"{seed}: {1e3 * fit['mae_after_rad']:.2f} mrad; " + "; ".join(line) + f"; beside: {more}", flush=True)
    for key, (n, of) in told.items():
        print(f"{key:36} told {n} of {of}, holds {held.get(key, [0, 0])[0]} of {n}")
    print(f"{wrong} of {count} were told something beside")


if __name__ == "__main__":
    main()
