// Animated WebP (RFC 9649): pictures that the browser has encoded one by one, in one file that plays over and over.

/// A chunk of RIFF: its four letters, the size of what it holds, and that, padded to an even size.
function chunk(name: string, content: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(8 + content.length + (content.length % 2));
  for (let at = 0; at < 4; ++at) bytes[at] = name.charCodeAt(at);
  new DataView(bytes.buffer).setUint32(4, content.length, true);
  bytes.set(content, 8);
  return bytes;
}

function joined(parts: Uint8Array[]): Uint8Array {
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

function write24(bytes: Uint8Array, at: number, value: number): void {
  bytes[at] = value & 255;
  bytes[at + 1] = (value >> 8) & 255;
  bytes[at + 2] = value >> 16;
}

/// Of a still picture those chunks that a frame takes: its colours and, where it has one, its transparency.
function pictureOf(still: Uint8Array): Uint8Array {
  const letters = (at: number) => String.fromCharCode(...still.subarray(at, at + 4));
  if (letters(0) !== "RIFF" || letters(8) !== "WEBP") throw new Error("it encodes no WebP");
  const view = new DataView(still.buffer, still.byteOffset, still.byteLength);
  const parts: Uint8Array[] = [];
  for (let at = 12; at + 8 <= still.length; ) {
    const size = view.getUint32(at + 4, true);
    if (["VP8 ", "VP8L", "ALPH"].includes(letters(at))) parts.push(chunk(letters(at), still.subarray(at + 8, at + 8 + size)));
    at += 8 + size + (size % 2);
  }
  return joined(parts);
}

/// What a file begins with; `length`: of all its bytes.
export function headOfWebp(width: number, height: number, length: number): Uint8Array {
  const canvas = new Uint8Array(10);
  canvas[0] = 0x02; // an animation
  write24(canvas, 4, width - 1);
  write24(canvas, 7, height - 1);
  const head = joined([chunk("RIFF", new Uint8Array(0)), new TextEncoder().encode("WEBP"), chunk("VP8X", canvas), chunk("ANIM", new Uint8Array(6))]);
  new DataView(head.buffer).setUint32(4, length - 8, true);
  return head;
}

/// A picture of the file, shown for `duration` [ms]; `still`: a WebP of it.
export function frameOfWebp(still: Uint8Array, width: number, height: number, duration: number): Uint8Array {
  const frame = new Uint8Array(16);
  write24(frame, 6, width - 1);
  write24(frame, 9, height - 1);
  write24(frame, 12, duration);
  frame[15] = 0x02; // in the place of the one before, not over it
  return chunk("ANMF", joined([frame, pictureOf(still)]));
}
