"""Writes joints.db3 beside itself, once: a bag of ROS 2 as rosbag2 lays it out (Humble, schema 3), by Python's sqlite3,
with the messages that npm's writer put into joints.mcap."""
import os
import sqlite3
import struct

here = os.path.dirname(os.path.abspath(__file__))
data, at, channels, rows = open(os.path.join(here, "joints.mcap"), "rb").read(), 8, {}, []
while data[at] != 15:  # the end of the messages
    opcode, length = struct.unpack_from("<BQ", data, at)
    record = data[at + 9:at + 9 + length]
    if opcode == 4:
        size = struct.unpack_from("<I", record, 4)[0]
        channels[struct.unpack_from("<H", record)[0]] = record[8:8 + size].decode()
    if opcode == 5:
        channel, _, logged, _ = struct.unpack_from("<HIQQ", record)
        rows.append((channel + 1, logged, record[22:]))
    at += 9 + length

path = os.path.join(here, "joints.db3")
if os.path.exists(path):
    os.remove(path)
bag = sqlite3.connect(path)
bag.executescript("""
PRAGMA page_size = 1024;
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
  offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES (3, 'humble');
""")
bag.executemany("INSERT INTO topics VALUES (?, ?, 'sensor_msgs/msg/JointState', 'cdr', '')",
                [(i + 1, name) for i, name in channels.items()])
bag.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", rows)
bag.commit()
