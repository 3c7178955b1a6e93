"""Writes drive.npz, drive_deflated.npz and drive.h5 beside itself, once: with NumPy 1.24 and h5py 3.7.
The tests know the numbers: 60 samples at 1 kHz, x1 = 0.01 i, u = 0.5 i, q has the joints 0.01 i and -2 i."""
import os

import h5py
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
i = np.arange(60)
columns = dict(t=i / 1000, u=0.5 * i, x1=0.01 * i, q=np.stack([0.01 * i, -2.0 * i], axis=1),
               q_columns=np.asfortranarray(np.stack([0.01 * i, -2.0 * i], axis=1)),
               counts=(i - 30).astype(np.int16), big=(0.5 * i).astype(">f4"), half=(0.5 * i).astype(np.float16),
               upright=(0.01 * i).reshape(-1, 1), on=i % 2 == 0)
odd = dict(complex=i + 1j, objects=np.array([None] * 60), dates=i.astype("datetime64[ms]"), text=i.astype("U4"),
           fields=np.zeros(60, [("a", float), ("b", float)]), wide=i.astype(np.longdouble), short=np.arange(50.0),
           broken=np.where(i == 16, np.nan, 0.01 * i))
np.savez(os.path.join(here, "drive.npz"), **columns)
np.savez(os.path.join(here, "wide.npz"), t=np.arange(2) / 1000, u=np.zeros(2), q=np.zeros((2, 101)))
np.savez_compressed(os.path.join(here, "drive_deflated.npz"), **columns, **odd)
with h5py.File(os.path.join(here, "drive.h5"), "w", libver="earliest") as f:
    for name in ("t", "u", "x1", "q", "counts", "big", "half", "upright"):
        f[name] = columns[name]
    for name in ("complex", "fields", "short", "broken"):
        f[name] = odd[name]
    f["text"] = "hello"
    f.create_dataset("robot/arm/x1", data=columns["x1"], compression="gzip", shuffle=True)
    f.create_dataset("chunk", shape=(60, 4, 4), dtype="f8")
