// Lines of a given width in pixels, in one draw call: WebGL itself draws lines of one pixel only. Filled anew for every frame, without
// allocation once they have grown to what a frame needs.
import {
  BufferAttribute, type Color, DoubleSide, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, Vector2,
  type Vector3,
} from "three";
import { GrowingBuffers } from "./growing_buffers.ts";

const vertexShader = /* glsl */ `
attribute vec3 start;
attribute vec3 end;
attribute vec3 colour;
attribute float width;
uniform vec2 resolution;
uniform float scale;
varying vec3 shade;
void main() {
  vec4 a = modelViewMatrix * vec4(start, 1.);
  vec4 b = modelViewMatrix * vec4(end, 1.);
  // Before the camera only: a point behind it would be mirrored.
  float near = projectionMatrix[3][2] / (projectionMatrix[2][2] - 1.);
  if (a.z > -near) a = mix(a, b, (a.z + near) / (a.z - b.z));
  else if (b.z > -near) b = mix(b, a, (b.z + near) / (b.z - a.z));
  vec4 from = projectionMatrix * a;
  vec4 to = projectionMatrix * b;
  vec2 along = (to.xy / to.w - from.xy / from.w) * resolution;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1., 0.);
  vec4 clip = position.x < .5 ? from : to;
  clip.xy += vec2(-along.y, along.x) * position.y * width * scale / resolution * clip.w;
  clip.z -= 2e-4 * clip.w;
  gl_Position = clip;
  shade = colour;
}`;
const fragmentShader = /* glsl */ `
uniform float opacity;
varying vec3 shade;
void main() {
  gl_FragColor = vec4(shade, opacity);
  #include <colorspace_fragment>
}`;

export interface StrokeOptions {
  onTop?: boolean; // drawn through what stands before it
  opacity?: number;
  order?: number;
}

export class Strokes {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly buffers: GrowingBuffers;

  constructor(options: StrokeOptions = {}) {
    const material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      side: DoubleSide,
      uniforms: { resolution: { value: new Vector2(1, 1) }, scale: { value: 1 }, opacity: { value: options.opacity ?? 1 } },
      transparent: options.opacity !== undefined || options.onTop === true,
      depthTest: options.onTop !== true,
      depthWrite: false,
    });
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
    this.mesh.renderOrder = options.order ?? 1;
    const names = ["start", "end", "colour", "width"];
    this.buffers = new GrowingBuffers([3, 3, 3, 1], (array, size) => new InstancedBufferAttribute(array, size), (attributes) => {
      const old = this.mesh.geometry;
      const grown = new InstancedBufferGeometry();
      grown.setAttribute("position", old.getAttribute("position"));
      grown.setIndex(old.getIndex());
      attributes.forEach((attribute, k) => grown.setAttribute(names[k], attribute));
      this.mesh.geometry = grown;
      old.dispose();
    });
  }

  begin(): void {
    this.buffers.begin();
  }
  add(start: Vector3, end: Vector3, colour: Color, width: number): void {
    const at = this.buffers.next();
    const [starts, ends, colours, widths] = this.buffers.attributes;
    starts.setXYZ(at, start.x, start.y, start.z);
    ends.setXYZ(at, end.x, end.y, end.z);
    colours.setXYZ(at, colour.r, colour.g, colour.b);
    widths.setX(at, width);
  }
  end(): void {
    this.buffers.end();
    this.mesh.geometry.instanceCount = this.buffers.count;
    this.mesh.visible = this.buffers.count > 0;
  }
  /// Picture's size [pixels], and pixels of the device to one of the page.
  size(width: number, height: number, scale: number): void {
    this.mesh.material.uniforms.resolution.value.set(width, height);
    this.mesh.material.uniforms.scale.value = scale;
  }
  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
