// Prints the channels of numbers of an MCAP file in the lines of tests/support/read_record.h. Topics that begin with a slash are a
// scene's (read_scene.mjs).
// usage: node read.mjs indexed|stream FILE
import { contents, json } from "./open.mjs";

const [mode, path] = process.argv.slice(2);
const { schemas, channels, messages, metadata } = await contents(mode, path);
const series = new Map(); // channel id -> { channel, times, values }
for (const channel of channels.values())
  if (!channel.topic.startsWith("/")) series.set(channel.id, { channel, times: [], values: [] });
for (const message of messages) {
  const entry = series.get(message.channelId);
  if (entry === undefined) continue;
  entry.times.push(message.logTime);
  entry.values.push(json(message.data).value);
}

const number = (value) =>
  value === null ? "nan" : Object.is(value, -0) ? "-0" : value === true ? "1" : value === false ? "0" : value.toPrecision(17);
let first = true;
for (const { channel, times, values } of series.values()) {
  if (first) console.log(["time", ...times.map((time) => `${time}`)].join("\t"));
  first = false;
  const value = json(schemas.get(channel.schemaId).data).properties.value;
  const get = (key) => channel.metadata.get(key);
  if (value.unit !== get("unit")) throw new Error("schema and channel disagree about the unit");
  if (!value.description.includes(`[${value.unit === "" ? "1" : value.unit}]`)) throw new Error("no unit in the description");
  if (value.minimum !== undefined && value.minimum !== Number(get("minimum"))) throw new Error("minimum");
  console.log(["channel", channel.topic, get("unit"), get("type"), get("minimum"), get("maximum"), get("doc")].join("\t"));
  console.log(["data", ...values.map(number)].join("\t"));
}
for (const { metadata: entries } of metadata)
  for (const [key, value] of entries) console.log(["about", key, JSON.stringify(value)].join("\t"));
