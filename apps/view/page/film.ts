// A film: the page of a browser that nobody looks at. It asks for one moment after the other, draws
// it as the camera sees it, and gives the program the pictures, or the video that it makes of them.
import {
  EncodedPacket, EncodedVideoPacketSource, Mp4OutputFormat, Output, StreamTarget, WebMOutputFormat, type StreamTargetChunk, type VideoCodec,
} from "mediabunny";
import type { Context, Part } from "./context.ts";
import { element } from "./dom.ts";
import { formatDecimals } from "./numbers.ts";
import type { CameraWidget, Film, Widget } from "./protocol.ts";
import { ownCamera } from "./run_page.ts";
import { frameOfWebp, headOfWebp } from "./webp.ts";
import { makeCamera } from "./widgets/camera.ts";

const partSize = 512 * 1024; // bytes; a message holds 1 MiB of base64 and what is around it
const secondsBetweenKeyFrames = 2;
const bitsAPixel = 0.2;
const qualityOfWebp = 0.8;
const framesInEncoder = 4;

/// In the order in which they are tried: what the muxer calls them, and with profile and level.
const codecs: Record<"webm" | "mp4", [VideoCodec, string][]> = {
  webm: [["vp9", "vp09.00.51.08"], ["vp8", "vp8"], ["av1", "av01.0.13M.08"]],
  mp4: [["avc", "avc1.640033"], ["avc", "avc1.42E033"], ["vp9", "vp09.00.51.08"], ["av1", "av01.0.13M.08"]],
};

export function makeFilmPage(context: Context): Part {
  const film = context.description.film!;
  context.quality = film.quality;
  const camera = makeCamera(context, cameraOf(context, film.camera), true);
  for (const each of [camera.element, camera.view.canvas]) {
    each.style.width = `${film.width}px`;
    each.style.height = `${film.height}px`;
  }
  const take = async (index: number): Promise<HTMLCanvasElement> => {
    const time = await moment(context, index);
    const canvas = camera.view.drawNow();
    if (canvas.width !== film.width || canvas.height !== film.height)
      throw new Error(`its picture has ${canvas.width} x ${canvas.height} pixels`);
    return captioned(canvas, film, time, camera.element);
  };
  // Once the page has laid it out.
  requestAnimationFrame(() => {
    const made = film.format === "png" ? makePictures(context, film, take)
      : film.format === "webp" ? makeAnimation(context, film, take)
      : makeVideo(context, film, film.format, take);
    made.catch((problem: Error) => context.connection.request("film_failed", { text: problem.message }).catch(() => {}));
  });
  return { element: element("div", { class: "film" }, camera.element), dispose: camera.dispose };
}

function cameraOf(context: Context, trail: string): CameraWidget {
  const find = (widgets: Widget[]): CameraWidget | undefined => {
    for (const widget of widgets) {
      if (widget.type === "Window.grob" && widget.trail === trail) return widget;
      const inside = widget.type === "Window" ? find(widget.children) : undefined;
      if (inside !== undefined) return inside;
    }
    return undefined;
  };
  return find(context.description.windows) ?? ownCamera(context);
}

/// The picture with what the film is called and the time, at its lower right. `place` has the colours of the page.
function captioned(picture: HTMLCanvasElement, film: Film, time: number, place: HTMLElement): HTMLCanvasElement {
  if (film.caption === null) return picture;
  const canvas = document.createElement("canvas");
  canvas.width = film.width;
  canvas.height = film.height;
  const to = canvas.getContext("2d", { alpha: false })!;
  to.drawImage(picture, 0, 0);
  const size = Math.max(11, Math.round(film.height / 32));
  const { fontFamily, color, backgroundColor } = getComputedStyle(place);
  to.font = `${size}px ${fontFamily}`;
  to.textAlign = "right";
  to.textBaseline = "alphabetic";
  to.lineWidth = size / 4;
  to.lineJoin = "round";
  to.strokeStyle = backgroundColor;
  to.fillStyle = color;
  const decimals = Math.max(0, Math.ceil(Math.log10(film.rate)));
  const text = `${film.caption}${film.caption === "" ? "" : "   "}${formatDecimals(time, decimals)} s`;
  to.strokeText(text, film.width - size, film.height - size);
  to.fillText(text, film.width - size, film.height - size);
  return canvas;
}

/// Resolves to the time when everything that stands in the page shows the moment of picture `index`.
async function moment(context: Context, index: number): Promise<number> {
  let arrived = -1;
  let wake = () => {};
  const forget = context.onSnapshot((snapshot) => {
    arrived = snapshot.frame;
    wake();
  });
  try {
    const { snapshot, time } = await context.connection.request("film_frame", { index });
    while (arrived < snapshot) await new Promise<void>((resolve) => (wake = resolve));
    return time;
  } finally {
    forget();
  }
}

