// An MCAP file with @mcap/core, whole: by its indexes, or as a stream, chunk by chunk, as one does with a file that was cut off.
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { open, readFile } from "node:fs/promises";

/// Maps of schemas and channels by id; messages and metadata in the order of the file.
export async function contents(mode, path) {
  const found = { schemas: new Map(), channels: new Map(), messages: [], metadata: [] };
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
    for (const schema of reader.schemasById.values()) found.schemas.set(schema.id, schema);
    for (const channel of reader.channelsById.values()) found.channels.set(channel.id, channel);
    for await (const message of reader.readMessages({ validateCrcs: true })) found.messages.push(message);
    for await (const metadata of reader.readMetadata()) found.metadata.push(metadata);
    check_statistics(reader.statistics, found);
    await file.close();
    return found;
  }
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(await readFile(path));
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") found.schemas.set(record.id, record);
    if (record.type === "Channel") found.channels.set(record.id, record);
    if (record.type === "Message") found.messages.push(record);
    if (record.type === "Metadata") found.metadata.push(record);
  }
  return found;
}

function check_statistics(statistics, { schemas, channels, messages }) {
  const counts = new Map([...channels.keys()].map((id) => [id, 0n]));
  for (const message of messages) counts.set(message.channelId, counts.get(message.channelId) + 1n);
  const agree =
    statistics.schemaCount === schemas.size &&
    statistics.channelCount === channels.size &&
    statistics.messageCount === BigInt(messages.length) &&
    [...counts].every(([id, count]) => (statistics.channelMessageCounts.get(id) ?? 0n) === count);
  if (!agree) throw new Error("the statistics disagree with what is in the file");
}

export const json = (bytes) => JSON.parse(new TextDecoder().decode(bytes));
