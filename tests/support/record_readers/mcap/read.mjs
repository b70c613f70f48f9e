// Reads an MCAP file with @mcap/core and prints it in the lines of tests/support/read_record.h.
// usage: node read.mjs indexed|stream FILE   (stream: chunk by chunk, as one does with a file that was cut off)
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { open, readFile } from "node:fs/promises";

const [mode, path] = process.argv.slice(2);
const series = new Map(); // channel id -> { channel, times, values }
const schemas = new Map();
const about = [];

function take(message) {
  const entry = series.get(message.channelId);
  entry.times.push(message.logTime);
  entry.values.push(JSON.parse(new TextDecoder().decode(message.data)).value);
}
function take_channel(channel) {
  if (!series.has(channel.id)) series.set(channel.id, { channel, times: [], values: [] });
}

if (mode === "indexed") {
  const file = await open(path, "r");
  const reader = await McapIndexedReader.Initialize({
    readable: {
      size: async () => BigInt((await file.stat()).size),
      read: async (offset, length) => {
        const bytes = new Uint8Array(Number(length));
        await file.read(bytes, 0, bytes.length, Number(offset));
        return bytes;
      },
    },
  });
  for (const schema of reader.schemasById.values()) schemas.set(schema.id, schema);
  for (const channel of reader.channelsById.values()) take_channel(channel);
  for await (const message of reader.readMessages({ validateCrcs: true })) take(message);
  for await (const metadata of reader.readMetadata()) about.push(metadata);
  let counted = 0n;
  for (const count of reader.statistics.channelMessageCounts.values()) counted += count;
  if (counted !== reader.statistics.messageCount) throw new Error("the statistics disagree");
  await file.close();
} else {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(await readFile(path));
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") take_channel(record);
    if (record.type === "Message") take(record);
    if (record.type === "Metadata") about.push(record);
  }
}

const number = (value) =>
  value === null ? "nan" : Object.is(value, -0) ? "-0" : value === true ? "1" : value === false ? "0" : value.toPrecision(17);
let first = true;
for (const { channel, times, values } of series.values()) {
  if (first) console.log(["time", ...times.map((time) => `${time}`)].join("\t"));
  first = false;
  const schema = JSON.parse(new TextDecoder().decode(schemas.get(channel.schemaId).data));
  const value = schema.properties.value;
  const get = (key) => channel.metadata.get(key);
  if (value.unit !== get("unit")) throw new Error("schema and channel disagree about the unit");
  if (!value.description.includes(`[${value.unit === "" ? "1" : value.unit}]`)) throw new Error("no unit in the description");
  if (value.minimum !== undefined && value.minimum !== Number(get("minimum"))) throw new Error("minimum");
  console.log(["channel", channel.topic, get("unit"), get("type"), get("minimum"), get("maximum"), get("doc")].join("\t"));
  console.log(["data", ...values.map(number)].join("\t"));
}
for (const metadata of about)
  for (const [key, value] of metadata.metadata) console.log(["about", key, JSON.stringify(value)].join("\t"));