async function makePictures(context: Context, film: Film, take: (index: number) => Promise<HTMLCanvasElement>): Promise<void> {
  for (let index = 0; index < film.frames; ++index) {
    const canvas = await take(index);
    await send(context, index, 0, await encoded(canvas, "image/png"));
    await context.connection.request("film_end", { file: index });
  }
}

async function encoded(canvas: HTMLCanvasElement, type: "image/png" | "image/webp"): Promise<Uint8Array> {
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, type, qualityOfWebp));
  if (blob === null || blob.type !== type) throw new Error(`it encodes no ${type} of a picture`);
  return new Uint8Array(await blob.arrayBuffer());
}

/// The head comes last: it has the size of the whole.
async function makeAnimation(context: Context, film: Film, take: (index: number) => Promise<HTMLCanvasElement>): Promise<void> {
  const { width, height } = film;
  let at = headOfWebp(width, height, 0).length;
  const milliseconds = (index: number) => Math.round((1000 * index) / film.rate);
  for (let index = 0; index < film.frames; ++index) {
    const still = await encoded(await take(index), "image/webp");
    const frame = frameOfWebp(still, width, height, milliseconds(index + 1) - milliseconds(index));
    await send(context, 0, at, frame);
    at += frame.length;
  }
  await send(context, 0, 0, headOfWebp(width, height, at));
  await context.connection.request("film_end", { file: 0 });
}

async function makeVideo(
  context: Context, film: Film, format: "webm" | "mp4", take: (index: number) => Promise<HTMLCanvasElement>,
): Promise<void> {
  const { codec, config } = await chooseCodec(film, format);
  const writable = new WritableStream<StreamTargetChunk>({ write: ({ data, position }) => send(context, 0, position, data) });
  const output = new Output({
    format: format === "webm" ? new WebMOutputFormat() : new Mp4OutputFormat({ fastStart: false }),
    target: new StreamTarget(writable, { chunked: true, chunkSize: partSize }),
  });
  const source = new EncodedVideoPacketSource(codec);
  output.addVideoTrack(source, { frameRate: film.rate });
  await output.start();

  let written = Promise.resolve();
  let failure: Error | null = null;
  const encoder = new VideoEncoder({
    output: (chunk, metadata) => (written = written.then(() => source.add(EncodedPacket.fromEncodedChunk(chunk), metadata))),
    error: (problem) => (failure = problem),
  });
  encoder.configure(config);
  const framesBetweenKeyFrames = Math.max(1, Math.round(secondsBetweenKeyFrames * film.rate));
  const microseconds = (index: number) => Math.round((1e6 * index) / film.rate);
  for (let index = 0; index < film.frames && failure === null; ++index) {
    const picture = await take(index);
    const frame = new VideoFrame(picture, { timestamp: microseconds(index), duration: microseconds(index + 1) - microseconds(index) });
    encoder.encode(frame, { keyFrame: index % framesBetweenKeyFrames === 0 });
    frame.close();
    if (encoder.encodeQueueSize > framesInEncoder)
      await new Promise((resolve) => encoder.addEventListener("dequeue", resolve, { once: true }));
    await written;
  }
  if (failure === null) await encoder.flush();
  if (failure !== null) throw failure;
  await written;
  await output.finalize();
  await context.connection.request("film_end", { file: 0 });
}

async function chooseCodec({ width, height, rate }: Film, format: "webm" | "mp4"): Promise<{ codec: VideoCodec; config: VideoEncoderConfig }> {
  const bitrate = Math.ceil(bitsAPixel * width * height * rate);
  for (const [codec, name] of codecs[format]) {
    const config: VideoEncoderConfig = { codec: name, width, height, bitrate, framerate: rate, latencyMode: "quality" };
    const { supported } = await VideoEncoder.isConfigSupported(config);
    if (supported) return { codec, config };
  }
  throw new Error(`it encodes none of ${codecs[format].map(([codec]) => codec).join(", ")} at ${width} x ${height} pixels`);
}

async function send(context: Context, file: number, at: number, bytes: Uint8Array): Promise<void> {
  for (let done = 0; done < bytes.length; done += partSize) {
    const part = bytes.subarray(done, done + partSize);
    await context.connection.request("film_part", { file, at: at + done, bytes: base64(part) });
  }
}

function base64(bytes: Uint8Array): string {
  const stride = 0x8000; // arguments of a call
  let text = "";
  for (let at = 0; at < bytes.length; at += stride) text += String.fromCharCode(...bytes.subarray(at, at + stride));
  return btoa(text);
}
