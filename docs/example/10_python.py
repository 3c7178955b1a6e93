#!/usr/bin/env python3
"""10_python.py FILE: the gap in a recording, from arrays: a CSV with columns t [s], u and x1 [rad]."""
import sys

import gapscope
import numpy

rows = [line for line in open(sys.argv[1]) if line[0] not in "#t"]  # without comments and the header
t, u, x1 = numpy.loadtxt(rows, delimiter=",", unpack=True)
seen = gapscope.detect(recording={"time": t, "input": u, "position": x1})  # result.json as a dict
gap = seen["model_free"]["gap_rad"]
print(seen["model_free"]["verdict"], "unknown" if gap is None else f"{1e3 * gap:.3f} mrad")
for event in seen["model_free"]["events"][:3]:
    print(f"  from {event['t1_s']} to {event['t2_s']} s")
