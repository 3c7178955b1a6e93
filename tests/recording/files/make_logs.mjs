// Writes joints.mcap, joints_lz4.mcap, joints_zstd.mcap and plain.mcap beside itself, once: with npm's @mcap/core 2
// and @foxglove/rosmsg2-serialization, and the commands lz4 and zstd. The tests know the numbers: 60 messages at
// 100 Hz from 1.7e9 s on; "elbow" 0.01 i, "wrist" -2 i, efforts 0.5 i and 3; every message is logged 2 ms late.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { McapWriter, TempBuffer } from "@mcap/core";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import { parse } from "@foxglove/rosmsg";

const here = dirname(fileURLToPath(import.meta.url));
const definition = `std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`;
const text = new TextEncoder();
const compressors = {
  lz4: (data) => execFileSync("lz4", ["-c", "-q"], { input: data }),
  zstd: (data) => execFileSync("zstd", ["-c", "-q", "--no-check"], { input: data }),
};

async function write(name, compression, encoding) {
  const buffer = new TempBuffer();
  const writer = new McapWriter({
    writable: buffer,
    useChunks: compression !== null,
    chunkSize: 4096,
    compressChunk: compression ? (data) => ({ compression, compressedData: compressors[compression](data) }) : undefined,
  });
  await writer.start({ profile: "", library: "make_logs" });
  const schemaId = await writer.registerSchema({
    name: "sensor_msgs/msg/JointState",
    encoding: encoding === "cdr" ? "ros2msg" : "jsonschema",
    data: text.encode(encoding === "cdr" ? definition : "{}"),
  });
  const channel = (topic) => writer.registerChannel({ schemaId, topic, messageEncoding: encoding, metadata: new Map() });
  const joints = await channel("/joint_states");
  const gripper = encoding === "cdr" ? await channel("/gripper/joint_states") : undefined;
  const cdr = new MessageWriter(parse(definition, { ros2: true }));
  for (let i = 0; i < 60; ++i) {
    const ns = 1_700_000_000_000_000_000n + BigInt(i) * 10_000_000n;
    const stamp = { sec: Number(ns / 1_000_000_000n), nanosec: Number(ns % 1_000_000_000n) };
    const message = (names, position, effort) => ({
      header: { stamp, frame_id: "base" }, name: names, position, velocity: position.map(() => 0), effort });
    const put = (channelId, m) => writer.addMessage({
      channelId, sequence: i, logTime: ns + 2_000_000n, publishTime: ns + 1_000_000n,
      data: encoding === "cdr" ? cdr.writeMessage(m) : text.encode(JSON.stringify(m)) });
    await put(joints, message(["elbow", "wrist"], [i / 100, -2 * i], [0.5 * i, 3]));
    if (gripper !== undefined) await put(gripper, message(["finger"], [i], [1]));
    if (gripper !== undefined && i % 10 === 0) await put(joints, message(["lamp"], [i], [1]));
  }
  await writer.end();
  writeFileSync(join(here, name), buffer.get());
}

await write("joints.mcap", null, "cdr");
await write("joints_lz4.mcap", "lz4", "cdr");
await write("joints_zstd.mcap", "zstd", "cdr");
await write("plain.mcap", null, "json");
