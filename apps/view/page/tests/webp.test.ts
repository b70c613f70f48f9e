// An animated WebP, chunk by chunk as RFC 9649 has it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { frameOfWebp, headOfWebp } from "../webp.ts";

const text = (bytes: Uint8Array, at: number) => String.fromCharCode(...bytes.subarray(at, at + 4));
const number = (bytes: Uint8Array, at: number, count: number) => bytes.subarray(at, at + count).reduceRight((sum, byte) => 256 * sum + byte, 0);

/// A still picture as an encoder makes it, here with what a frame does not take before and after its colours.
const still = Uint8Array.from([...Buffer.from("RIFF"), 40, 0, 0, 0, ...Buffer.from("WEBPVP8X"), 10, 0, 0, 0, 16, 0, 0, 0, 63, 1, 0, 199, 0, 0,
  ...Buffer.from("VP8 "), 3, 0, 0, 0, 7, 8, 9, 0, ...Buffer.from("EXIF"), 2, 0, 0, 0, 1, 1]);

test("a file begins with its size, its canvas and that it plays for ever", () => {
  const head = headOfWebp(320, 200, 1000);
  assert.deepEqual([text(head, 0), number(head, 4, 4), text(head, 8)], ["RIFF", 992, "WEBP"]);
  assert.deepEqual([text(head, 12), number(head, 16, 4), head[20]], ["VP8X", 10, 0x02]);
  assert.deepEqual([number(head, 24, 3), number(head, 27, 3)], [319, 199]);
  assert.deepEqual([text(head, 30), number(head, 34, 4), number(head, 42, 2), head.length], ["ANIM", 6, 0, 44]);
});

test("a frame has the picture's colours and its time", () => {
  const frame = frameOfWebp(still, 320, 200, 40);
  assert.deepEqual([text(frame, 0), number(frame, 4, 4)], ["ANMF", frame.length - 8]);
  assert.deepEqual([number(frame, 8, 3), number(frame, 11, 3)], [0, 0]);
  assert.deepEqual([number(frame, 14, 3), number(frame, 17, 3), number(frame, 20, 3)], [319, 199, 40]);
  assert.deepEqual([text(frame, 24), number(frame, 28, 4), ...frame.subarray(32)], ["VP8 ", 3, 7, 8, 9, 0]);
  assert.throws(() => frameOfWebp(new Uint8Array(20), 320, 200, 40), /encodes no WebP/);
});
