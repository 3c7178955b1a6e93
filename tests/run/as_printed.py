#!/usr/bin/env python3
"""S1 to S6 of the source paper as printed, written a second time: what `detector: {method: literal}` is held to.

    python3 tests/run/as_printed.py FILE.csv L QUANTUM

FILE.csv begins with columns of t [s], u and x1 [rad], as `gapscope simulate` writes them and `traces` of a report has them;
L is in rad/s^2, QUANTUM of the encoder in rad.
Prints a line for each passage: t1 [s], t2 [s], |x1(t2) - x1(t1)| [rad].
"""
import csv, math, statistics, sys


def error(x, T, L):  # (5) and (6), forward Euler
    k2 = 1.1 * L
    k1 = 2.028 * math.sqrt(k2)
    place, speed, e = x[0], 0.0, [0.0]
    for y in x[1:]:
        sign = (e[-1] > 0) - (e[-1] < 0)
        place, speed = place + T * (speed + k1 * math.sqrt(abs(e[-1])) * sign), speed + T * k2 * sign
        e.append(y - place)
    return e


def passages(t, u, x, L, quantum):
    T = t[1] - t[0]
    e = error(x, T, L)
    fourth = [abs(x[i] - 4 * x[i - 1] + 6 * x[i - 2] - 4 * x[i - 3] + x[i - 4]) for i in range(4, len(x))]
    noise = max(1.4826 * statistics.median(fourth) / math.sqrt(70), quantum / math.sqrt(12))
    turns = [i for i in range(1, len(u)) if (u[i] > 0) != (u[i - 1] > 0)]
    pause = 0.02 * statistics.median(b - a for a, b in zip(turns, turns[1:]))
    swings = []  # samples at which e_x is off zero on one side, without a pause
    for i in range(len(e)):
        if abs(e[i]) <= 4 * noise + 2 * 1.1 * L * T * T:  # S2: e_x is zero
            continue
        if not swings or e[i] * e[swings[-1][-1]] < 0 or i - swings[-1][-1] >= pause:
            swings.append([])
        swings[-1].append(i)
    for before, swing, after in zip(swings, swings[1:], swings[2:]):
        t1, t2 = swing[0], max(swing, key=lambda i: abs(e[i]))  # S3, S4
        rested, reverses = t1 - before[-1] >= pause, after[0] - swing[-1] < pause
        if rested and reverses and (x[t2] - x[t1]) * e[t2] > 0:
            yield t[t1], t[t2], abs(x[t2] - x[t1])  # S5


with open(sys.argv[1]) as file:
    t, u, x = zip(*(map(float, row[:3]) for row in list(csv.reader(file))[1:]))
for passage in passages(t, u, x, float(sys.argv[2]), float(sys.argv[3])):
    print("%.17g %.17g %.17g" % passage)
