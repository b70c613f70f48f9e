// Mouse and keys on a camera's canvas: what they mean, not what is done about it.
import { type CameraValues, moved, orbited, zoomed } from "./camera.ts";

export interface Gestures {
  values(): CameraValues;
  change(values: CameraValues): void;
  pan(across: number, upwards: number): void; // pixels
  recentre(): void;
  pullStart(x: number, y: number): boolean; // whether there is a body
  pullMove(x: number, y: number): void;
  pullEnd(): void;
  select(x: number, y: number): void;
}

const radiansPerPixel = 0.008;
const keyTurn = Math.PI / 36;
const keyPan = 30;
const keyFactor = 1.1;

export const keysHelp =
  "Arrow keys orbit, with Shift they move the view; Page Up and Page Down change the distance, with Shift the zoom; " +
  "Home returns to the robots. Double click selects a body; dragging it with Control exerts a force.";

export class Pointer {
  private doing: "none" | "orbit" | "pan" | "pull" | "pinch" = "none";
  private readonly touches = new Map<number, { x: number; y: number }>();
  private x = 0;
  private y = 0;
  private readonly removed = new AbortController();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly gestures: Gestures,
  ) {
    const { signal } = this.removed;
    canvas.addEventListener("pointerdown", (event) => this.down(event), { signal });
    // Who clicks into a picture means it, not the keys: those of the page stay the page's.
    canvas.addEventListener("mousedown", (event) => {
      event.preventDefault();
      if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    }, { signal });
    canvas.addEventListener("pointermove", (event) => this.move(event), { signal });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"] as const)
      canvas.addEventListener(name, (event) => this.release(event), { signal });
    canvas.addEventListener("wheel", (event) => this.wheel(event), { signal, passive: false });
    canvas.addEventListener("dblclick", (event) => gestures.select(event.offsetX, event.offsetY), { signal });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault(), { signal });
    canvas.addEventListener("keydown", (event) => this.key(event), { signal });
  }
  get busy(): boolean {
    return this.doing !== "none";
  }

  private down(event: PointerEvent): void {
    if (event.pointerType === "touch") {
      this.touches.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
      // A second finger makes it a pinch, whatever the first began.
      if (this.touches.size === 2 && this.doing !== "pull") {
        this.doing = "pinch";
        this.canvas.setPointerCapture(event.pointerId);
        return;
      }
    }
    if (this.busy) return;
    this.x = event.offsetX;
    this.y = event.offsetY;
    const left = event.button === 0;
    if (left && (event.ctrlKey || event.metaKey)) {
      if (!this.gestures.pullStart(this.x, this.y)) return;
      this.doing = "pull";
    } else if (event.button === 2 || (left && event.shiftKey)) {
      this.doing = "pan";
    } else if (left) {
      this.doing = "orbit";
    } else {
      return;
    }
    this.canvas.setPointerCapture(event.pointerId);
  }
  private move(event: PointerEvent): void {
    if (!this.busy) return;
    if (this.doing === "pinch") return this.pinch(event);
    const [across, down] = [event.offsetX - this.x, event.offsetY - this.y];
    this.x = event.offsetX;
    this.y = event.offsetY;
    if (this.doing === "pull") this.gestures.pullMove(this.x, this.y);
    else if (this.doing === "pan") this.gestures.pan(-across, down);
    else this.gestures.change(orbited(this.gestures.values(), -across * radiansPerPixel, down * radiansPerPixel));
  }
  /// Two fingers apart or together change the distance, and both together move the view.
  private pinch(event: PointerEvent): void {
    const before = [...this.touches.values()];
    if (!this.touches.has(event.pointerId) || before.length !== 2) return;
    this.touches.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    const [[a, b], [c, d]] = [before, [...this.touches.values()]];
    const spread = (one: { x: number; y: number }, other: { x: number; y: number }) => Math.max(1, Math.hypot(one.x - other.x, one.y - other.y));
    this.gestures.change(moved(this.gestures.values(), spread(a, b) / spread(c, d)));
    this.gestures.pan((a.x + b.x - c.x - d.x) / 2, (c.y + d.y - a.y - b.y) / 2);
  }
  private release(event: PointerEvent): void {
    this.touches.delete(event.pointerId);
    if (this.doing === "pinch" && this.touches.size > 0) return;
    const pulling = this.doing === "pull";
    this.doing = "none";
    if (pulling) this.gestures.pullEnd();
  }
  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / 40 : event.deltaY;
    this.gestures.change(moved(this.gestures.values(), 1.04 ** lines));
  }
  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey || !this.carryOut(event.key, event.shiftKey)) return;
    // The page has its own meaning for some of these keys.
    event.preventDefault();
    event.stopPropagation();
  }
  private carryOut(key: string, shift: boolean): boolean {
    const { gestures } = this;
    const values = gestures.values();
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (key in arrows) {
      const [across, upwards] = arrows[key];
      if (shift) gestures.pan(across * keyPan, upwards * keyPan);
      else gestures.change(orbited(values, across * keyTurn, upwards * keyTurn));
      return true;
    }
    if (key === "PageUp" || key === "PageDown") {
      const factor = key === "PageUp" ? keyFactor : 1 / keyFactor;
      gestures.change(shift ? zoomed(values, factor) : moved(values, 1 / factor));
      return true;
    }
    if (key === "Home") {
      gestures.recentre();
      return true;
    }
    return false;
  }
  dispose(): void {
    this.removed.abort();
  }
}
