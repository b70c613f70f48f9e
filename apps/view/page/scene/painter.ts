// The one WebGL context that all cameras of a page paint with, each into its own picture. Browsers allow only a few contexts, and a
// picture that is a plain canvas stays when the context is lost.
import { type PerspectiveCamera, type Scene, WebGLRenderer, PCFShadowMap } from "three";

export type Quality = "low" | "medium" | "high";

export class Painter {
  private static readonly shared = new Map<boolean, { painter: Painter; users: number }>();
  readonly renderer: WebGLRenderer;
  lost = false;
  private readonly listeners = new Set<() => void>();

  /// Throws where the browser gives no WebGL.
  private constructor(antialias: boolean) {
    this.renderer = new WebGLRenderer({ antialias, alpha: false, stencil: false, powerPreference: "default" });
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.enabled = true;
    this.renderer.setScissorTest(true);
    const canvas = this.renderer.domElement;
    canvas.addEventListener("webglcontextlost", () => this.tell(true));
    canvas.addEventListener("webglcontextrestored", () => this.tell(false));
  }
  private tell(lost: boolean): void {
    this.lost = lost;
    if (!lost) this.renderer.setScissorTest(true);
    for (const listener of this.listeners) listener();
  }

  static antialiases(quality: Quality): boolean {
    return quality !== "low";
  }
  static take(quality: Quality, onChange: () => void): Painter {
    const antialias = Painter.antialiases(quality);
    const entry = Painter.shared.get(antialias) ?? { painter: new Painter(antialias), users: 0 };
    ++entry.users;
    Painter.shared.set(antialias, entry);
    entry.painter.listeners.add(onChange);
    return entry.painter;
  }
  leave(onChange: () => void): void {
    this.listeners.delete(onChange);
    for (const [antialias, entry] of Painter.shared) {
      if (entry.painter !== this || --entry.users > 0) continue;
      Painter.shared.delete(antialias);
      this.renderer.dispose();
      this.renderer.forceContextLoss();
    }
  }

  /// Paints into the top left corner of the context's own canvas, and copies that.
  paint(scene: Scene, camera: PerspectiveCamera, to: CanvasRenderingContext2D, width: number, height: number): void {
    const canvas = this.renderer.domElement;
    if (canvas.width < width || canvas.height < height)
      this.renderer.setSize(Math.max(canvas.width, width), Math.max(canvas.height, height), false);
    const bottom = canvas.height - height;
    this.renderer.setViewport(0, bottom, width, height);
    this.renderer.setScissor(0, bottom, width, height);
    this.renderer.render(scene, camera);
    to.drawImage(canvas, 0, 0, width, height, 0, 0, width, height);
  }
}
